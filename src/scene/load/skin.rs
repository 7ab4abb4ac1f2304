//! Skinned glTF meshes in rest pose: every vertex is moved by its joints, the mesh's own node does not count.

use glam::{DAffine3, DMat3, DMat4, DVec3};
use gltf::{Node, Primitive, Semantic, Skin};

use super::accessor::{JOINTS, MAT4, WEIGHTS, check, items};
use crate::scene::Mesh;

/// Joints whose matrices differ by less move the mesh as one; relative to the matrix' largest entry.
const SAME_MATRIX: f64 = 1e-5;

/// What moves each vertex: joint and weight, up to four per set.
pub(super) type Pull = Vec<(u16, f32)>;

/// World matrices of the joints in rest pose, times their inverse bind matrices.
pub(super) fn palette(
    skin: &Skin<'_>,
    world_from_node: &[Option<DAffine3>],
    buffers: &[Vec<u8>],
) -> Result<Vec<DAffine3>, String> {
    let joints: Vec<Node<'_>> = skin.joints().collect();
    let inverse = match skin.inverse_bind_matrices() {
        None => vec![DAffine3::IDENTITY; joints.len()],
        Some(accessor) => {
            let columns: Vec<[[f32; 4]; 4]> = items::<Columns>(accessor, MAT4, buffers)?
                .into_iter()
                .map(|c| c.0)
                .collect();
            columns
                .iter()
                .map(|c| {
                    DAffine3::from_mat4(DMat4::from_cols_array_2d(&c.map(|c| c.map(f64::from))))
                })
                .collect()
        }
    };
    if inverse.len() < joints.len() {
        return Err(format!(
            "a skin has {} joints and {} inverse bind matrices",
            joints.len(),
            inverse.len()
        ));
    }
    joints
        .iter()
        .zip(inverse)
        .map(|(joint, inverse)| {
            let world = world_from_node.get(joint.index()).copied().flatten();
            world
                .map(|world| world * inverse)
                .ok_or_else(|| format!("joint {} is not in the scene", joint.index()))
        })
        .collect()
}

/// A 4 x 4 matrix as an item of an accessor.
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

/// The pulls on every vertex of a primitive; `None` if it has none.
pub(super) fn pulls(
    primitive: &Primitive<'_>,
    buffers: &[Vec<u8>],
) -> Result<Option<Vec<Pull>>, String> {
    let mut pulls: Vec<Pull> = Vec::new();
    let reader = primitive.reader(|b| buffers.get(b.index()).map(Vec::as_slice));
    for set in 0.. {
        let (Some(joints), Some(weights)) = (
            primitive.get(&Semantic::Joints(set)),
            primitive.get(&Semantic::Weights(set)),
        ) else {
            break;
        };
        check(&joints, JOINTS, buffers)?;
        check(&weights, WEIGHTS, buffers)?;
        let (Some(joints), Some(weights)) = (reader.read_joints(set), reader.read_weights(set))
        else {
            break;
        };
        let both = joints.into_u16().zip(weights.into_f32());
        for (vertex, (joints, weights)) in both.enumerate() {
            if pulls.len() <= vertex {
                pulls.push(Pull::new());
            }
            let pull = joints.into_iter().zip(weights).filter(|(_, w)| *w > 0.0);
            pulls[vertex].extend(pull);
        }
    }
    Ok((!pulls.is_empty()).then_some(pulls))
}

/// Where the mesh goes in rest pose. If all joints in use agree, they place it as a whole and it is left as it is;
/// otherwise it is moved vertex by vertex and placed as it then stands.
pub(super) fn pose(
    mesh: &mut Mesh,
    pulls: &[Pull],
    palette: &[DAffine3],
    world_from_node: DAffine3,
) -> Result<DAffine3, String> {
    let used = || pulls.iter().flatten().map(|(joint, _)| *joint);
    if let Some(joint) = used().find(|j| usize::from(*j) >= palette.len()) {
        return Err(format!(
            "a vertex follows joint {joint}, its skin has {}",
            palette.len()
        ));
    }
    let Some(first) = used().next().map(|j| palette[usize::from(j)]) else {
        return Ok(world_from_node);
    };
    let all_pulled = pulls.len() == mesh.positions.len() && pulls.iter().all(|p| !p.is_empty());
    if all_pulled && used().all(|j| alike(&palette[usize::from(j)], &first)) {
        return Ok(first);
    }
    let moves: Vec<DAffine3> = (0..mesh.positions.len())
        .map(|v| {
            pulls
                .get(v)
                .map_or(world_from_node, |p| blended(p, palette, world_from_node))
        })
        .collect();
    for (p, by) in mesh.positions.iter_mut().zip(&moves) {
        *p = by.transform_point3(*p);
    }
    if let Some(normals) = &mut mesh.corner_normals {
        for (corners, t) in normals.iter_mut().zip(&mesh.triangles) {
            for (n, v) in corners.iter_mut().zip(t) {
                let by = moves
                    .get(*v as usize)
                    .copied()
                    .unwrap_or(DAffine3::IDENTITY);
                *n = by
                    .transform_vector3(n.as_dvec3())
                    .normalize_or_zero()
                    .as_vec3();
            }
        }
    }
    Ok(DAffine3::IDENTITY)
}

fn alike(a: &DAffine3, b: &DAffine3) -> bool {
    let (a, b) = (a.to_cols_array(), b.to_cols_array());
    let largest = a.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
    a.iter()
        .zip(b)
        .all(|(a, b)| (a - b).abs() <= SAME_MATRIX * largest)
}

fn blended(pull: &Pull, palette: &[DAffine3], otherwise: DAffine3) -> DAffine3 {
    let sum: f64 = pull.iter().map(|(_, w)| f64::from(*w)).sum();
    if sum <= 0.0 {
        return otherwise;
    }
    let mut matrix3 = DMat3::ZERO;
    let mut translation = DVec3::ZERO;
    for (joint, weight) in pull {
        let share = f64::from(*weight) / sum;
        matrix3 += palette[usize::from(*joint)].matrix3 * share;
        translation += palette[usize::from(*joint)].translation * share;
    }
    DAffine3 {
        matrix3,
        translation,
    }
}
