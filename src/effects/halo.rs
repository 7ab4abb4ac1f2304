//! Reach of effects beyond a band of the picture.

use super::borders::RAMP_PX;
use super::ghost;
use super::style_numbers::reach_px;
use crate::scene::Style;

/// Rows around a band that effects read, in a picture of `rows` rows.
pub(super) fn halo_rows(style: &Style, rows: u32) -> u32 {
    let of_strokes = match style.strokes.widest() > 0.0 {
        // Beyond a stroke's reach, RAMP_PX more borders determine its position, and two samples around each determine its class.
        true => reach_px(style, rows) as u32 + RAMP_PX + 4,
        false => 0,
    };
    of_strokes.max(ghost::halo_rows(style, rows))
}
