//! The nodes of a glTF scene: which there are, where they are, what hangs below what.

use glam::{DAffine3, DMat4, DQuat, DVec3};
use gltf::scene::Transform;
use gltf::{Document, Node};

use crate::scene::motion::{RigNode, Stand};

/// The nodes of the scene that is shown, parents first, in the order of the file.
pub(super) struct Nodes<'a> {
    pub(super) nodes: Vec<Node<'a>>,
    /// The same nodes, for a rig.
    pub(super) of_rig: Vec<RigNode>,
    /// Where a node of the file is in this list; `None` if it is not in the scene.
    pub(super) place_of: Vec<Option<usize>>,
}

/// A node that waits for its turn, and the place of its parent.
type Waiting<'a> = (Node<'a>, Option<usize>);

pub(super) fn read(document: &Document) -> Result<Nodes<'_>, String> {
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
    };
    while let Some((node, parent)) = waiting.pop() {
        let place = found.nodes.len();
        if found.place_of[node.index()].replace(place).is_some() {
            return Err(format!(
                "node {} has two parents or is its own",
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
        let children: Vec<_> = node.children().collect();
        waiting.extend(children.into_iter().rev().map(|child| (child, Some(place))));
        found.nodes.push(node);
    }
    Ok(found)
}

/// Where a node is in its parent, and that in pieces.
fn local(node: &Node<'_>) -> (DAffine3, Option<Stand>) {
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
            let stand = Stand {
                translation: DVec3::from(translation.map(f64::from)),
                rotation: DQuat::from_array(rotation.map(f64::from)).normalize(),
                scale: DVec3::from(scale.map(f64::from)),
            };
            (stand.affine(), Some(stand))
        }
    }
}

/// How far a matrix may be from what its pieces make, relative to its largest entry: shear does not come apart.
const SHEAR: f64 = 1e-5;

fn apart(matrix: DAffine3) -> Option<Stand> {
    // A matrix that flattens has no rotation to be found.
    if matrix.matrix3.determinant().abs() <= 0.0 || !matrix.is_finite() {
        return None;
    }
    let (scale, rotation, translation) = matrix.to_scale_rotation_translation();
    let stand = Stand {
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
