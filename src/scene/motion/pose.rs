//! Poses applied on the CPU, in f64, for the exact reference.
//!
//! Written from the definitions alone and sharing nothing with the GPU's pose pass, so that the two can be compared.
//! Cost: proportional to positions times targets and joint influences. Applying a pose never fails: a displacement that a
//! target lacks is zero, a joint that the pose lacks is the identity, a weight without a target has no effect.

use glam::{DAffine3, DMat3, DVec3, Vec3};
use rayon::prelude::*;

use super::deformed::deform;
use super::{Motion, Pose};
use crate::scene::Mesh;

/// A mesh in a pose.
pub(in crate::scene) fn posed(mesh: &Mesh, motion: &Motion, pose: &Pose) -> Mesh {
    let blends: Vec<DAffine3> = (0..mesh.positions.len())
        .into_par_iter()
        .map(|i| blend(motion, pose, i))
        .collect();
    let positions = mesh
        .positions
        .par_iter()
        .enumerate()
        .map(|(i, rest)| blends[i].transform_point3(morphed(motion, pose, i, *rest)))
        .collect();
    let turned = |corner: (&u32, Vec3)| {
        let (vertex, normal) = corner;
        match blends.get(*vertex as usize) {
            Some(blend) => (cofactors(blend.matrix3) * normal.as_dvec3())
                .normalize_or_zero()
                .as_vec3(),
            None => normal,
        }
    };
    let corner_normals = mesh.corner_normals.as_ref().map(|all| {
        let both = all.iter().zip(&mesh.triangles);
        both.map(|(n, t)| std::array::from_fn(|k| turned((&t[k], n[k]))))
            .collect()
    });
    let mut posed = Mesh {
        positions,
        triangles: mesh.triangles.clone(),
        corner_normals,
        // The vertex paint is drawn from the rest mesh.
        vertex_paint: None,
    };
    if !pose.deformers.is_empty() {
        let outward: Vec<DVec3> = (blends.iter().enumerate())
            .map(|(i, blend)| {
                let rest = motion.outward.get(i).copied().unwrap_or_default();
                cofactors(blend.matrix3) * rest
            })
            .collect();
        deform(&mut posed, &outward, &pose.deformers);
    }
    posed
}

fn morphed(motion: &Motion, pose: &Pose, index: usize, rest: DVec3) -> DVec3 {
    let weights = pose.weights.iter().enumerate();
    weights.fold(rest, |point, (target, weight)| {
        point + motion.displacement(target, index) * *weight
    })
}

/// Blend of a position's joint transforms.
fn blend(motion: &Motion, pose: &Pose, index: usize) -> DAffine3 {
    let pulls = motion.pulls_of(index);
    if pulls.is_empty() || pose.joints.is_empty() {
        return DAffine3::IDENTITY;
    }
    let mut blend = DAffine3::ZERO;
    for pull in pulls {
        let joint = pose.joints.get(usize::from(pull.joint));
        let joint = joint.copied().unwrap_or(DAffine3::IDENTITY);
        blend.matrix3 += joint.matrix3 * f64::from(pull.weight);
        blend.translation += joint.translation * f64::from(pull.weight);
    }
    blend
}

/// Matrix that transforms normals if `m` transforms points: normals stay perpendicular to the transformed surface.
fn cofactors(m: DMat3) -> DMat3 {
    let [a, b, c] = [m.x_axis, m.y_axis, m.z_axis];
    DMat3::from_cols(b.cross(c), c.cross(a), a.cross(b))
}
