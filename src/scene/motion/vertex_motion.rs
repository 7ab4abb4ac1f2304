//! Plain data: the motion data of a mesh's vertices, and a pose at one time.

use glam::{DAffine3, DVec3};

use super::Deformer;

/// One joint's influence on a position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointWeight {
    /// Index into [`Pose::joints`].
    pub joint: u16,
    /// Weight; the weights of a position sum to 1.
    pub weight: f32,
}

/// Constant data of a mesh's motion, per position of [`Part::mesh`](crate::scene::Part::mesh).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Motion {
    /// Morph targets: each target's displacement of every position at weight 1, in part space.
    pub targets: Vec<Vec<DVec3>>,
    /// Index of each position's first joint influence, and one more entry for the end; empty without a skin.
    pub first_pull: Vec<u32>,
    /// Joint influences of all positions, one after the other.
    pub pulls: Vec<JointWeight>,
    /// Outward unit vectors of the rest mesh, from [`Mesh::outward`](crate::scene::Mesh::outward); empty unless a deformer inflates
    /// the part.
    pub outward: Vec<DVec3>,
}

impl Motion {
    /// The joint influences on a position; empty without a skin, or if the lists are invalid.
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

    /// The motion data of the chosen positions, in the given order.
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
    /// Vertex transform of each joint, in part space.
    pub joints: Vec<DAffine3>,
    /// Applied last, in order.
    pub deformers: Vec<Deformer>,
}

impl Pose {
    /// Returns true if it leaves the mesh unchanged.
    pub fn is_rest(&self) -> bool {
        self.joints.is_empty()
            && self.deformers.is_empty()
            && self.weights.iter().all(|w| w.abs() <= 0.0)
    }
}
