//! Hatches: planes that carry them, and what each part has.

use bytemuck::{Pod, Zeroable};

use super::Layout;
use crate::scene::MOST_STROKES;

shared! {
    /// The plane of a clip-surface: `shaders/lib/colors/cap_plane.wgsl`.
    CapPlane {
        /// First coordinate of a point in the plane, in scene units.
        u_row: [f32; 4],
        /// Second coordinate.
        v_row: [f32; 4],
        /// Its normal; the last is 1 where there is no one plane but the faces of a cutter.
        normal: [f32; 4],
    }
}

/// Clip-surfaces that layers can number.
pub const MOST_HATCH_PLANES: usize = 256;

shared! {
    /// The planes of all clip-surfaces.
    HatchPlanes {
        /// By the number of the clip-surface.
        planes: [CapPlane; MOST_HATCH_PLANES],
        /// Number of planes.
        count: u32,
        /// Scene units along a pixel of the picture as the scene was first seen.
        unit_px: f32,
        /// Unused.
        padding_b: u32,
        /// Unused.
        padding_c: u32,
    }
}

shared! {
    /// The hatch of a part.
    PartHatch {
        /// Colour of lines, linear light.
        color: [f32; 4],
        /// Its first family of lines.
        first_line: u32,
        /// Number of families; without any the cap is filled.
        line_count: u32,
        /// Opacity of the ink of lines.
        alpha: f32,
        /// Width of a line in pixels.
        width_px: f32,
        /// Rotation of the part since its lines were laid down, a quaternion.
        turned: [f32; 4],
        /// Its middle then, in scene space; the last is 1 where it has moved.
        start: [f32; 4],
        /// Its middle now.
        end: [f32; 4],
    }
}

shared! {
    /// A family of lines.
    HatchLine {
        /// Across the lines, in coordinates of the plane: in units of the distance from line to line.
        across: [f32; 2],
        /// Along them, in units of the distance after which dashes repeat.
        along: [f32; 2],
        /// Added across.
        phase: f32,
        /// Added along.
        dash_phase: f32,
        /// Shift of the next line along itself, in periods of dashes.
        shift: f32,
        /// Number of strokes in a period; 0 for a line without end.
        dash_count: u32,
        /// Their middles, in periods.
        dash_centres: [f32; MOST_STROKES],
        /// Their lengths, in periods; 0 for a dot.
        dash_lengths: [f32; MOST_STROKES],
    }
}
