//! The numbers of the ground.

use bytemuck::{Pod, Zeroable};

use super::Layout;

shared! {
    /// A level ground and the map of its shadow: `shaders/effects/ground.wgsl`.
    Ground {
        /// From a point of the scene to the column of the map.
        x_row: [f32; 4],
        /// To the row of the map.
        y_row: [f32; 4],
        /// To the height above the ground.
        up: [f32; 4],
        /// Columns and rows of the map.
        side: u32,
        /// How much of the light is missing where it is darkest.
        strength: f32,
        /// Unused.
        padding_a: u32,
        /// Unused.
        padding_b: u32,
    }
}
