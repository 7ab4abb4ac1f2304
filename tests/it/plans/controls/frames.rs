//! Faults planted in a frame that was right, and the proof that the two frames compared come from different places.

use cutaway::layers::{Kind, Layer, Layers};
use cutaway::scene::Scene;
use cutaway::strategies::Strategy;

use crate::common::{Judged, Question, is_wrong, scenes, strategy};

fn scene() -> Scene {
    scenes::sectioned("earth?subdivisions=3", &["-0.4,-0.3,-1@50%,50%,50%"])
}

fn right() -> (Question, Judged) {
    let question = Question::new(&scene(), [96; 2]);
    let judged = question.answer(Strategy::RAYCAST_MASK);
    assert_eq!(
        judged.fault_of_exact(),
        None,
        "the frame that the others are made from"
    );
    (question, judged)
}

fn with(layers: &Layers, pixel: usize, change: impl FnOnce(&mut Layer)) -> Layers {
    let mut layers = layers.clone();
    change(&mut layers.pixels[pixel]);
    layers
}

#[test]
fn one_changed_pixel_is_found() {
    let (question, judged) = right();
    let decided_of = |kind: Kind| {
        let pixels = judged.layers.pixels.iter().enumerate();
        let mut fitting = pixels.filter(|(i, p)| p.kind == kind && !judged.exact.undecided[*i]);
        fitting.next().expect("a decided pixel of each kind").0
    };
    type Change = fn(&mut Layer);
    let changes: [(Kind, Change); 7] = [
        (Kind::Cap, |p| p.kind = Kind::Surface),
        (Kind::Cap, |p| p.kind = Kind::Background),
        (Kind::Cap, |p| p.part ^= 1),
        (Kind::Cap, |p| p.clip_surface += 1),
        (Kind::Surface, |p| p.back_face = true),
        (Kind::Surface, |p| p.part ^= 1),
        (Kind::Background, |p| p.kind = Kind::Cap),
    ];
    for (number, (kind, change)) in changes.into_iter().enumerate() {
        let layers = with(&judged.layers, decided_of(kind), change);
        assert_eq!(
            question.compare(&layers).decided_wrong_px,
            1,
            "change {number}"
        );
    }
    let layers = with(&judged.layers, 0, |p| p.unreliable = true);
    assert_eq!(question.compare(&layers).odd_parity_px, 1, "an odd pixel");
    let cap = decided_of(Kind::Cap);
    let layers = with(&judged.layers, cap, |p| p.depth *= 1.01);
    let before = judged.comparison.depth_error_max;
    assert!(
        question.compare(&layers).depth_error_max > 100.0 * before,
        "a depth that is off"
    );
}

#[test]
fn cracks_are_counted_among_decided_pixels() {
    let (question, judged) = right();
    let covered = |i: &usize| judged.exact.layers.pixels[*i].kind != Kind::Background;
    let all = 0..judged.layers.pixels.len();
    let hole = |i: usize| with(&judged.layers, i, |p| *p = Layer::default());
    let width = judged.layers.size_px[0] as usize;
    let is_sky = |i: usize| judged.exact.layers.pixels[i].kind == Kind::Background;
    // Not beside an outline, which may move by a pixel.
    let within = |i: &usize| {
        let rows = [i - width, *i, i + width];
        rows.iter().all(|r| !(r - 1..r + 2).any(is_sky))
    };
    let decided = (all.clone().filter(covered))
        .filter(|i| (width..all.end - width).contains(i))
        .filter(within)
        .find(|i| !judged.exact.undecided[*i]);
    assert_eq!(
        question
            .compare(&hole(decided.expect("a decided pixel")))
            .crack_px,
        1,
        "a hole"
    );
    let open = all.filter(covered).find(|i| judged.exact.undecided[*i]);
    assert_eq!(
        question
            .compare(&hole(open.expect("an undecided pixel")))
            .crack_px,
        0,
        "an outline"
    );
}

#[test]
fn undecided_pixels_do_not_hide_a_shift_of_one_pixel() {
    let (question, judged) = right();
    let mut shifted = judged.layers.clone();
    shifted.pixels.rotate_right(1);
    let wrong = question.compare(&shifted).decided_wrong_px;
    assert!(
        wrong > question.boundary_px() / 8,
        "a shifted frame has only {wrong} wrong pixels"
    );
}

#[test]
fn what_is_compared_comes_from_two_places() {
    let (question, judged) = right();
    // The strategy's depths went through f32, those of exact never did.
    let is_f32 = |depth: f64| f64::from(depth as f32).to_bits() == depth.to_bits();
    let covered: Vec<usize> = (0..judged.layers.pixels.len())
        .filter(|i| judged.layers.pixels[*i].kind != Kind::Background)
        .collect();
    let found = covered
        .iter()
        .filter(|i| is_f32(judged.layers.pixels[**i].depth))
        .count();
    let truth = covered
        .iter()
        .filter(|i| is_f32(judged.exact.layers.pixels[**i].depth))
        .count();
    assert_eq!(found, covered.len(), "depths of the strategy are f32");
    assert!(
        truth < covered.len() / 100,
        "{truth} depths of exact are f32"
    );
    assert!(
        judged.comparison.depth_error_max > 0.0,
        "two computations do not agree to the bit"
    );
    // An image against itself has no error at all: that is how such a comparison would give itself away.
    let itself = question.compare(&question.exact.layers);
    assert_eq!(
        (itself.wrong_px(), itself.depth_error_max),
        (0, 0.0),
        "exact against itself"
    );
}

#[test]
fn the_two_definitions_of_wrong_agree() {
    let question = Question::new(&scene(), [96; 2]);
    for name in ["raycast+mask", "grid:8+vds:32"] {
        let judged = question.answer(strategy(name));
        let counted = judged.decided_wrong().count();
        assert_eq!(counted, judged.comparison.decided_wrong_px, "{name}");
        assert_eq!(
            counted > 0,
            name != "raycast+mask",
            "{name} has {counted} wrong pixels"
        );
    }
    assert!(
        is_wrong(
            &Layer::default(),
            &Layer {
                kind: Kind::Cap,
                ..Layer::default()
            }
        ),
        "a cap over nothing"
    );
}
