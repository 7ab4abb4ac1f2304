//! The shared struct and constants of pyramids over offset maps.

use bytemuck::{Pod, Zeroable};

use super::Layout;

/// Lowest stored level: within its blocks rays go from cell to cell. Also in `shaders/lib/reliefs/pyramid.wgsl`.
pub const LOWEST: u32 = 2;
/// Nodes along a side of a workgroup, at the lowest level of a pass: `shaders/passes/pyramid.wgsl`.
pub const SIDE: u32 = 16;

shared! {
    /// The pyramid of a clip-surface's map: `shaders/lib/reliefs/pyramid.wgsl`.
    Pyramid {
        /// First texel in the heights buffer.
        first_texel: u32,
        /// Number of levels; 0 for a plane.
        levels: u32,
        /// Width and height of the map.
        map_size: [u32; 2],
        /// 1 if the map repeats.
        repeats: u32,
        /// 1 in the first of the rows that share this pyramid.
        is_own: u32,
        /// Unused.
        padding: [u32; 2],
        /// First node of each level, from level 1, which is not stored.
        first_node: [[u32; 4]; 4],
    }
}
