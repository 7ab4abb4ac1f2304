//! The shared struct of pyramids over offset maps.

use bytemuck::{Pod, Zeroable};

use super::Layout;

shared! {
    /// The pyramid of the map of a clip-surface: `shaders/lib/pyramid.wgsl`.
    Pyramid {
        /// First texel in the heights buffer.
        first_texel: u32,
        /// How many levels; 0 for a plane.
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
