//! Hard cases 45 and 46: slots and pools that are too small by one.

use cutaway::gpu::{ClockSet, Program};
use cutaway::layers::Layers;
use cutaway::passes::NEED_OF_FRAGMENTS;
use cutaway::plan::Capacities;
use cutaway::session::Outcome;
use cutaway::strategies::{Rasteriser, Strategy};

use super::{SIZE, drawn, layers, plan_with, ring, row, words};
use crate::common::{Question, scenes, session, strategy};

const HARDWARE: Rasteriser = Rasteriser::Hardware;

/// Layers by a plan with room for so many fragments, and how many it says it needs.
fn with_room(question: &Question, name: &str, fragments: u32) -> (Layers, u32) {
    let capacities = Capacities {
        fragments: Some(fragments),
        ..Capacities::UNKNOWN
    };
    let plan = plan_with(question, &strategy(name), &capacities);
    let session = session();
    let gpu = session.gpu();
    let mut program = Program::default();
    program.load(gpu, plan).unwrap_or_else(|e| panic!("{e}"));
    (program.run(gpu, ClockSet::ALL)).unwrap_or_else(|e| panic!("{e}"));
    let need = program.words(gpu, "need").unwrap_or_else(|e| panic!("{e}"));
    let layers = program.layers(gpu, SIZE).unwrap_or_else(|e| panic!("{e}"));
    (layers, need[NEED_OF_FRAGMENTS as usize])
}

/// Pixels that are marked, and those that differ without being marked.
fn marked(found: &Layers, right: &Layers) -> (usize, usize) {
    let pairs = found.pixels.iter().zip(&right.pixels);
    let marks = found.pixels.iter().filter(|p| p.unreliable).count();
    let unmarked = pairs.filter(|(a, b)| a != b && !a.unreliable).count();
    (marks, unmarked)
}

#[test]
fn case_45_slots_for_all_are_enough_and_one_less_is_told() {
    for scene in [ring(), row()] {
        let question = Question::new(&scene, SIZE);
        let all = strategy("raycast+kbuffer:32");
        let right = layers(&question, &all, HARDWARE);
        let lanes = scene.parts.len();
        let pixels = (SIZE[0] * SIZE[1]) as usize;
        let counts = drawn(&question, &all, HARDWARE, |session, _| {
            let slots = words(session, all, "nearest fragments");
            let of_lane = |lane: usize| slots[lane * 33 * pixels..][..pixels].to_vec();
            (0..lanes).flat_map(of_lane).collect::<Vec<u32>>()
        });
        let most = counts.into_iter().max().expect("pixels");
        assert!((2..32).contains(&most), "{}: {most} at most", scene.name);
        for rasteriser in [HARDWARE, Rasteriser::Compute] {
            let right = layers(&question, &Strategy::RAYCAST_MASK, rasteriser);
            let enough = strategy(&format!("raycast+kbuffer:{most}"));
            assert_eq!(layers(&question, &enough, rasteriser), right, "{enough}");
        }
        let scarce = strategy(&format!("raycast+kbuffer:{}", most - 1));
        drawn(&question, &scarce, HARDWARE, |session, outcome| {
            let Outcome::Overflowed(reason) = outcome else {
                panic!("{}: {scarce} is {outcome:?}", scene.name);
            };
            let expected = format!(
                "fragments per pixel and part (the K of kbuffer:K) need {most}, there are {}",
                most - 1
            );
            assert_eq!(*reason, expected, "{scarce}");
            let found = session.layers(scarce).unwrap_or_else(|e| panic!("{e}"));
            let (marks, unmarked) = marked(&found, &right);
            assert!(
                marks > 0 && unmarked == 0,
                "{marks} marked, {unmarked} wrong"
            );
        });
    }
}

#[test]
fn a_single_slot_is_enough_for_what_lies_before_it() {
    // The ring seen along the cut from the kept side: the crossing is behind the first face.
    let question = Question::new(&ring(), SIZE);
    let right = layers(&question, &Strategy::RAYCAST_MASK, HARDWARE);
    let one = strategy("raycast+kbuffer:1");
    drawn(&question, &one, HARDWARE, |session, _| {
        let found = session.layers(one).unwrap_or_else(|e| panic!("{e}"));
        let (marks, unmarked) = marked(&found, &right);
        assert_eq!(unmarked, 0, "{marks} marked");
        let whole = found.pixels.iter().filter(|p| !p.unreliable).count();
        assert!(whole * 2 > found.pixels.len(), "only {whole} are unmarked");
    });
}

#[test]
fn case_46_a_pool_too_small_by_one_is_told_and_grows_to_what_is_needed() {
    for scene in [
        ring(),
        row(),
        scenes::sectioned("comb?teeth=8", &["-0.2,-1,-0.1@50%,40%,50%"]),
    ] {
        let question = Question::new(&scene, SIZE);
        let right = layers(&question, &Strategy::RAYCAST_MASK, HARDWARE);
        let (roomy, need) = with_room(&question, "raycast+abuffer", 1_000_000);
        assert_eq!(roomy, right, "{}: room for all", scene.name);
        let (exact, again) = with_room(&question, "raycast+abuffer", need);
        assert_eq!((&exact, again), (&right, need), "{}", scene.name);
        let (short, found) = with_room(&question, "raycast+abuffer", need - 1);
        assert_eq!(found, need, "{}: what is needed is told", scene.name);
        let (marks, unmarked) = marked(&short, &right);
        assert_eq!((marks, unmarked), (1, 0), "{}: by one", scene.name);
        let (half, _) = with_room(&question, "raycast+abuffer", need / 2);
        let (marks, unmarked) = marked(&half, &right);
        assert!(
            marks > 10 && unmarked == 0,
            "{}: {marks}, {unmarked}",
            scene.name
        );
    }
}

#[test]
fn case_46_a_session_tries_again_with_the_size_it_was_told() {
    let mut scene = scenes::sectioned("comb?teeth=8", &["-0.2,-1,-0.1@50%,40%,50%"]);
    // Through all the teeth.
    scene.camera = scenes::orbit(90.0, 5.0, true);
    let question = Question::new(&scene, SIZE);
    let all = strategy("raycast+abuffer");
    drawn(&question, &all, HARDWARE, |session, outcome| {
        assert_eq!(*outcome, Outcome::Complete, "drawn again");
        let need = words(session, all, "need")[NEED_OF_FRAGMENTS as usize];
        let plan = session.plan(all).unwrap_or_else(|e| panic!("{e}"));
        let pool = plan.bounded.iter().find(|b| b.what.contains("A-buffer"));
        let capacity = pool.expect("a pool").capacity;
        assert!(need > SIZE[0] * SIZE[1], "{need} fit the first try");
        assert_eq!(capacity, need, "the exact size");
    });
}

#[test]
fn images_that_do_not_fit_mark_who_asks_them() {
    let question = Question::new(&ring(), SIZE);
    for name in ["raycast+ldi:64", "grid:16+ldi:64"] {
        let (right, need) = with_room(&question, name, 100_000);
        assert_eq!(
            right.pixels.iter().filter(|p| p.unreliable).count(),
            0,
            "{name}"
        );
        assert_eq!(
            with_room(&question, name, need).0,
            right,
            "{name}: just enough"
        );
        let (short, found) = with_room(&question, name, need / 2);
        assert_eq!(found, need, "{name}");
        let (marks, unmarked) = marked(&short, &right);
        assert!(marks > 10 && unmarked == 0, "{name}: {marks}, {unmarked}");
    }
}
