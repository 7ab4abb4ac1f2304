//! Parameters of a ghost.

use bytemuck::{Pod, Zeroable};

use super::Layout;

shared! {
    /// Look of removed parts: `shaders/lib/effects/ghost_look.wgsl`.
    Ghost {
        /// Colour of lines and glass, linear light.
        color: [f32; 4],
        /// Half the line width in pixels.
        half_px: f32,
        /// Opacity of lines.
        alpha: f32,
        /// Strength of glass.
        glass: f32,
        /// Line widths per scene unit.
        widths_per_unit: f32,
    }
}
