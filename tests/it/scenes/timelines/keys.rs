//! Keys: at their times, between and beyond them.

use std::sync::Arc;

use cutaway::scene::{OffsetMap, Prepared, Scene, Viewpoint};
use cutaway_io::document::{Document, Interpolation, Key};
use cutaway_io::load::Assets;
use cutaway_lab::exact::evaluate;
use glam::DVec3;

use super::{Scratch, at, part};
use crate::common::root;

const SCENE: &str = r#"
[camera]
azimuth_deg = 0
elevation_deg = 10
[[part]]
name = "box"
shape = "cube"
translate = [0, 0, 0]
[[part]]
name = "ball"
shape = "sphere"
scale = 1
matrix.unused = 0
[relief.ragged]
kind = "fractal"
size = 16
octaves = 2
gain = 0.5
[relief.calm]
kind = "waves"
size = 8
[relief.both]
blend = ["ragged", "calm"]
op = "add"
[relief.still]
blend = ["calm", "calm"]
op = "add"
[[cut]]
name = "front"
surfaces = [
  { origin = [0, 0, 0.1], u = [1, 0, 0], v = [0, 1, 0], scale = [1, 1, 0.1], relief = "both" },
  { section = "x=25%", relief = "still", amplitude = 0.1 },
]
"#;

fn scene(keys: &str) -> String {
    SCENE.replace("matrix.unused = 0\n", "") + keys
}

fn origin(scene: &Scene) -> DVec3 {
    scene.cuts[0].surfaces[0].origin
}

#[track_caller]
fn near(a: DVec3, b: [f64; 3]) {
    assert!((a - DVec3::from(b)).length() < 1e-12, "{a} is not {b:?}");
}

#[test]
fn values_hold_at_times_between_and_beyond() {
    let folder = Scratch::new("between");
    let keys = "[[key]]\ntarget = \"cut.front.surfaces.0.origin\"\ntimes_s = [1, 3, 4]\n\
                values = [[0, 0, -1], [0, 4, 1], [0, 4, 2]]\n";
    let timeline = folder.timeline(&scene(keys));
    assert_eq!(timeline.duration_s(), Some(4.0), "the last key");
    for (time_s, expected) in [
        (0.0, [0.0, 0.0, -1.0]),
        (1.0, [0.0, 0.0, -1.0]),
        (1.5, [0.0, 1.0, -0.5]),
        (2.0, [0.0, 2.0, 0.0]),
        (3.0, [0.0, 4.0, 1.0]),
        (3.75, [0.0, 4.0, 1.75]),
        (4.0, [0.0, 4.0, 2.0]),
        (99.0, [0.0, 4.0, 2.0]),
    ] {
        near(origin(&at(&timeline, time_s)), expected);
    }
    // The file as it is written is what it was without a time.
    near(origin(&folder.scene(&scene(keys))), [0.0, 0.0, 0.1]);
}

#[test]
fn interpolations_follow_their_formulas() {
    let key = |interpolation| Key {
        target: String::new(),
        times_s: vec![0.0, 2.0],
        values: vec![vec![1.0], vec![5.0]],
        interpolation,
    };
    for (interpolation, quarter, half) in [
        (Interpolation::Linear, 2.0, 3.0),
        (Interpolation::Step, 1.0, 1.0),
        (Interpolation::Smooth, 1.625, 3.0),
    ] {
        let key = key(interpolation);
        assert_eq!(key.at(0.5), [quarter], "{interpolation:?}");
        assert_eq!(key.at(1.0), [half], "{interpolation:?}");
        assert_eq!([key.at(0.0), key.at(2.0)], [[1.0], [5.0]], "ends");
    }
}

#[test]
fn two_keys_move_one_vector() {
    let folder = Scratch::new("two");
    let keys = "[[key]]\ntarget = \"cut.0.surfaces.0.origin.0\"\ntimes_s = [0, 1]\nvalues = [0, 8]\n\
                [[key]]\ntarget = \"cut.front.surfaces.0.origin.2\"\ntimes_s = [0, 2]\nvalues = [5, 7]\n\
                interpolation = \"step\"\n";
    let timeline = folder.timeline(&scene(keys));
    near(origin(&at(&timeline, 0.5)), [4.0, 0.0, 5.0]);
    near(origin(&at(&timeline, 1.75)), [8.0, 0.0, 5.0]);
    near(origin(&at(&timeline, 2.0)), [8.0, 0.0, 7.0]);
}

#[test]
fn cameras_parts_and_amplitudes_move() {
    let folder = Scratch::new("others");
    let keys = "[[key]]\ntarget = \"camera.azimuth_deg\"\ntimes_s = [0, 2]\nvalues = [0, 90]\n\
                [[key]]\ntarget = \"part.box.translate\"\ntimes_s = [0, 2]\nvalues = [[0, 0, 0], [0, 2, 0]]\n\
                [[key]]\ntarget = \"part.1.scale\"\ntimes_s = [0, 2]\nvalues = [1, 3]\n\
                [[key]]\ntarget = \"cut.front.surfaces.1.amplitude\"\ntimes_s = [0, 2]\nvalues = [0.1, 0.3]\n";
    let timeline = folder.timeline(&scene(keys));
    let scene = at(&timeline, 1.0);
    assert_eq!(
        scene.camera.viewpoint,
        Viewpoint::Orbit {
            azimuth_deg: 45.0,
            elevation_deg: 10.0
        },
        "camera"
    );
    let moved = part(&scene, "box").world_from_part;
    near(moved.transform_point3(DVec3::ZERO), [0.0, 1.0, 0.0]);
    let scaled = part(&scene, "ball").world_from_part;
    near(scaled.transform_point3(DVec3::X), [2.0, 0.0, 0.0]);
    let height = |s: &Scene| {
        let surface = &s.cuts[0].surfaces[1];
        let [lo, hi] = surface.relief.as_ref().expect("a relief").range();
        surface.scale.z * f64::from(hi - lo)
    };
    assert!((height(&scene) - 0.2).abs() < 1e-9, "{}", height(&scene));
}

