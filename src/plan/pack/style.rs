//! The numbers of a style.

use bytemuck::{Pod, Zeroable};

use super::Layout;

shared! {
    /// How a picture looks: `shaders/lib/effects/style.wgsl`. Colours are in linear light.
    Style {
        /// Of strokes and hatches.
        ink: [f32; 4],
        /// What is behind the model; alpha 0 for nothing.
        paper: [f32; 4],
        /// Cool blue, warm yellow, and the shares of the own colour in cool and in warm light.
        gooch: [f32; 4],
        /// Half the widths of strokes in pixels, by the class of the border less one.
        stroke_halves: [[f32; 4]; 2],
        /// Cosine of the least fold that is a crease.
        crease_cos: f32,
        /// The least jump in depth that is a contour, in widths of a pixel.
        depth_px: f32,
        /// How much of the light a cap takes.
        cap_light: f32,
        /// How much of that hangs on where it faces.
        cap_relief: f32,
        /// How many pixels away a border may be whose stroke is seen.
        stroke_reach_px: i32,
        /// How many samples a pixel of the picture has along each side.
        fineness: f32,
        /// How much of occlusion surfaces have.
        occlusion_surface: f32,
        /// How much of it caps have.
        occlusion_cap: f32,
        /// Unit vectors across the lines of engraving, and about the distance from line to line in pixels.
        engraving: [[f32; 4]; 2],
    }
}
