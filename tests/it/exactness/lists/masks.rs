//! A-buffer and k-buffer make the mask to the bit, and are exact.

use cutaway::gpu::{ClockSet, Program};
use cutaway::plan::Capacities;
use cutaway::scene::{Camera, Scene};
use cutaway::strategies::{Rasteriser, Strategy};

use super::{SIZE, drawn, method, plan_with, ring, row, words};
use crate::common::{Question, scenes, session, strategy};

const RASTERISERS: [Rasteriser; 2] = [Rasteriser::Hardware, Rasteriser::Compute];

fn corpus() -> Vec<(&'static str, Scene)> {
    let mut inside = ring();
    inside.camera = Camera {
        near: Some(2.6),
        ..scenes::orbit(30.0, 20.0, false)
    };
    let crossed = scenes::sectioned("knot?segments=96&sides=10", &["-z=50%", "-x=45%", "y=40%"]);
    let mut parallel = row();
    parallel.camera = scenes::orbit(20.0, 35.0, true);
    vec![
        ("ring", ring()),
        ("row", row()),
        ("row, parallel", parallel),
        ("ring, near plane inside", inside),
        ("knot, three planes", crossed),
        (
            "comb",
            scenes::sectioned("comb?teeth=8", &["-0.2,-1,-0.1@50%,40%,50%"]),
        ),
    ]
}

fn mask_of(question: &Question, strategy: &Strategy, rasteriser: Rasteriser) -> Vec<u32> {
    drawn(question, strategy, rasteriser, |session, _| {
        words(session, method(strategy, rasteriser), "mask")
    })
}

/// What keeps a mask that was made from fragments from being the one that fragments wrote.
fn fault(written: &[u32], made: &[u32]) -> Option<String> {
    let pixels = (SIZE[0] * SIZE[1]) as usize;
    if made.len() != written.len() + pixels {
        return Some(format!(
            "{} words made, {} written",
            made.len(),
            written.len()
        ));
    }
    let differ = written.iter().zip(made).filter(|(a, b)| a != b).count();
    let doubts = made[written.len()..].iter().filter(|w| **w != 0).count();
    (differ + doubts > 0).then(|| format!("{differ} words differ, {doubts} pixels in doubt"))
}

#[test]
fn masks_are_the_same_to_the_bit() {
    let mut said = 0;
    for (name, scene) in corpus() {
        let question = Question::new(&scene, SIZE);
        for rasteriser in RASTERISERS {
            let written = mask_of(&question, &Strategy::RAYCAST_MASK, rasteriser);
            said += written.iter().filter(|w| **w != 0).count();
            for other in ["raycast+abuffer", "raycast+kbuffer:32"] {
                let made = mask_of(&question, &strategy(other), rasteriser);
                assert_eq!(
                    fault(&written, &made),
                    None,
                    "{name}, {other} by {rasteriser}"
                );
            }
        }
    }
    assert!(said > 5000, "only {said} words say anything");
}

#[test]
fn frames_that_keep_fragments_are_exact() {
    for (name, scene) in corpus() {
        let question = Question::new(&scene, SIZE);
        for exact in ["raycast+abuffer", "raycast+kbuffer:32"] {
            let judged = question.answer(strategy(exact));
            assert_eq!(judged.fault_of_exact(), None, "{name}, {exact}");
        }
    }
}

#[test]
fn a_step_left_out_makes_another_mask() {
    let question = Question::new(&ring(), SIZE);
    let written = mask_of(&question, &Strategy::RAYCAST_MASK, Rasteriser::Hardware);
    let capacities = Capacities {
        fragments: Some(100_000),
        ..Capacities::UNKNOWN
    };
    let made = |leave_out: Option<&str>| {
        let mut plan = plan_with(&question, &strategy("raycast+abuffer"), &capacities);
        if let Some(name) = leave_out {
            let constants = &mut plan.passes.iter_mut().find(|p| p.name == name);
            let pass = constants.as_mut().unwrap_or_else(|| panic!("no {name}"));
            pass.constants[0].1 /= 2.0;
        }
        let session = session();
        let mut program = Program::default();
        (program.load(session.gpu(), plan)).unwrap_or_else(|e| panic!("{e}"));
        (program.run(session.gpu(), ClockSet::ALL)).unwrap_or_else(|e| panic!("{e}"));
        (program.words(session.gpu(), "mask")).unwrap_or_else(|e| panic!("{e}"))
    };
    assert_eq!(fault(&written, &made(None)), None, "the plan as it is");
    for pass in ["lists spread 1", "reduce"] {
        let fault = fault(&written, &made(Some(pass)));
        assert!(
            fault.is_some(),
            "{pass} with another constant goes unnoticed"
        );
    }
}