#[test]
fn a_matrix_moves_as_a_whole() {
    let folder = Scratch::new("matrix");
    let row = |x: &str| format!("[[1, 0, 0, {x}], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]");
    let text = format!(
        "[[part]]\nname = \"a.b\"\nshape = \"cube\"\nmatrix = {}\n[[key]]\ntarget = \"part.a.b.matrix\"\n\
         times_s = [0, 1]\nvalues = [{}, {}]\n",
        row("0"),
        row("1"),
        row("2"),
    );
    let scene = at(&folder.timeline(&text), 0.5);
    near(scene.parts[0].world_from_part.translation, [1.5, 0.0, 0.0]);
}

#[test]
fn what_does_not_change_stays_the_same_object() {
    let folder = Scratch::new("same");
    let keys = "[[key]]\ntarget = \"relief.ragged.gain\"\ntimes_s = [0, 2]\nvalues = [0.5, 0.9]\n";
    let timeline = folder.timeline(&scene(keys));
    let [first, later] = [0.5, 1.5].map(|t| at(&timeline, t));
    for (a, b) in first.parts.iter().zip(&later.parts) {
        assert!(Arc::ptr_eq(&a.mesh, &b.mesh), "{} was made anew", a.name);
    }
    let map = |s: &Scene, i: usize| -> Arc<OffsetMap> {
        Arc::clone(s.cuts[0].surfaces[i].relief.as_ref().expect("a relief"))
    };
    assert!(
        Arc::ptr_eq(&map(&first, 1), &map(&later, 1)),
        "a still blend was made anew"
    );
    // The negative control: a blend of the relief that moves is another one.
    assert!(
        map(&first, 0).texels() != map(&later, 0).texels(),
        "the moving relief stood still"
    );
    let [a, b] = [5.0, 6.0].map(|t| at(&timeline, t));
    assert!(
        Arc::ptr_eq(&map(&a, 0), &map(&b, 0)),
        "a relief at its end was made anew"
    );
}

#[test]
fn whole_numbers_move_in_steps() {
    let folder = Scratch::new("whole");
    let keys = "[[key]]\ntarget = \"relief.ragged.octaves\"\ntimes_s = [0, 2]\nvalues = [1, 2]\n";
    let step = format!("{keys}interpolation = \"step\"\n");
    assert_eq!(
        folder.timeline(&scene(&step)).duration_s(),
        Some(2.0),
        "steps are whole"
    );
    let error = folder.load(&scene(keys)).expect_err("1.25 octaves");
    assert!(error.to_string().contains("octaves"), "{error}");
}

#[test]
fn a_scene_without_movers_stands_still() {
    let folder = Scratch::new("still");
    let timeline = folder.timeline(&scene(""));
    assert!(!timeline.moves(), "nothing moves");
    assert_eq!(timeline.duration_s(), None, "nothing takes time");
    let scene = at(&timeline, 7.0);
    assert_eq!(scene.stage, None, "no stage is needed");

    assert!(timeline.clips().is_empty(), "{:?}", timeline.clips());
    for time_s in [-1.0, f64::NAN, f64::INFINITY] {
        let error = timeline.at(time_s).expect_err("no time").to_string();
        assert!(error.contains("help:"), "{error}");
    }
}

#[test]
fn clips_that_are_not_there_are_refused() {
    let folder = Scratch::new("clips");
    let text = "clip = \"walk\"\n[[part]]\nshape = \"cube\"\n";
    let error = folder.load(text).expect_err("no clip").to_string();
    assert!(
        error.contains("`walk`") && error.contains("help:"),
        "{error}"
    );
}

/// The scenes that the repository shows to users are sound at all times, and what is seen of them changes.
#[test]
fn the_scenes_of_the_repository_move() {
    let folder = root().join("experiments/scenes");
    let mut count = 0;
    for entry in std::fs::read_dir(folder).expect("a folder of scenes") {
        let path = entry.expect("an entry of it").path();
        let document = Document::read(&path);
        let timeline = document.and_then(|d| d.timeline(&mut Assets::default()));
        let timeline = timeline.unwrap_or_else(|e| panic!("{e}"));
        let duration_s = timeline.duration_s().expect("it moves");
        let seen = |time_s: f64| {
            let prepared = Prepared::new(&at(&timeline, time_s));
            evaluate(&prepared, &prepared.view([32, 24])).layers
        };
        let [first, again, later] = [0.0, 0.0, duration_s * 0.4].map(seen);
        assert_eq!(first, again, "the control: one time looks like itself");
        assert!(first != later, "{} stands still", path.display());
        count += 1;
    }
    assert!(count > 0, "no scene");
}
