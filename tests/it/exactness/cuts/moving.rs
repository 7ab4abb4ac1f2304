//! Cuts over time: switches, boxes, wedges, offsets and heights that change from frame to frame.

use cutaway::Model;
use cutaway::layers::Kind;
use cutaway::plan::Clock;
use cutaway::scene::Scene;
use cutaway::session::{Outcome, Session};
use cutaway::strategies::Strategy;
use glam::DVec3;

use super::common::{Question, gpu, strategy};
use super::{Scratch, at, of_shape, seen};

fn key(target: &str, values: &str) -> String {
    format!("[[key]]\ntarget = \"{target}\"\ntimes_s = [0, 1, 2]\nvalues = {values}\n")
}

fn of_cut(cut: &str, keys: &[String]) -> String {
    of_shape("cube", [5, 4, 3], 2.0, cut) + &keys.concat()
}

fn removes(scene: &Scene, point: DVec3) -> bool {
    let part = &scene.parts[0];
    let cuts = scene.cuts.iter().filter(|c| c.applies_to(part));
    let mut cuts = cuts.map(|c| (c, c.offset_for(part)));
    cuts.any(|(cut, keeps)| {
        let mut surfaces = cut.surfaces.iter().map(|s| s.keeping(keeps));
        surfaces.all(|s| s.kept_height(point) < 0.0)
    })
}

#[test]
fn a_cut_goes_on_and_off_in_steps() {
    let folder = Scratch::new("switch");
    for values in ["[true, false, true]", "[1, 0, 1]"] {
        let cut = "enabled = true\nsurfaces = [{ section = \"-z=0\" }]";
        let timeline = folder.timeline(&of_cut(cut, &[key("cut.front.enabled", values)]));
        assert_eq!(timeline.duration_s(), Some(2.0));
        for (time_s, expected) in [
            (0.0, true),
            (0.99, true),
            (1.0, false),
            (1.9, false),
            (2.0, true),
            (9.0, true),
        ] {
            let scene = at(&timeline, time_s);
            assert_eq!(scene.cuts[0].enabled, expected, "{values} at {time_s} s");
            let caps = seen(&scene, [40, 30]).layers.count(Kind::Cap);
            assert_eq!(caps > 0, expected, "{values} at {time_s} s");
            assert_eq!(removes(&scene, DVec3::new(0.1, 0.1, 0.1)), expected);
        }
    }
}

#[test]
fn numbers_of_boxes_wedges_and_offsets_move() {
    let folder = Scratch::new("numbers");
    let probe = DVec3::new(0.2, 0.1, 0.3);
    for (cut, target, values, expected) in [
        (
            "box = { min = [0.4, 0, 0] }",
            "cut.front.box.min.0",
            "[0.4, 0.0, 0.4]",
            [false, true, false],
        ),
        (
            "box = { centre = [0, 0, 0], size = 0 }",
            "cut.0.box.size",
            "[0, 0.7, 0.2]",
            [false, true, false],
        ),
        (
            "wedge = { axis = \"z\", from_deg = 0, to_deg = 0 }",
            "cut.front.wedge.to_deg",
            "[0, 60, 359]",
            [false, true, true],
        ),
        (
            "wedge = { axis = \"z\", from_deg = 0, to_deg = 90, origin = [0, 0, 0] }",
            "cut.front.wedge.origin",
            "[[0, 0, 0], [0.3, 0, 0], [0, 0.2, 0]]",
            [true, false, false],
        ),
        (
            "box = { min = [0, 0, 0] }\noffset = { solid = 0.0 }",
            "cut.front.offset.solid",
            "[0, 0.2, 0.05]",
            [true, false, true],
        ),
    ] {
        let timeline = folder.timeline(&of_cut(cut, &[key(target, values)]));
        for (time_s, expected) in [0.0, 1.0, 2.0].into_iter().zip(expected) {
            let scene = at(&timeline, time_s);
            assert_eq!(removes(&scene, probe), expected, "{target} at {time_s} s");
        }
    }
}

#[test]
fn what_opens_and_what_is_switched_agrees_with_exact() {
    let folder = Scratch::new("opens");
    let cut = "enabled = true\nwedge = { axis = \"z\", from_deg = 0, to_deg = 0, relief = \"rough\", amplitude = 0.1 }\n\
               offset = { solid = 0.0 }";
    let keys = [
        key("cut.front.wedge.to_deg", "[0, 130, 300]"),
        key("cut.front.offset.solid", "[0, 0, 0.1]"),
        "[[key]]\ntarget = \"cut.front.enabled\"\ntimes_s = [0, 1.8, 1.95]\nvalues = [true, false, true]\n".to_owned(),
    ];
    let relief = "[relief.rough]\nkind = \"fractal\"\nsize = 32\n";
    let timeline = folder.timeline(&(relief.to_owned() + &of_cut(cut, &keys)));
    let mut model: Option<Model> = None;
    let mut with_caps = 0;
    for time_s in [0.0, 0.3, 0.9, 1.3, 1.5, 1.85, 2.0, 0.5] {
        let scene = at(&timeline, time_s);
        let next = match &model {
            Some(model) => model.updated(&scene),
            None => Model::new(&scene),
        };
        model = Some(next.clone());
        let question = Question::of_model(next, &scene, [96, 72]);
        for name in ["raycast+mask", "raycast+abuffer"] {
            let judged = question.answer(strategy(name));
            assert_eq!(judged.fault_of_exact(), None, "{name} at {time_s} s");
        }
        with_caps += usize::from(question.exact.layers.count(Kind::Cap) > 100);
    }
    assert_eq!(with_caps, 6, "all but the begin and the pause");
}

