//! What is said of a frame that is not as somebody may expect.

use super::console::Console;
use crate::experiment::Renderer;
use crate::layers::{Kind, Layers};
use crate::scene::{Scene, empty_picture, misses};

/// Pixels that the strategy marks: crossings along their rays do not tell inside from outside, or a buffer was too small.
pub(super) fn unreliable_px(layers: &Layers) -> usize {
    layers.pixels.iter().filter(|p| p.unreliable).count()
}

/// Warns of pixels that may be wrong because the mesh is open along their rays.
pub(super) fn warn_of_doubt(may_be_wrong: &[bool], renderer: Renderer, console: &Console) {
    let count = may_be_wrong.iter().filter(|w| **w).count();
    if count == 0 {
        return;
    }
    let other = match renderer {
        Renderer::Cpu(_) => "",
        Renderer::Method(_) => ", or see whether --strategy exact shows what you expect",
    };
    console.warn(format!(
        "{count} px may be wrong: the mesh is open along their rays, so that a cap may be missing there or shown where there is \
         none\n  help: --close-holes closes planar and small holes (`cutaway inspect` says where holes are){other}"
    ));
}

/// An empty picture, or one without caps, is nearly always a slip of the camera or of the side that stays.
pub(super) fn note_what_is_not_seen(layers: &Layers, scene: &Scene, console: &Console) {
    let mut enabled = scene.cuts.iter().filter(|c| c.enabled);
    if misses(scene).next().is_some() {
        // That has been said.
    } else if layers.count(Kind::Background) == layers.pixels.len() {
        console.remark(&empty_picture(scene));
    } else if enabled.next().is_some() && layers.count(Kind::Cap) == 0 {
        console.note(
            "no cap is seen in this picture: the cut misses the solid, or is seen from behind (see \
             --camera-azimuth-angle and --flip)",
        );
    }
}
