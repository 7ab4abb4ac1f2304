//! Distance from a band of the picture within which effects read other rows.

use super::borders::RAMP_PX;
use super::ghost;
use super::style_numbers::reach_px;
use crate::scene::Style;

/// Number of rows on each side of a band that effects read, in a picture of `rows` rows.
pub(super) fn halo_rows(style: &Style, rows: u32) -> u32 {
    let of_strokes = match style.strokes.widest() > 0.0 {
        // A stroke's position depends on borders up to RAMP_PX beyond its reach, and the class of each on two samples around it.
        true => reach_px(style, rows) as u32 + RAMP_PX + 4,
        false => 0,
    };
    of_strokes.max(ghost::halo_rows(style, rows))
}