/// A torus under a relief that moves, and one that stays.
fn two_reliefs(folder: &Scratch, keys: &str) -> cutaway_io::document::Timeline {
    folder.timeline(&format!(
        "[[part]]\nname = \"solid\"\nshape = \"torus?segments=40&sides=20\"\n\
         [relief.still]\nkind = \"waves\"\nsize = 32\n\
         [relief.a]\nkind = \"fractal\"\nsize = 32\ngain = 0.4\n\
         [relief.b]\nkind = \"cracks\"\nsize = 32\n\
         [relief.stack]\nkind = \"layers\"\nof = [\"a\", \"b\"]\nat = 0.0\n\
         [[cut]]\nname = \"front\"\nsurfaces = [{{ section = \"-z=60%\", relief = \"stack\", amplitude = 0.2 }}]\n\
         [[cut]]\nname = \"side\"\nsurfaces = [{{ section = \"-x=70%\", relief = \"still\" }}]\n{keys}"
    ))
}

#[test]
fn only_the_map_that_changed_is_uploaded() {
    let folder = Scratch::new("uploaded");
    let gpu = || Session::new(gpu());
    for (keys, what) in [
        (
            key("relief.stack.at", "[0.25, 0.75, 1.25]"),
            "between layers",
        ),
        (key("relief.a.gain", "[0.4, 0.6, 0.9]"), "a procedure"),
    ] {
        let timeline = two_reliefs(&folder, &keys);
        let strategy = Strategy::RAYCAST_MASK;
        let mut session = gpu();
        let mut model = Model::new(&at(&timeline, 0.1));
        // The second frame is the first to know that the heights change, and gets room of its own for them.
        for (frame, time_s) in [0.1, 0.4, 0.7, 1.2].into_iter().enumerate() {
            let scene = at(&timeline, time_s);
            let next = model.updated(&scene);
            let pieces: Vec<_> = next
                .heights
                .not_in(&model.heights)
                .map(|p| (p.range().start, p.range().end))
                .collect();
            let map_bytes = 32 * 32 * 4;
            let expected = if frame == 0 {
                vec![]
            } else {
                vec![(0, map_bytes)]
            };
            assert_eq!(pieces, expected, "{what} at {time_s} s");
            assert_eq!(next.heights.len(), 2 * map_bytes);
            let nothing = next.vertices.not_in(&model.vertices).count();
            assert_eq!(nothing, 0, "{what} at {time_s} s: vertices");
            model = next;

            let view = model.prepared.view([64, 48]);
            let drawn = session.draw(&model, &view, strategy).expect("a frame");
            assert_eq!(drawn.outcome, Outcome::Complete, "{what} at {time_s} s");
            if frame > 0 {
                assert!(drawn.clocks.contains(Clock::Cut), "{what} at {time_s} s");
                assert!(!drawn.clocks.contains(Clock::Solid), "{what} at {time_s} s");
            }
            let mut other = gpu();
            let fresh = Model::new(&scene);
            let drawn = other.draw(&fresh, &view, strategy).expect("a frame");
            assert_eq!(drawn.outcome, Outcome::Complete, "{what} at {time_s} s");
            let [a, b] = [&session, &other].map(|s| s.layers(strategy).expect("layers"));
            assert_eq!(a, b, "{what} at {time_s} s: as on a device that never drew");
        }
        // The control: a time at which nothing moves uploads nothing.
        let again = model.updated(&at(&timeline, 1.2));
        assert_eq!(again.heights.not_in(&model.heights).count(), 0, "{what}");
        let view = again.prepared.view([64, 48]);
        let drawn = session.draw(&again, &view, strategy).expect("a frame");
        assert!(!drawn.clocks.contains(Clock::Cut), "{what}: it stood still");
    }
}

#[test]
fn heights_that_change_agree_with_exact() {
    let folder = Scratch::new("heights");
    let keys = key("relief.stack.at", "[0, 1, 2.5]") + &key("relief.a.gain", "[0.4, 0.9, 0.4]");
    let timeline = two_reliefs(&folder, &keys);
    let mut model = Model::new(&at(&timeline, 0.0));
    let mut pictures = Vec::new();
    for step in 0..8 {
        let scene = at(&timeline, f64::from(step) * 0.27);
        model = model.updated(&scene);
        let question = Question::of_model(model.clone(), &scene, [96, 72]);
        let judged = question.answer(Strategy::RAYCAST_MASK);
        assert_eq!(judged.fault_of_exact(), None, "step {step}");
        assert!(question.exact.layers.count(Kind::Cap) > 200, "step {step}");
        pictures.push(question.exact.layers.clone());
    }
    let changed = pictures.windows(2).filter(|w| w[0] != w[1]).count();
    assert_eq!(changed, 7, "every step shows something else");
}
