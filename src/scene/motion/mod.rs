//! What moves the vertices of a part: morph targets, a skin and deformers, and the pose they take at one time.
//!
//! A [`Motion`] is what is known beforehand, per position of the part's mesh; a [`Pose`] is the small rest that changes from
//! time to time, in f64. Two paths apply a pose: [`Part::posed_mesh`] in f64 on the CPU, which the exact reference is given,
//! and the pose pass of a frame in f32 on the GPU. They share the numbers of the pose and nothing else.
//!
//! The order is fixed: rest, plus weighted targets, then the blend of the joints (linear blend skinning), then deformers in
//! their order; all in part space. The placement of the part follows. Normals go with the cofactors of what was applied.

mod deform;
mod outward;
mod pose;
mod rig;

pub use deform::{Axis, Deformer};
pub use rig::Clip;

use glam::{DAffine3, DVec3};

/// One joint's share of a position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pull {
    /// Index into [`Pose::joints`].
    pub joint: u16,
    /// Share; those of a position sum to 1.
    pub weight: f32,
}

/// What is known beforehand of how a mesh moves, per position of [`Part::mesh`](super::Part::mesh).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Motion {
    /// Morph targets: how far each moves every position at weight 1, in part space.
    pub targets: Vec<Vec<DVec3>>,
    /// Where the pulls of each position begin, and one more for the end; empty without a skin.
    pub first_pull: Vec<u32>,
    /// Pulls of all positions, one after the other.
    pub pulls: Vec<Pull>,
    /// Unit vectors out of the rest mesh, as [`Mesh::outward`](super::Mesh::outward) finds them; empty unless something
    /// inflates the part.
    pub outward: Vec<DVec3>,
}

impl Motion {
    /// The pulls on a position; none without a skin.
    pub fn pulls_of(&self, position: usize) -> &[Pull] {
        match (
            self.first_pull.get(position),
            self.first_pull.get(position + 1),
        ) {
            (Some(first), Some(end)) => &self.pulls[*first as usize..*end as usize],
            _ => &[],
        }
    }
}

/// How a mesh stands at one time. The default is the rest pose.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pose {
    /// Weights of [`Motion::targets`].
    pub weights: Vec<f64>,
    /// Where each joint takes what follows it, in part space.
    pub joints: Vec<DAffine3>,
    /// Applied last, in order.
    pub deformers: Vec<Deformer>,
}

impl Pose {
    /// Whether it leaves the mesh as it is.
    pub fn is_rest(&self) -> bool {
        self.joints.is_empty()
            && self.deformers.is_empty()
            && self.weights.iter().all(|w| w.abs() <= 0.0)
    }
}
