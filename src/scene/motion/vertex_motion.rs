//! Data that can move the vertices of a mesh, and their pose at one time: plain data.

use std::sync::Arc;

use glam::{DAffine3, DVec3};

use super::Deformer;

/// One joint's share of a position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointWeight {
    /// Index into [`Pose::joints`].
    pub joint: u16,
    /// Share; those of a position sum to 1.
    pub weight: f32,
}

/// Constant data of a mesh's motion, per position of [`Part::mesh`](crate::scene::Part::mesh).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Motion {
    /// Morph targets: how far each moves every position at weight 1, in part space.
    pub targets: Vec<Vec<DVec3>>,
    /// Index of the first pull of each position, and one more for the end; empty without a skin.
    pub first_pull: Vec<u32>,
    /// Pulls of all positions, one after the other.
    pub pulls: Vec<JointWeight>,
    /// Unit vectors out of the rest mesh, as [`Mesh::outward`](crate::scene::Mesh::outward) finds them; empty unless something
    /// inflates the part.
    pub outward: Vec<DVec3>,
}

/// Returns true if two parts share the same motion object, or both have none; equal but separate objects are not compared.
pub fn is_same_motion(a: Option<&Arc<Motion>>, b: Option<&Arc<Motion>>) -> bool {
    match (a, b) {
        (Some(a), Some(b)) => Arc::ptr_eq(a, b),
        (None, None) => true,
        _ => false,
    }
}

impl Motion {
    /// The pulls on a position; none without a skin, or where the lists are not what they should be.
    pub fn pulls_of(&self, position: usize) -> &[JointWeight] {
        let bounds = self.first_pull.get(position..position + 2);
        let Some(&[first, end]) = bounds else {
            return &[];
        };
        let pulls = self.pulls.get(first as usize..end as usize);
        pulls.unwrap_or_default()
    }

    /// Displacement of a position by a target at weight 1; zero if the target lacks the position.
    #[doc(hidden)]
    pub fn displacement(&self, target: usize, position: usize) -> DVec3 {
        let of_target = self.targets.get(target);
        of_target
            .and_then(|t| t.get(position))
            .copied()
            .unwrap_or_default()
    }

    /// Motion of a choice of the positions, in the order of the choice.
    #[doc(hidden)]
    pub fn of_positions(&self, chosen: &[u32]) -> Self {
        let of_target = |t| {
            chosen
                .iter()
                .map(|i| self.displacement(t, *i as usize))
                .collect()
        };
        let mut motion = Self {
            targets: (0..self.targets.len()).map(of_target).collect(),
            ..Self::default()
        };
        if !self.first_pull.is_empty() {
            motion.first_pull.push(0);
            for i in chosen {
                motion.pulls.extend_from_slice(self.pulls_of(*i as usize));
                motion.first_pull.push(motion.pulls.len() as u32);
            }
        }
        motion
    }
}

/// Pose of a mesh at one time. The default is the rest pose.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pose {
    /// Weights of [`Motion::targets`].
    pub weights: Vec<f64>,
    /// Transforms of vertices by each joint, in part space.
    pub joints: Vec<DAffine3>,
    /// Applied last, in order.
    pub deformers: Vec<Deformer>,
}

impl Pose {
    /// Returns true if it leaves the mesh as it is.
    pub fn is_rest(&self) -> bool {
        self.joints.is_empty()
            && self.deformers.is_empty()
            && self.weights.iter().all(|w| w.abs() <= 0.0)
    }
}
