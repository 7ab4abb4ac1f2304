//! The numbers of a style.

use bytemuck::{Pod, Zeroable};

use super::Layout;

shared! {
    /// Look of a picture: `shaders/lib/effects/style.wgsl`. Colours are in linear light.
    Style {
        /// Colour of strokes and hatches.
        ink: [f32; 4],
        /// Colour behind the model; alpha 0 for nothing.
        paper: [f32; 4],
        /// Cool blue, warm yellow, and the shares of the own colour in cool and in warm light.
        gooch: [f32; 4],
        /// Half the widths of strokes in pixels, by the class of the border less one.
        stroke_halves: [[f32; 4]; 2],
        /// Cosine of the least fold that is a crease.
        crease_cos: f32,
        /// The least jump in depth that is a contour, in widths of a pixel.
        depth_px: f32,
        /// Weight of light on caps.
        cap_light: f32,
        /// Share of that light that depends on the facing of the cap.
        cap_relief: f32,
        /// Largest distance, in pixels, of a border whose stroke is seen.
        stroke_reach_px: i32,
        /// Samples per pixel of the picture along each side.
        fineness: f32,
        /// Weight of occlusion on surfaces.
        occlusion_surface: f32,
        /// Weight of occlusion on caps.
        occlusion_cap: f32,
        /// Unit vectors across the lines of engraving, and about the distance from line to line in pixels.
        engraving: [[f32; 4]; 2],
    }
}
