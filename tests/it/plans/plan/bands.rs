//! A picture that is too large for a limit is drawn in bands, and shows the same.

use cutaway::gpu::ClockSet;
use cutaway::layers::{Kind, Layers};
use cutaway::plan::Limits;
use cutaway::scene::{Camera, Viewpoint};
use cutaway::session::{Drawn, Outcome, Session};
use cutaway::strategies::{DrawOptions, Method, Rasteriser, Unsupported};
use cutaway_io::document::named_style;
use cutaway_lab::experiment::{FrameQuestion, Renderer, SceneAtTime, errors, times};

use super::*;

const SIZE_PX: [u32; 2] = [96, 260];

pub(super) fn cut_scene() -> Scene {
    let mut scene = scene_of(&["cube?divisions=2", "sphere"], vec![reliefs(0.1, 1)]);
    scene.camera = Camera {
        viewpoint: Viewpoint::Orbit {
            azimuth_deg: 210.0,
            elevation_deg: 25.0,
        },
        ..scene.camera
    };
    scene
}

/// A session on a device that binds so many bytes at most.
fn session(storage_binding_bytes: u64) -> Session {
    let gpu = crate::common::gpu();
    let limits = Limits {
        storage_binding_bytes,
        ..Limits::CORE
    };
    Session::new(gpu.held_to(limits))
}

fn draw(session: &mut Session, method: impl Into<Method>) -> Drawn {
    let model = Model::new(&cut_scene());
    let view = model.prepared.view(SIZE_PX);
    let drawn = session.draw(&model, &view, method);
    drawn.unwrap_or_else(|e| panic!("{e}"))
}

pub(super) fn classes(layers: &Layers) -> Vec<(Kind, u16, u8, bool)> {
    let pixels = layers.pixels.iter();
    pixels
        .map(|p| (p.kind, p.part, p.clip_surface, p.back_face))
        .collect()
}

#[test]
fn bands_show_what_one_frame_shows() {
    for name in [
        "raycast+mask",
        "raycast+mask@compute",
        "grid:8+vds:64",
        "grid:8+mask",
        "grid:8+mask@compute",
    ] {
        let method: Method = name.parse().expect("a method");
        let mut whole = session(Limits::CORE.storage_binding_bytes);
        let drawn = draw(&mut whole, method);
        assert_eq!(drawn.outcome, Outcome::Complete, "{method}");
        assert_eq!(whole.bands(method).expect("a frame"), 1, "{method}");
        let expected = whole.layers(method).expect("layers");
        assert!(expected.count(Kind::Cap) > 500, "{method}: caps");

        let expected_picture = whole.picture(method).expect("a picture");

        let plan = whole.plan(method).expect("a plan");
        let largest = |p: &Plan| {
            let of_frame = p.resources.iter().filter(|r| r.clock == Clock::Frame);
            of_frame.map(|r| r.shape.bytes()).max().unwrap_or(0)
        };
        let most = largest(plan);
        for (share, bands) in [(1, 2), (2, 4)] {
            let mut held = session(most / share - 1);
            let drawn = draw(&mut held, method);
            let what = format!("{method} in {bands}");
            assert_eq!(drawn.outcome, Outcome::Complete, "{what}");
            assert_eq!(held.bands(method).expect("a frame"), bands, "{what}");
            let layers = held.layers(method).expect("layers");
            assert_eq!(layers.size_px, SIZE_PX, "{what}");
            assert!(
                classes(&layers) == classes(&expected),
                "{what}: other classes"
            );
            let picture = held.picture(method).expect("a picture");
            assert_eq!(
                picture.len(),
                SIZE_PX[0] as usize * SIZE_PX[1] as usize * 4,
                "{what}"
            );
            // Behind the model is one sky over all bands.
            let colors = picture
                .chunks_exact(4)
                .zip(expected_picture.chunks_exact(4));
            let sky = layers.pixels.iter().zip(colors);
            let mut sky = sky.filter(|(p, _)| p.kind == Kind::Background);
            assert!(sky.all(|(_, (a, b))| a == b), "{what}: another sky");
            // The control: bands in another order would be seen.
            let half = layers.pixels.len() / 2;
            let mut turned = layers.clone();
            turned.pixels.rotate_left(half);
            assert!(
                classes(&turned) != classes(&expected),
                "{what}: the control"
            );

            let mut names: Vec<&str> = drawn.times.passes.iter().map(|p| p.name.as_str()).collect();
            names.sort_unstable();
            names.dedup();
            assert_eq!(
                names.len(),
                drawn.times.passes.len(),
                "{what}: passes are counted once"
            );
            // An unchanged frame runs nothing but its own passes again, in as many bands.
            let again = draw(&mut held, method);
            assert_eq!(again.clocks, ClockSet::FRAME, "{what}");
            let of_frame = |d: &Drawn| d.ran_on(Clock::Frame).len();
            assert_eq!(of_frame(&again), of_frame(&drawn), "{what}");
            let bytes = held.bytes(method).expect("bytes");
            let of_whole = whole.bytes(method).expect("bytes");
            assert!(bytes[2] >= of_whole[2], "{what}: {bytes:?}, {of_whole:?}");
        }
    }
}

