//! The shared struct and constants of pyramids over offset maps.

use bytemuck::{Pod, Zeroable};

use super::Layout;

/// The lowest level that is kept: within its blocks rays go from cell to cell. In `shaders/lib/reliefs/pyramid.wgsl` as well.
pub const LOWEST: u32 = 2;
/// Nodes of the lowest level of a pass along a side of its workgroups: `shaders/passes/pyramid.wgsl`.
pub const SIDE: u32 = 16;

shared! {
    /// The pyramid of the map of a clip-surface: `shaders/lib/reliefs/pyramid.wgsl`.
    Pyramid {
        /// First texel in the heights buffer.
        first_texel: u32,
        /// Number of levels; 0 for a plane.
        levels: u32,
        /// Width and height of the map.
        map_size: [u32; 2],
        /// 1 where the map repeats.
        repeats: u32,
        /// 1 in the first row of those that share a pyramid.
        is_own: u32,
        /// Unused.
        padding: [u32; 2],
        /// First node of each level, level 1 first, which is not kept.
        first_node: [[u32; 4]; 4],
    }
}
