//! Poses applied on the CPU, in f64: what the exact reference is given.
//!
//! Written from the definitions alone and sharing nothing with the GPU's pose pass, so that each can be held against the other.
//! Cost: time in proportion to positions times targets and pulls.

use std::borrow::Cow;

use glam::{DMat3, DVec3};
use rayon::prelude::*;

use super::{Motion, Pose};
use crate::scene::{Mesh, Part};

impl Part {
    /// The mesh as it stands in the part's pose, in part space. Corner normals are those of the rest pose: they shade and
    /// decide nothing.
    pub fn posed_mesh(&self) -> Cow<'_, Mesh> {
        if self.pose.is_rest() {
            return Cow::Borrowed(&self.mesh);
        }
        let still = Motion::default();
        let motion = self.motion.as_deref().unwrap_or(&still);
        let positions = (0..self.mesh.positions.len())
            .into_par_iter()
            .map(|i| posed(motion, &self.pose, i, self.mesh.positions[i]))
            .collect();
        Cow::Owned(Mesh {
            positions,
            triangles: self.mesh.triangles.clone(),
            corner_normals: self.mesh.corner_normals.clone(),
        })
    }
}

fn posed(motion: &Motion, pose: &Pose, index: usize, rest: DVec3) -> DVec3 {
    let mut point = rest;
    let mut normal = motion.outward.get(index).copied().unwrap_or_default();
    for (target, weight) in motion.targets.iter().zip(&pose.weights) {
        point += target[index] * *weight;
    }
    let pulls = motion.pulls_of(index);
    if !pulls.is_empty() && !pose.joints.is_empty() {
        let mut linear = DMat3::ZERO;
        let mut moved = DVec3::ZERO;
        for pull in pulls {
            let joint = &pose.joints[usize::from(pull.joint)];
            linear += joint.matrix3 * f64::from(pull.weight);
            moved += joint.translation * f64::from(pull.weight);
        }
        point = linear * point + moved;
        normal = cofactors(linear) * normal;
    }
    for deformer in &pose.deformers {
        (point, normal) = deformer.apply(point, normal);
    }
    point
}

/// What takes normals where a matrix takes points.
fn cofactors(m: DMat3) -> DMat3 {
    let [a, b, c] = [m.x_axis, m.y_axis, m.z_axis];
    DMat3::from_cols(b.cross(c), c.cross(a), a.cross(b))
}
