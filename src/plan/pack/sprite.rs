//! The shared struct of volume images, and the frame that draws into them.

use bytemuck::{Pod, Zeroable};
use glam::{Mat4, Vec4};

use super::{Frame, Layout};

shared! {
    /// The box of a part seen along an axis: `shaders/lib/inside_tests/sprite.wgsl`.
    Sprite {
        /// Gives the first texture coordinate.
        s_row: [f32; 4],
        /// Gives the second texture coordinate.
        t_row: [f32; 4],
        /// Gives the depth, 0 to 1.
        depth_row: [f32; 4],
        /// Texels along a side.
        resolution: u32,
        layers: u32,
        /// Index of the word in the need buffer, or of the image among the images of all parts.
        slot: u32,
        /// Unused.
        padding: u32,
    }
}

/// The frame that maps scene space to a sprite, for passes that rasterise into it: they use only clip space and size.
pub fn sprite_frame(sprite: &Sprite) -> Frame {
    let [s, t, depth] = [sprite.s_row, sprite.t_row, sprite.depth_row].map(Vec4::from);
    let rows = Mat4::from_cols(2.0 * s - Vec4::W, Vec4::W - 2.0 * t, depth, Vec4::W);
    Frame {
        clip_from_scene: rows.transpose().to_cols_array(),
        size_px: [sprite.resolution; 2],
        orthographic: 1,
        ..Frame::zeroed()
    }
}
