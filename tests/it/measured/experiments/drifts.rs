//! Flicker counted on layers that are made up.

use cutaway::layers::{Kind, Layers};
use cutaway_lab::Exact;
use cutaway_lab::exact::evaluate;
use cutaway_lab::experiment::SceneAtTime;
use cutaway_lab::experiment::drift::Flicker;

use super::common::scenes::sectioned;

/// Exact of anything, with other layers in its place.
fn exact(layers: &Layers) -> Exact {
    let shown = SceneAtTime::new(&sectioned("cube", &["-z=50%"]));
    let view = shown.model.prepared.view(layers.size_px);
    let mut exact = evaluate(shown.truth().unwrap(), &view);
    exact.layers = layers.clone();
    exact.undecided = vec![false; layers.pixels.len()];
    exact
}

fn layers(caps: &[usize]) -> Layers {
    let mut layers = Layers::background([4, 1]);
    for at in caps {
        layers.pixels[*at].kind = Kind::Cap;
    }
    layers
}

#[test]
fn excess_is_where_only_one_of_the_two_changes() {
    for (exact_caps, drawn_caps, expected) in [
        // Both change alike.
        ([&[0][..], &[1]], [&[0][..], &[1]], [2, 2, 0]),
        // Nothing changes.
        ([&[0], &[0]], [&[2], &[2]], [0, 0, 0]),
        // The strategy flickers.
        ([&[0], &[0]], [&[0], &[0, 3]], [1, 0, 1]),
        // The strategy stands still where exact moves.
        ([&[0], &[0, 3]], [&[0], &[0]], [0, 1, 1]),
    ] {
        let [exact_before, exact_after] = exact_caps.map(|c| exact(&layers(c)));
        let [before, after] = drawn_caps.map(layers);
        let mut flicker = Flicker::default();
        flicker.add([(&exact_before, &before), (&exact_after, &after)]);
        assert_eq!([flicker.px, flicker.exact_px, flicker.excess_px], expected);
        // Where exact is not sure, nothing is called excess.
        let mut unsure = exact_after;
        unsure.undecided = vec![true; 4];
        let mut flicker = Flicker::default();
        flicker.add([(&exact_before, &before), (&unsure, &after)]);
        assert_eq!(
            [flicker.px, flicker.exact_px, flicker.excess_px],
            [expected[0], expected[1], 0]
        );
    }
}
