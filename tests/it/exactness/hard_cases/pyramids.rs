//! Cases 28, 29 and 31 by either way through a relief: both must be exact, and show the same.

use cutaway::layers::{Kind, Layers};
use cutaway::scene::{OffsetMap, Scene, Wrap};
use cutaway::strategies::{DrawOptions, Method, ReliefWalk, Strategy};
use glam::DVec3;

use crate::common::{Judged, Question, meshes, scenes, session};

const SIZE: [u32; 2] = [128; 2];

/// A slab under a map of heights, seen at a few degrees to its plane.
fn grazing(map: OffsetMap, (period, height): (f64, f64), wrap: Wrap) -> Scene {
    let surface = scenes::mapped(DVec3::ZERO, -DVec3::Y, map, (period, height), wrap);
    let slab = meshes::block(DVec3::new(-0.5, -0.3, -0.5), DVec3::new(0.5, 0.3, 0.5));
    let mut scene = scenes::scene("slab", slab, vec![surface]);
    scene.camera = scenes::looking(DVec3::new(0.3, 0.25, 2.0), DVec3::ZERO, 30.0);
    scene
}

/// What is seen by one of the ways, judged.
fn by(walk: ReliefWalk, question: &Question) -> Judged {
    let mut session = session();
    let method = Method::new(
        Strategy::RAYCAST_MASK,
        DrawOptions {
            relief_walk: Some(walk),
            ..DrawOptions::default()
        },
    );
    let drawn =
        (session.draw(&question.model, &question.view, method)).unwrap_or_else(|e| panic!("{e}"));
    question.judge(&session, method, drawn.outcome)
}

/// Holds both ways to exact and to each other; what they show.
fn hold(what: &str, scene: &Scene) -> Layers {
    let question = Question::new(scene, SIZE);
    let [walked, passed] = [ReliefWalk::Cells, ReliefWalk::Pyramid].map(|walk| {
        let judged = by(walk, &question);
        assert_eq!(judged.fault_of_exact(), None, "{what} by {walk}");
        judged.layers
    });
    assert!(
        walked == passed,
        "{what}: the two ways show different things"
    );
    let caps = walked.count(Kind::Cap);
    println!("{what}: {caps} cap pixels");
    assert!(caps > 0, "{what}: no cap is seen");
    walked
}

#[test]
fn case_28_checker_plateaus_with_steep_steps() {
    let map = scenes::map([96; 2], |x, y| ((x / 6 + y / 6) % 2) as f32);
    hold(
        "low plateaus",
        &grazing(map.clone(), (1.0, 0.1), Wrap::Repeat),
    );
    // So high that the solid is left whole but for pits, which are seen from above its top alone.
    let mut pits = grazing(map, (2.0, 5.0), Wrap::Repeat);
    pits.camera = scenes::looking(DVec3::new(0.3, 0.9, 2.0), DVec3::ZERO, 30.0);
    hold("high plateaus", &pits);
}

#[test]
fn case_29_a_map_goes_on_beyond_its_border() {
    // Sizes that are no powers of two, a third of the slab wide: borders and corners of copies are seen.
    let map = || scenes::map([27, 38], |x, y| ((x * x + 3 * y) % 11) as f32 / 11.0);
    let of = |wrap| hold(&format!("{wrap:?}"), &grazing(map(), (0.35, 0.1), wrap));
    let [repeat, mirror, clamp] = [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp].map(of);
    assert!(
        repeat != mirror && mirror != clamp && clamp != repeat,
        "each goes on in its own way"
    );
}

#[test]
fn case_31_maps_of_one_row_or_column() {
    let wave = |i: u32| (f64::from(i) * 0.9).sin() as f32;
    for (what, map) in [
        ("a row", scenes::map([50, 1], |x, _| wave(x))),
        ("a column", scenes::map([1, 50], |_, y| wave(y))),
        ("two texels", scenes::map([2, 1], |x, _| x as f32)),
    ] {
        hold(what, &grazing(map, (0.7, 0.05), Wrap::Mirror));
    }
}
