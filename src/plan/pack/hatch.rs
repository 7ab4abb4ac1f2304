//! Hatches: the planes on which they are drawn, and the hatch of each part.

use bytemuck::{Pod, Zeroable};

use super::Layout;
use crate::scene::MOST_STROKES;

shared! {
    /// The plane of a clip-surface: `shaders/lib/colors/cap_plane.wgsl`.
    CapPlane {
        /// Gives the first coordinate of a point in the plane, in scene units.
        u_row: [f32; 4],
        /// Gives the second coordinate of a point in the plane.
        v_row: [f32; 4],
        /// Normal of the plane; the last component is 1 for a cutter, whose faces lie in several planes.
        normal: [f32; 4],
    }
}

/// Maximum number of clip-surfaces that layers can number.
pub const MOST_HATCH_PLANES: usize = 256;

shared! {
    /// The planes of all clip-surfaces.
    HatchPlanes {
        /// By clip-surface number.
        planes: [CapPlane; MOST_HATCH_PLANES],
        /// Number of planes.
        count: u32,
        /// Scene units per pixel of the picture in which the scene was first seen.
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
        /// Line colour, linear light.
        color: [f32; 4],
        /// Number of its first line family.
        first_line: u32,
        /// Number of line families; if 0, the cap is filled.
        line_count: u32,
        /// Opacity of the lines' ink.
        alpha: f32,
        /// Line width in pixels.
        width_px: f32,
        /// Rotation of the part since its lines were placed, as a quaternion.
        turned: [f32; 4],
        /// The part's middle at that time, in scene space; the last component is 1 if it has moved.
        start: [f32; 4],
        /// The part's middle now.
        end: [f32; 4],
    }
}

shared! {
    /// A line family.
    HatchLine {
        /// Direction across the lines in plane coordinates, in units of the line spacing.
        across: [f32; 2],
        /// Direction along the lines, in units of the dash period.
        along: [f32; 2],
        /// Offset added across the lines.
        phase: f32,
        /// Offset added along the lines.
        dash_phase: f32,
        /// Shift of each line along itself relative to the previous one, in dash periods.
        shift: f32,
        /// Number of strokes in a dash period; 0 for a solid line.
        dash_count: u32,
        /// Stroke centres, in dash periods.
        dash_centres: [f32; MOST_STROKES],
        /// Stroke lengths, in dash periods; 0 for a dot.
        dash_lengths: [f32; MOST_STROKES],
    }
}