#[test]
fn bands_after_others_are_those_of_a_fresh_session() {
    let method: Method = "raycast+mask@compute".parse().expect("a method");
    for style in ["lit", "technical"] {
        let mut scene = cut_scene();
        scene.style = named_style(style).unwrap_or_else(|e| panic!("{e}"));
        let model = Model::new(&scene);
        let of = |session: &mut Session, flipped: bool| {
            let mut view = model.prepared.view(SIZE_PX);
            if flipped {
                (view.right, view.up) = (-view.right, -view.up);
            }
            let drawn = session.draw(&model, &view, method);
            let outcome = drawn.unwrap_or_else(|e| panic!("{e}")).outcome;
            assert_eq!(outcome, Outcome::Complete, "{style}");
            assert!(session.bands(method).expect("a frame") > 1, "{style}");
            session.picture(method).expect("a picture")
        };
        // A byte less than the depths of 7 crossings a pixel.
        let tight = u64::from(SIZE_PX[0]) * u64::from(SIZE_PX[1]) * 28 - 1;
        let fresh = [false, true].map(|flipped| of(&mut session(tight), flipped));
        // The control: the frame before is another.
        assert!(fresh[0] != fresh[1], "{style}");
        let mut held = session(tight);
        for flipped in [false, true, true, false] {
            let found = of(&mut held, flipped);
            assert!(found == fresh[usize::from(flipped)], "{style}: {flipped}");
        }
    }
}

#[test]
fn what_bands_do_not_help_is_refused_with_the_first_reason() {
    // The list of a pixel's crossings fits, the mesh does not: cutting the picture is in vain.
    let strategy = Strategy::RAYCAST_MASK;
    let mut held = session(1 << 10);
    let drawn = draw(&mut held, strategy);
    let Outcome::Refused(refusal) = drawn.outcome else {
        panic!("{:?}", drawn.outcome);
    };
    assert_eq!(refusal.unsupported, Unsupported::Limit);
    assert!(refusal.reason.contains("1024"), "{refusal}");
    assert!(held.layers(strategy).is_err(), "there is no frame");
}

#[test]
fn an_a_buffer_that_outgrows_a_binding_is_drawn_in_bands() {
    for rasteriser in [Rasteriser::Hardware, Rasteriser::Compute] {
        let method = Method::new(strategy("raycast+abuffer"), DrawOptions::by(rasteriser));
        let mut whole = session(Limits::CORE.storage_binding_bytes);
        assert_eq!(draw(&mut whole, method).outcome, Outcome::Complete);
        let expected = whole.layers(method).expect("layers");
        let plan = whole.plan(method).expect("a plan");
        let largest = plan.resources.iter().map(|r| r.shape.bytes()).max();
        let mut held = session(largest.expect("resources") / 2);
        // Twice: what one frame learnt must not be held against the bands of the next.
        for frame in 0..2 {
            let outcome = draw(&mut held, method).outcome;
            assert_eq!(outcome, Outcome::Complete, "{rasteriser}, frame {frame}");
        }
        assert!(
            held.bands(method).expect("a frame") > 1,
            "{rasteriser}: bands"
        );
        let layers = held.layers(method).expect("layers");
        assert!(
            classes(&layers) == classes(&expected),
            "{rasteriser}: other classes"
        );
    }
}

#[test]
fn a_comparison_and_given_layers_are_drawn_in_bands_too() {
    let scene = cut_scene();
    let shown = SceneAtTime::new(&scene);
    let view = shown.model.prepared.view(SIZE_PX);
    let mut whole = session(Limits::CORE.storage_binding_bytes);
    let layers = cutaway_lab::exact::evaluate(&shown.model.truth(&scene), &view).layers;
    let shade = |session: &mut Session| session.shade(&shown.model, &view, &layers);
    let expected = shade(&mut whole).expect("a picture");
    // Three words a pixel: half of the picture fits, all of it does not.
    let pixels = u64::from(SIZE_PX[0]) * u64::from(SIZE_PX[1]);
    let mut held = session(pixels * 12 - 1);
    assert!(
        shade(&mut held).expect("in halves") == expected,
        "another picture"
    );

    let question = FrameQuestion {
        name: "bands".to_owned(),
        shown: &shown,
        view,
        truth: None,
        options: DrawOptions::default(),
        command: String::new(),
    };
    let renderers = [Renderer::from(Strategy::RAYCAST_MASK)];
    let step = &mut |_: String| {};
    let mut judged = errors(&mut held, &question, &renderers, step).expect("errors");
    let timed = times(&mut held, &question, &mut judged, 1, step, &|| true);
    assert!(timed.expect("times"), "all rounds have run");
    let found = &judged.measurement;
    let comparison = found.strategies[0].comparison.as_ref().expect("a frame");
    assert_eq!(comparison.decided_wrong_px, 0);
    assert_eq!(found.draw_only_ms.samples.len(), 1);
}
