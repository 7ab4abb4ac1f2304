//! Reads glTF 2.0 and GLB: geometry, placement, base colours and their images, vertex colours, and animation by nodes, skins, morph targets
//! and clips.
//!
//! Every node with a mesh becomes a part, or several parts if it has instances or if its primitives are separate closed solids. Hidden
//! nodes are left out. Nodes with the same mesh share it. A part is shown in its rest pose, which is given by its skin's joints and the
//! default weights of its morph targets. Vertices are welded in the bind pose, so that a closed mesh stays closed in every pose. Welded
//! vertices follow the first vertex of their group.
//!
//! Vertices may be quantized, and packed by meshopt or Draco (`packed`).
//!
//! Faults in the geometry of the rest pose are errors. Faulty data for motion or appearance is left out with a note.

mod accessor;
mod clips;
mod document;
mod draco;
mod extensions;
mod follow;
mod images;
mod instances;
mod mended;
mod meshopt;
mod nodes;
mod packed;
mod paint;
mod primitives;
mod quantized;
mod skin;
mod torn;
mod uri;

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use cutaway::error::{Diagnostic, Error, Result};
use cutaway::scene::Role;
use cutaway::scene::motion::{BoundMesh, Driver, Motion, Rig, RigAttachment};
use cutaway::scene::weld::thousands;
use gltf::Node;

use super::grouped::grouped;
use super::{DraftSolid, Files, Placed};

use document::GltfFile;
pub(super) use document::named_files;
use extensions::VISIBILITY;
use images::GltfImages;
pub(super) use uri::leads_away;

const DAMAGED: &str =
    "the file is cut off, damaged or uses an extension: export it again as plain glTF 2.0";

pub(super) fn read(
    path: &Path,
    bytes: &[u8],
    store: &dyn Files,
    (notes, files): (&mut Vec<Diagnostic>, &mut Vec<PathBuf>),
) -> Result<Vec<Placed>> {
    let wrong = |what: String| Error::file(path, what, DAMAGED);
    let opened = document::open(path, bytes, store, (notes, files))?;
    let GltfFile {
        document, buffers, ..
    } = &opened;
    let nodes = nodes::read(document, buffers).map_err(wrong)?;
    let skins = skin::read(document, &nodes, buffers);
    let of_rig = skins.iter().map(|s| s.clone().unwrap_or_default());
    let mut rig = Rig::new(nodes.of_rig.clone(), of_rig.collect());
    notes.extend(skin::flat_joints(&rig));
    clips::ClipReader {
        document,
        nodes: &nodes,
        buffers,
    }
    .read(&opened.animations, &mut rig, notes);
    let rig = Arc::new(rig);
    let mut images = GltfImages {
        path,
        store,
        buffers,
        read: BTreeMap::new(),
        pixels: 0,
        files: Vec::new(),
        notes: Vec::new(),
    };
    let mut placed = Vec::new();
    let mut said_of_nodes = Vec::new();
    let mut shared: BTreeMap<(usize, Option<usize>), Vec<GltfSolid>> = BTreeMap::new();
    for (place, node) in nodes.nodes.iter().enumerate() {
        let Some(mesh) = node.mesh().filter(|_| !nodes.shown_at(place).is_empty()) else {
            continue;
        };
        let name = node.name().or(mesh.name()).map(str::to_owned);
        let mut said = Vec::new();
        let skin = usable_skin(node, &skins, &mut said);
        let key = (mesh.index(), skin);
        let shapes = match shared.entry(key) {
            Entry::Occupied(known) => known.into_mut(),
            Entry::Vacant(new) => {
                let joints = skin.map(|s| rig.skins[s].joints.len());
                let draft = primitives::draft(&mesh, joints, (buffers, &mut images), &mut said)
                    .map_err(wrong)?;
                let solids = match draft.mesh.triangles.is_empty() {
                    true => Vec::new(),
                    false => draft.into_solids(path, &mut said)?,
                };
                let shape = |solid| GltfSolid::of(solid, skin, &rig);
                new.insert(solids.into_iter().map(shape).collect())
            }
        };
        let weights = weights(node, &mut said);
        let role = role(node, &mut said);
        let label = name.clone();
        let label = label.unwrap_or_else(|| format!("node {}", node.index()));
        for (at, shape) in nodes
            .shown_at(place)
            .flat_map(|at| shapes.iter().map(move |s| (at, s)))
        {
            let shown = shape.at(&rig, at, name.clone(), &weights);
            let mut shown = shown.ok_or_else(|| {
                wrong(format!(
                    "{label}: it is moved to positions that are not finite"
                ))
            })?;
            shown.role = role;
            placed.push(shown);
        }
        said_of_nodes.extend(said.into_iter().map(|note: Diagnostic| note.about(&label)));
    }
    notes.extend(grouped(said_of_nodes, "node"));
    match nodes.hidden() {
        0 => {}
        1 => notes.push(Diagnostic::note(
            "node-hidden",
            format!("left out 1 node with a mesh, which {VISIBILITY} hides"),
        )),
        more => {
            let more = thousands(more);
            notes.push(Diagnostic::note(
                "node-hidden",
                format!("left out {more} nodes with meshes, which {VISIBILITY} hides"),
            ));
        }
    }
    notes.append(&mut images.notes);
    files.append(&mut images.files);
    if placed.is_empty() {
        return Err(Error::file(
            path,
            "no node of its scene has triangles",
            "export it with meshes; points, lines and curves are not cut",
        ));
    }
    Ok(torn::joined(placed, notes))
}

