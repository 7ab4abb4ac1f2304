//! A pool of sheet fragments that is too small is told, marked, and grown to what is needed.

use cutaway::layers::Layers;
use cutaway::passes::NEED_OF_SHEETS;
use cutaway::plan::Capacities;
use cutaway::scene::{Cut, Scene};
use cutaway::session::Outcome;
use glam::DVec3;

use super::{SIZE, plan_with, ring, roomy, row, run};
use crate::common::{Question, meshes, scenes, session, strategy};

/// Layers with room for so many fragments of sheets, and how many are said to be needed.
fn with_room(question: &Question, name: &str, sheets: u32) -> (Layers, u32) {
    let capacities = Capacities {
        crossings: Some(31),
        fragments: Some(200_000),
        sheets: Some(sheets),
        ..Capacities::UNKNOWN
    };
    let (layers, words) = run(plan_with(question, name, &capacities), SIZE, &["need"]);
    (layers, words[0][NEED_OF_SHEETS as usize])
}

/// Pixels that are marked, and those that differ without being marked.
fn marked(found: &Layers, right: &Layers) -> (usize, usize) {
    let pairs = found.pixels.iter().zip(&right.pixels);
    let marks = found.pixels.iter().filter(|p| p.unreliable).count();
    let unmarked = pairs.filter(|(a, b)| a != b && !a.unreliable).count();
    (marks, unmarked)
}

#[test]
fn a_pool_too_small_by_a_few_marks_no_more_pixels() {
    for scene in [ring(), row()] {
        let question = Question::new(&scene, SIZE);
        for name in ["grid:32+mask", "grid:32+abuffer"] {
            let (right, _) = run(roomy(&question, name), SIZE, &[]);
            let (roomy, need) = with_room(&question, name, 200_000);
            assert_eq!(roomy, right, "{}: room for all", scene.name);
            let (exact, again) = with_room(&question, name, need);
            assert_eq!((&exact, again), (&right, need), "{}", scene.name);
            // A pixel beside the cut solids loses what nobody asks for: it need not be marked, until many are short.
            let mut most = 0;
            for missing in [1, 64, need / 4] {
                let (short, found) = with_room(&question, name, need - missing);
                assert_eq!(found, need, "{}: what is needed is told", scene.name);
                let (marks, unmarked) = marked(&short, &right);
                assert!(
                    marks <= missing as usize && unmarked == 0,
                    "{}: {marks} marked, {unmarked} wrong by {missing}",
                    scene.name
                );
                most = most.max(marks);
            }
            assert!(
                most > 0,
                "{}: a quarter is missing and nothing marked",
                scene.name
            );
            let (half, _) = with_room(&question, name, need / 2);
            let (marks, unmarked) = marked(&half, &right);
            assert!(
                marks > 10 && unmarked == 0,
                "{}: {marks}, {unmarked}",
                scene.name
            );
        }
    }
}

/// A block with furrows seen across them, so near that it fills the picture: several crossings a pixel.
fn furrows() -> Scene {
    let block = meshes::block(DVec3::splat(-0.5), DVec3::splat(0.5));
    let mut scene = scenes::scene("furrows", block, Vec::new());
    let rough = scenes::relief(&scene, "-z=50%", "sawtooth:amplitude=60%,period=8%");
    scene.cuts = vec![Cut::new("cut", vec![rough])];
    scene.camera = scenes::looking(DVec3::new(4.0, 3.0, 0.0), DVec3::ZERO, 8.0);
    scene
}

#[test]
fn a_session_tries_again_with_the_size_it_was_told() {
    let question = Question::new(&furrows(), SIZE);
    let name = strategy("grid:128+mask");
    let mut session = session();
    let drawn = session.draw(&question.model, &question.view, name);
    let outcome = drawn.unwrap_or_else(|e| panic!("{e}")).outcome;
    assert_eq!(outcome, Outcome::Complete, "drawn again");
    let need = session.words(name, "need").expect("needs")[NEED_OF_SHEETS as usize];
    let plan = session.plan(name).expect("a plan");
    let pool = (plan.bounded.iter()).find(|b| b.what == "fragments of sheets");
    assert!(need > SIZE[0] * SIZE[1], "{need} fit the first try");
    assert_eq!(pool.expect("a pool").capacity, need, "the exact size");
}
