//! What is said of a frame that is not as somebody may expect.

use super::console::Console;
use super::open::Opened;
use super::sections::{misses, words_of};
use crate::layers::{Kind, Layers};

/// Pixels that the strategy does not vouch for.
pub(super) fn unreliable_px(layers: &Layers) -> usize {
    layers.pixels.iter().filter(|p| p.unreliable).count()
}

/// Warns of pixels that nobody vouches for.
pub(super) fn warn_of_doubt(layers: &Layers, console: &Console) {
    match unreliable_px(layers) {
        0 => {}
        unreliable => console.warn(format!(
            "{unreliable} pixels cannot be vouched for: along their rays the mesh is open, or a buffer was too small\n  mend: \
             `cutaway inspect` says where it is open; close the holes"
        )),
    }
}

/// An empty picture, or one without caps, is nearly always a slip of the camera or of the side that stays.
pub(super) fn note_what_is_not_seen(layers: &Layers, opened: &Opened, console: &Console) {
    let bounds = opened.scene.bounds();
    let mut enabled = opened.scene.cuts.iter().filter(|c| c.enabled);
    if misses(&opened.scene).next().is_some() {
        // That has been said.
    } else if layers.count(Kind::Background) == layers.pixels.len() {
        console.warn(format!(
            "the picture is empty: all of the model is cut away or outside the view\n  bounds: {}\n  mend: keep the \
             other side (--flip), move the section, or leave the camera options out",
            words_of(&bounds)
        ));
    } else if enabled.next().is_some() && layers.count(Kind::Cap) == 0 {
        console.note(
            "no cap is seen in this picture: the cut misses the solid, or is seen from behind (see \
             --camera-azimuth-angle and --flip)",
        );
    }
}
