//! Promise: `planar`, which slices on the CPU, draws what exact and `raycast+mask` draw, wherever planes cut; it slices what is
//! new and nothing else, plans the least, and says what it does not do.

mod agree;
mod clocks;
use crate::common;
mod marks;
mod outlines;
mod plans;
mod real;

use common::Judged;
use cutaway::layers::Layer;

/// Pixels that are decided and differ between two frames of one question.
fn decided_differing(a: &Judged, b: &Judged, differ: impl Fn(&Layer, &Layer) -> bool) -> usize {
    let pixels = a.layers.pixels.iter().zip(&b.layers.pixels);
    pixels
        .zip(&a.exact.undecided)
        .filter(|((a, b), undecided)| !**undecided && differ(a, b))
        .count()
}
