//! Parameters of a style.

use bytemuck::{Pod, Zeroable};

use super::Layout;

shared! {
    /// Look of a picture: `shaders/lib/effects/style.wgsl`. Colours are in linear light.
    Style {
        /// Colour of strokes and hatches.
        ink: [f32; 4],
        /// Colour behind the model; alpha 0 for none.
        paper: [f32; 4],
        /// Cool blue, warm yellow, and the shares of the part's own colour in cool and in warm light.
        gooch: [f32; 4],
        /// Half the stroke widths in pixels, indexed by border class minus one.
        stroke_halves: [[f32; 4]; 2],
        /// Cosine of the smallest fold angle that counts as a crease.
        crease_cos: f32,
        /// Smallest depth jump that counts as a contour, in pixel widths.
        depth_px: f32,
        /// Weight of light on caps.
        cap_light: f32,
        /// Share of that light that depends on the orientation of the cap.
        cap_relief: f32,
        /// Largest distance in pixels from a border at which its stroke is visible.
        stroke_reach_px: i32,
        /// Samples per picture pixel along each axis.
        fineness: f32,
        /// Weight of occlusion on surfaces.
        occlusion_surface: f32,
        /// Weight of occlusion on caps.
        occlusion_cap: f32,
        /// Unit vectors across the engraving lines, and the approximate line spacing in pixels.
        engraving: [[f32; 4]; 2],
    }
}
