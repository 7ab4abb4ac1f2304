//! glTF skins: joints with their inverse bind matrices, and the joint influences on each vertex.

use std::collections::BTreeSet;

use cutaway::error::Diagnostic;
use cutaway::scene::motion::{Rig, RigSkin};
use glam::{DAffine3, DMat4};
use gltf::{Document, Primitive, Semantic, Skin};

use super::accessor::{JOINTS, MAT4, WEIGHTS, check, items};
use super::nodes::Nodes;

/// Joint influences on a vertex. Each is a joint and a weight, with up to four in a set.
pub(super) type Pulls = Vec<(u16, f32)>;

/// Reads the skins of a file. An unusable skin is returned as an error message.
pub(super) fn read(
    document: &Document,
    nodes: &Nodes<'_>,
    buffers: &[Vec<u8>],
) -> Vec<Result<RigSkin, String>> {
    let named = |skin: Skin<'_>| {
        let index = skin.index();
        one(&skin, nodes, buffers).map_err(|why| format!("skin {index}: {why}"))
    };
    document.skins().map(named).collect()
}

fn one(skin: &Skin<'_>, nodes: &Nodes<'_>, buffers: &[Vec<u8>]) -> Result<RigSkin, String> {
    let joints: Vec<usize> = skin.joints().map(|n| n.index()).collect();
    if joints.len() > usize::from(u16::MAX) {
        return Err(format!(
            "it has {} joints, but at most 65,535 are supported",
            joints.len()
        ));
    }
    let inverse = match skin.inverse_bind_matrices() {
        None => vec![DAffine3::IDENTITY; joints.len()],
        Some(accessor) => items::<Columns>(accessor, MAT4, buffers)?
            .into_iter()
            .map(|c| DAffine3::from_mat4(DMat4::from_cols_array_2d(&c.0.map(|c| c.map(f64::from)))))
            .collect(),
    };
    if inverse.len() < joints.len() {
        return Err(format!(
            "it has {} joints and {} inverse bind matrices",
            joints.len(),
            inverse.len()
        ));
    }
    if let Some(bad) = inverse.iter().position(|m| !m.is_finite()) {
        return Err(format!("inverse bind matrix {bad} is not finite"));
    }
    let mut skin = RigSkin::default();
    for (joint, inverse) in joints.into_iter().zip(inverse) {
        let place = nodes.place_of[joint];
        let place = place.ok_or_else(|| format!("joint {joint} is not in the scene"))?;
        skin.joints.push((place, inverse));
    }
    Ok(skin)
}

/// A joint counts as flattening if its matrix's determinant, relative to the product of the column lengths, is at most this.
const FLAT: f64 = 1e-12;

/// Notes on joints whose matrix flattens the geometry that follows them in the rest pose.
pub(super) fn flat_joints(rig: &Rig) -> Vec<Diagnostic> {
    let is_flat = |joint: &DAffine3| {
        let m = joint.matrix3;
        let columns = m.x_axis.length() * m.y_axis.length() * m.z_axis.length();
        m.determinant().abs() <= FLAT * columns
    };
    let flat = |skin: usize| {
        let joint = rig.palette(skin, None).iter().position(is_flat)?;
        let text =
            format!("joint {joint} is flat: geometry that follows only this joint has no volume");
        Some(Diagnostic::note("joint-flattens", text).about(format!("skin {skin}")))
    };
    (0..rig.skins.len()).filter_map(flat).collect()
}

/// A 4 x 4 matrix as an accessor item.
struct Columns([[f32; 4]; 4]);

impl gltf::accessor::Item for Columns {
    fn from_slice(slice: &[u8]) -> Self {
        Self(std::array::from_fn(|c| {
            <[f32; 4]>::from_slice(&slice[16 * c..])
        }))
    }

    fn zero() -> Self {
        Self([[0.0; 4]; 4])
    }
}

/// Returns true if any primitive of a mesh has joints for its vertices.
pub(super) fn pulls_at(mesh: &gltf::Mesh<'_>) -> bool {
    let is_pulled = |p: Primitive<'_>| p.get(&Semantic::Joints(0)).is_some();
    mesh.primitives().any(is_pulled)
}

/// The joint influences on every vertex of a primitive, in file order. Empty if the primitive has none. A list whose length differs from
/// the number of positions is an error. Joints without weights, and weights without joints, are ignored with a note.
pub(super) fn pulls(
    primitive: &Primitive<'_>,
    vertices: usize,
    buffers: &[Vec<u8>],
    notes: &mut Vec<Diagnostic>,
) -> Result<Vec<Pulls>, String> {
    let sets: BTreeSet<u32> = primitive
        .attributes()
        .filter_map(|(semantic, _)| match semantic {
            Semantic::Joints(set) | Semantic::Weights(set) => Some(set),
            _ => None,
        })
        .collect();
    let mut pulls: Vec<Pulls> = Vec::new();
    let reader = primitive.reader(|b| buffers.get(b.index()).map(Vec::as_slice));
    for set in sets {
        let (Some(joints), Some(weights)) = (
            primitive.get(&Semantic::Joints(set)),
            primitive.get(&Semantic::Weights(set)),
        ) else {
            notes.push(Diagnostic::note(
                "joints-left-out",
                format!("ignored JOINTS_{set} or WEIGHTS_{set}, because the other is missing"),
            ));
            continue;
        };
        check(&joints, JOINTS, buffers)?;
        check(&weights, WEIGHTS, buffers)?;
        for (what, count) in [("JOINTS", joints.count()), ("WEIGHTS", weights.count())] {
            if count != vertices {
                return Err(format!(
                    "{what}_{set} has {count} items for {vertices} vertices"
                ));
            }
        }
        let (Some(joints), Some(weights)) = (reader.read_joints(set), reader.read_weights(set))
        else {
            return Err(format!("JOINTS_{set} and WEIGHTS_{set} cannot be read"));
        };
        pulls.resize(vertices, Pulls::new());
        let both = joints.into_u16().zip(weights.into_f32());
        for (pulls, (joints, weights)) in pulls.iter_mut().zip(both) {
            pulls.extend(joints.into_iter().zip(weights));
        }
    }
    Ok(pulls)
}
