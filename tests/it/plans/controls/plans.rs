//! Faults planted in a plan: a strategy that is wrong in one step is found out.

use cutaway::gpu::{ClockSet, Gpu, Program};
use cutaway::plan::{Capacities, Plan, Work};
use cutaway::scene::Scene;
use cutaway::strategies::{self, Strategy};

use crate::common::{Question, scenes, session};

fn scene() -> Scene {
    let mut scene = scenes::sectioned("torus?segments=40&sides=20", &["-0.3,-1,-0.2@50%,50%,50%"]);
    let rough = scenes::relief(&scene, "-z=65%", "waves:size=16,amplitude=8%");
    scene.cuts[0].surfaces.push(rough);
    scene
}

fn plan_of(question: &Question) -> Plan {
    let capacities = Capacities {
        crossings: Some(15),
        ..Capacities::UNKNOWN
    };
    strategies::plan(
        &question.model,
        &question.view,
        Strategy::RAYCAST_MASK,
        &capacities,
    )
    .expect("a plan")
}

/// Decided wrong and odd pixels of the frame of a plan.
fn judged(question: &Question, gpu: &Gpu, plan: Plan) -> (usize, usize) {
    let mut program = Program::default();
    program.load(gpu, plan).expect("a plan that loads");
    program.run(gpu, ClockSet::ALL).expect("a frame");
    describe(question, gpu, &program)
}

fn describe(question: &Question, gpu: &Gpu, program: &Program) -> (usize, usize) {
    let layers = program.layers(gpu, question.view.size_px).expect("layers");
    let comparison = question.compare(&layers);
    (comparison.decided_wrong_px, comparison.odd_parity_px)
}

fn pass(plan: &mut Plan, name: &str) -> usize {
    let found = plan.passes.iter().position(|p| p.name == name);
    found.unwrap_or_else(|| panic!("no pass `{name}` in\n{}", plan.to_text()))
}

#[test]
fn a_plan_that_is_wrong_in_one_step_is_found_out() {
    let question = Question::new(&scene(), [96; 2]);
    let session = session();
    let gpu = session.gpu();
    assert_eq!(
        judged(&question, gpu, plan_of(&question)),
        (0, 0),
        "the plan that the others are made from"
    );

    let mut plan = plan_of(&question);
    let solid = pass(&mut plan, "solid");
    let Work::Draw { draws, .. } = &mut plan.passes[solid].work else {
        panic!("`solid` draws");
    };
    draws[0].indices.end -= 3 * 300;
    let (wrong, odd) = judged(&question, gpu, plan);
    assert!(
        wrong > 0 && odd > 0,
        "triangles left out: {wrong} wrong, {odd} odd"
    );

    for (name, constant, value) in [
        // A lane of one bit: its first crossing is read as the parity of all fragments.
        ("resolve", "lane_bits", 1.0),
        // A list that holds one crossing, unnoticed.
        ("crossings", "capacity", 1.0),
        ("resolve", "lane_count", 0.0),
    ] {
        let mut plan = plan_of(&question);
        let index = pass(&mut plan, name);
        let slot = plan.passes[index]
            .constants
            .iter_mut()
            .find(|c| c.0 == constant);
        let slot = slot.unwrap_or_else(|| panic!("`{name}` has no constant `{constant}`"));
        assert!(
            slot.1 != value,
            "`{constant}` of `{name}` is {value} already"
        );
        slot.1 = value;
        let (wrong, odd) = judged(&question, gpu, plan);
        assert!(
            wrong + odd > 0,
            "`{constant}` of `{name}` = {value} goes unnoticed"
        );
    }
}

#[test]
fn a_mask_that_is_not_cleared_is_found_out() {
    let question = Question::new(&scene(), [96; 2]);
    let session = session();
    let gpu = session.gpu();
    let mut program = Program::default();
    program
        .load(gpu, plan_of(&question))
        .expect("a plan that loads");
    program.run(gpu, ClockSet::ALL).expect("a frame");
    assert_eq!(
        describe(&question, gpu, &program),
        (0, 0),
        "the first frame"
    );
    // A pass that gets to the first tile alone: the lists are those of the first frame, but the mask is not cleared. The second
    // frame takes all fragments out again, and no cap is left.
    let mut plan = plan_of(&question);
    let crossings = pass(&mut plan, "crossings");
    plan.passes[crossings].work = Work::Compute { groups: [1; 3] };
    program.load(gpu, plan).expect("a plan that loads");
    program.run(gpu, ClockSet::ALL).expect("a frame");
    assert!(
        describe(&question, gpu, &program).0 > 200,
        "no cap is left, and nobody noticed"
    );
    // Without the pass at all the plan does not even load.
    let mut plan = plan_of(&question);
    plan.passes.remove(crossings);
    let refused = Program::default()
        .load(gpu, plan)
        .expect_err("a plan that reads what nothing wrote");
    assert!(refused.to_string().contains("mask"), "{refused}");
}

#[test]
fn the_other_side_of_a_surface_is_another_picture() {
    let question = Question::new(&scene(), [96; 2]);
    let mut flipped = scene();
    flipped.cuts[0].surfaces[0] = flipped.cuts[0].surfaces[0].flipped();
    let other = Question::new(&flipped, [96; 2]);
    let session = session();
    let gpu = session.gpu();
    assert!(
        judged(&question, gpu, plan_of(&other)).0 > 200,
        "a plan of the flipped surface"
    );
    assert!(
        question.compare(&other.exact.layers).decided_wrong_px > 200,
        "exact of the flipped surface"
    );
    assert_eq!(
        judged(&other, gpu, plan_of(&other)),
        (0, 0),
        "each is right about its own scene"
    );
}
