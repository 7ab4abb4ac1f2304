//! The numbers of a ghost.

use bytemuck::{Pod, Zeroable};

use super::Layout;

shared! {
    /// How what is removed looks: `shaders/lib/effects/ghost_look.wgsl`.
    Ghost {
        /// Of lines and glass, linear light.
        color: [f32; 4],
        /// Half the width of a line in pixels.
        half_px: f32,
        /// How much of the colour a line has.
        alpha: f32,
        /// How much glass is seen.
        glass: f32,
        /// Widths of a line in a scene unit.
        widths_per_unit: f32,
    }
}
