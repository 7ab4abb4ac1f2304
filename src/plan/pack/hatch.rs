//! Hatches: planes that carry them, and what each part has.

use bytemuck::{Pod, Zeroable};

use super::Layout;

shared! {
    /// The plane of a clip-surface: `shaders/lib/cap_pattern/hatch.wgsl`.
    HatchPlane {
        /// First coordinate of a point in the plane, in scene units.
        u_row: [f32; 4],
        /// Second coordinate.
        v_row: [f32; 4],
        /// Its normal; the last is 1 where there is no one plane but the faces of a cutter.
        normal: [f32; 4],
    }
}

shared! {
    /// The hatch of a part.
    PartHatch {
        /// Across the lines, in coordinates of the plane: in units of the distance from line to line.
        across: [f32; 2],
        /// Width of a line in pixels.
        width_px: f32,
        /// How much of the ink it has; a solid part has all of its cap in it.
        alpha: f32,
        /// 1 where the cap is filled.
        is_solid: u32,
        /// Unused.
        padding: u32,
        /// Unused.
        padding_b: u32,
        /// Unused.
        padding_c: u32,
        /// Of lines, linear light.
        color: [f32; 4],
    }
}
