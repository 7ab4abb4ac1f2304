//! The nodes of a glTF scene, with their transforms and hierarchy.

use std::collections::BTreeMap;
use std::ops::Range;

use cutaway::scene::motion::{NodeTransform, RigNode};
use glam::{DAffine3, DMat4, DQuat, DVec3};
use gltf::scene::Transform;
use gltf::{Document, Node};

use super::extensions::VISIBILITY;
use super::instances;

/// The nodes of the displayed scene. Parents come before children; otherwise the order is that of the file.
pub(super) struct Nodes<'a> {
    pub(super) nodes: Vec<Node<'a>>,
    /// The same nodes as rig nodes.
    pub(super) of_rig: Vec<RigNode>,
    /// For each node of the file, its index in this list, or `None` if the node is not in the scene.
    pub(super) place_of: Vec<Option<usize>>,
    /// For each instanced node, by index, the range of its instance nodes in the rig.
    instances: BTreeMap<usize, Range<usize>>,
    /// True for each node that is hidden, itself or by an ancestor.
    is_hidden: Vec<bool>,
}

impl Nodes<'_> {
    /// Returns the range of rig nodes that show the mesh of a node.
    pub(super) fn shown_at(&self, place: usize) -> Range<usize> {
        match self.instances.get(&place) {
            _ if self.is_hidden[place] => 0..0,
            Some(instances) => instances.clone(),
            None => place..place + 1,
        }
    }

    /// Number of hidden nodes with a mesh.
    pub(super) fn hidden(&self) -> usize {
        let both = self.nodes.iter().zip(&self.is_hidden);
        both.filter(|(node, hidden)| **hidden && node.mesh().is_some())
            .count()
    }
}

/// A node that is still to be visited, and the index of its parent.
type Waiting<'a> = (Node<'a>, Option<usize>);

pub(super) fn read<'a>(document: &'a Document, buffers: &[Vec<u8>]) -> Result<Nodes<'a>, String> {
    let mut is_child = vec![false; document.nodes().count()];
    for child in document.nodes().flat_map(|n| n.children()) {
        is_child[child.index()] = true;
    }
    let scene = document
        .default_scene()
        .or_else(|| document.scenes().next());
    let mut waiting: Vec<Waiting<'_>> = match scene {
        Some(scene) => scene.nodes().map(|n| (n, None)).collect(),
        None => document
            .nodes()
            .filter(|n| !is_child[n.index()])
            .map(|n| (n, None))
            .collect(),
    };
    waiting.reverse();
    let mut worlds: Vec<DAffine3> = Vec::new();
    let mut found = Nodes {
        nodes: Vec::new(),
        of_rig: Vec::new(),
        place_of: vec![None; is_child.len()],
        instances: BTreeMap::new(),
        is_hidden: Vec::new(),
    };
    while let Some((node, parent)) = waiting.pop() {
        let place = found.nodes.len();
        if found.place_of[node.index()].replace(place).is_some() {
            return Err(format!(
                "node {} has two parents or is its own ancestor",
                node.index()
            ));
        }
        let (rest, stand) = local(&node);
        let world = parent.map_or(rest, |p| worlds[p] * rest);
        if !world.is_finite() {
            return Err(format!(
                "node {} has a transform that is not finite",
                node.index()
            ));
        }
        worlds.push(world);
        found.of_rig.push(RigNode {
            parent,
            rest,
            stand,
        });
        let is_visible = node
            .extension_value(VISIBILITY)
            .and_then(|v| v.get("visible")?.as_bool());
        let is_below_hidden = parent.is_some_and(|p| found.is_hidden[p]);
        found
            .is_hidden
            .push(is_below_hidden || is_visible == Some(false));
        let children: Vec<_> = node.children().collect();
        waiting.extend(children.into_iter().rev().map(|child| (child, Some(place))));
        found.nodes.push(node);
    }
    for (place, node) in found.nodes.iter().enumerate() {
        // A skinned mesh follows its joints, wherever its node is.
        if node.skin().is_some() {
            continue;
        }
        let Some(stands) = instances::read(document, node, buffers)? else {
            continue;
        };
        let first = found.of_rig.len();
        for stand in stands {
            let rest = stand.affine();
            if !(worlds[place] * rest).is_finite() {
                let node = node.index();
                return Err(format!(
                    "node {node} has an instance at a position that is not finite"
                ));
            }
            found.of_rig.push(RigNode {
                parent: Some(place),
                rest,
                stand: Some(stand),
            });
        }
        found.instances.insert(place, first..found.of_rig.len());
        if found.of_rig.len() - found.nodes.len() > instances::MOST {
            return Err(format!("it has more than {} instances", instances::MOST));
        }
    }
    Ok(found)
}

/// Returns the transform of a node relative to its parent, as a matrix and decomposed.
fn local(node: &Node<'_>) -> (DAffine3, Option<NodeTransform>) {
    match node.transform() {
        Transform::Matrix { matrix } => {
            let matrix = matrix.map(|c| c.map(f64::from));
            let rest = DAffine3::from_mat4(DMat4::from_cols_array_2d(&matrix));
            (rest, apart(rest))
        }
        Transform::Decomposed {
            translation,
            rotation,
            scale,
        } => {
            let stand = NodeTransform {
                translation: DVec3::from(translation.map(f64::from)),
                rotation: DQuat::from_array(rotation.map(f64::from)).normalize(),
                scale: DVec3::from(scale.map(f64::from)),
            };
            (stand.affine(), Some(stand))
        }
    }
}

/// Largest accepted difference between a matrix and its recomposition, relative to the largest entry. Sheared matrices exceed it.
const SHEAR: f64 = 1e-5;

fn apart(matrix: DAffine3) -> Option<NodeTransform> {
    // A singular matrix does not define a rotation.
    if matrix.matrix3.determinant().abs() <= 0.0 || !matrix.is_finite() {
        return None;
    }
    let (scale, rotation, translation) = matrix.to_scale_rotation_translation();
    let stand = NodeTransform {
        translation,
        rotation,
        scale,
    };
    let (is, wanted) = (stand.affine().to_cols_array(), matrix.to_cols_array());
    let largest = wanted.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
    let mut both = is.iter().zip(wanted);
    both.all(|(a, b)| (a - b).abs() <= SHEAR * largest)
        .then_some(stand)
}
