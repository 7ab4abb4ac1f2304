//! Pose of a part in the layout of `shaders/lib/vertices/pose.wgsl` and `shaders/lib/vertices/deformers.wgsl`.

use bytemuck::{Pod, Zeroable};

use super::Layout;

shared! {
    /// Pose of a part: `shaders/lib/vertices/pose.wgsl`.
    Pose {
        /// Rows of the placement.
        scene_from_rest: [[f32; 4]; 3],
        /// Number of its first vertex in the shared vertex buffer.
        first_vertex: u32,
        /// Number of vertices.
        vertex_count: u32,
        /// Number of positions.
        position_count: u32,
        /// Number of morph targets with a weight.
        weight_count: u32,
        /// Number of deformers.
        deformer_count: u32,
        /// Number of matrices that joint influences refer to.
        joint_count: u32,
        /// -1 if the placement mirrors, else 1.
        hand: f32,
        /// Unused.
        padding: u32,
    }
}

shared! {
    /// A deformer in rest space: `shaders/lib/vertices/deformers.wgsl`.
    Deformer {
        /// A point on the axis.
        centre: [f32; 4],
        /// Direction of the axis.
        along: [f32; 4],
        across: [f32; 4],
        /// [`TWIST`], [`BEND`], [`WAVE`] or [`INFLATE`].
        kind: u32,
        /// Angle per unit, amplitude or distance.
        amount: f32,
        /// For a wave: radians per unit.
        turn_per_unit: f32,
        /// Phase of a wave, radians.
        phase: f32,
    }
}

/// `kind` of a deformer that turns about its axis.
pub const TWIST: u32 = 0;
/// `kind` of a deformer that rolls its axis into an arc.
pub const BEND: u32 = 1;
/// `kind` of a deformer that oscillates along its axis.
pub const WAVE: u32 = 2;
/// `kind` of a deformer that moves outwards.
pub const INFLATE: u32 = 3;
/// Maximum deformers per part: a uniform table of fixed length.
pub const MOST_DEFORMERS: usize = 16;