/// The role in a node's `extras`: `{ "role": "interior" }`.
fn role(node: &Node<'_>, notes: &mut Vec<Diagnostic>) -> Option<Role> {
    let extras = node.extras().as_ref()?;
    let value: serde_json::Value = serde_json::from_str(extras.get()).ok()?;
    let word = value.get("role")?.as_str()?;
    let role = Role::named(word);
    if role.is_none() {
        let known = Role::ALL.map(|(name, _)| name).join(", ");
        notes.push(Diagnostic::note(
            "unknown-role",
            format!("its role {word:?} is not one of {known}"),
        ));
    }
    role
}

/// Returns the skin of a node's mesh, if it is usable.
fn usable_skin<T>(
    node: &Node<'_>,
    skins: &[Result<T, String>],
    notes: &mut Vec<Diagnostic>,
) -> Option<usize> {
    let index = node.skin()?.index();
    let why = match skins.get(index)? {
        Err(why) => why.clone(),
        Ok(_) if !node.mesh().is_some_and(|m| skin::pulls_at(&m)) => {
            format!("skin {index}: the mesh's vertices have no joints")
        }
        Ok(_) => return Some(index),
    };
    notes.push(Diagnostic::note(
        "skin-left-out",
        format!("shown without its skin, at its node: {why}"),
    ));
    None
}

/// Default weights of a node's morph targets, one for each target.
fn weights(node: &Node<'_>, notes: &mut Vec<Diagnostic>) -> Vec<f64> {
    let targets = clips::targets(node);
    let mesh = node.mesh();
    let given = node
        .weights()
        .or(mesh.as_ref().and_then(gltf::Mesh::weights));
    let mut weights: Vec<f64> = given
        .unwrap_or_default()
        .iter()
        .map(|w| f64::from(*w))
        .collect();
    if !weights.is_empty() && weights.len() != targets {
        let given = weights.len();
        notes.push(Diagnostic::note(
            "weights-missing",
            format!("{given} weights for {targets} morph targets: missing weights are set to 0"),
        ));
    }
    weights.resize(targets, 0.0);
    if let Some(bad) = weights.iter_mut().find(|w| !w.is_finite()) {
        notes.push(Diagnostic::note(
            "weights-not-finite",
            format!("a weight of its morph targets is {bad}: all weights are set to 0"),
        ));
        weights.fill(0.0);
    }
    weights
}

/// A solid of a mesh, shared by the nodes that show it.
struct GltfSolid {
    color: Option<glam::Vec3>,
    materials: Vec<String>,
    is_transparent: bool,
    is_closed: bool,
    bound: Arc<BoundMesh>,
    hold: RigAttachment,
}

impl GltfSolid {
    fn of(mut solid: DraftSolid, skin: Option<usize>, rig: &Rig) -> Self {
        let motion = &mut solid.motion;
        let still = |t: &Vec<glam::DVec3>| t.iter().all(|d| d.abs().max_element() <= 0.0);
        if motion.targets.iter().all(still) {
            motion.targets.clear();
        }
        let hold = skin.map_or(RigAttachment::Node, |skin| hold(motion, skin, rig));
        if !matches!(hold, RigAttachment::Skin { .. }) {
            motion.first_pull.clear();
            motion.pulls.clear();
        }
        Self {
            color: solid.color,
            materials: solid.materials,
            is_transparent: solid.is_transparent,
            is_closed: solid.is_closed,
            bound: Arc::new(BoundMesh::new(solid.mesh, solid.motion)),
            hold,
        }
    }

    /// Places the solid at a node. Returns `None` if the result is not finite.
    fn at(
        &self,
        rig: &Arc<Rig>,
        node: usize,
        name: Option<String>,
        weights: &[f64],
    ) -> Option<Placed> {
        let driver = Driver::new(rig, node, self.hold.clone(), &self.bound, weights.to_vec());
        let (mesh, world_from_part) = driver.at_rest();
        driver.is_finite().then(|| Placed {
            name,
            color: self.color,
            materials: self.materials.clone(),
            is_transparent: self.is_transparent,
            role: None,
            is_closed: self.is_closed,
            mesh,
            world_from_part,
            driver: driver.is_needed().then(|| Arc::new(driver)),
        })
    }
}

/// Returns how a skinned solid is attached to the rig. If all its vertices follow one joint, it is attached to that joint.
fn hold(motion: &Motion, skin: usize, rig: &Rig) -> RigAttachment {
    let beyond = rig.skins[skin].joints.len();
    let joints = motion.pulls.iter().map(|pull| usize::from(pull.joint));
    let Some(first) = joints.clone().next() else {
        return RigAttachment::Node;
    };
    if joints.clone().any(|joint| joint != first) {
        let with_node = joints.max() == Some(beyond);
        return RigAttachment::Skin { skin, with_node };
    }
    if first == beyond {
        return RigAttachment::Node;
    }
    RigAttachment::Joint { skin, joint: first }
}
