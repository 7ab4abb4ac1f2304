//! Promise: `planar`, which slices on the CPU, draws what exact and `raycast+mask` draw, wherever planes cut; it slices what is
//! new and nothing else, plans the least, and says what it does not do.

#[path = "planar/agree.rs"]
mod agree;
#[path = "planar/clocks.rs"]
mod clocks;
mod common;
#[path = "planar/marks.rs"]
mod marks;
#[path = "planar/outlines.rs"]
mod outlines;
#[path = "planar/plans.rs"]
mod plans;
#[path = "planar/real.rs"]
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
