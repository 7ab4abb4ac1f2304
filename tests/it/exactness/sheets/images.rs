//! By one list of crossings every inside test finds the same, whoever draws the mesh, and no back face is ever seen.

use cutaway::layers::{Kind, Layers};
use cutaway::scene::Scene;
use cutaway::session::{Outcome, Session};
use cutaway::strategies::{DrawOptions, Method, Rasteriser};

use super::{SIZE, ring, roomy, row, run};
use crate::common::{Question, gpu, scenes, strategy};

fn layers(session: &mut Session, question: &Question, name: &str, by: Rasteriser) -> Layers {
    let method = Method::new(strategy(name), DrawOptions::by(by));
    let drawn = session.draw(&question.model, &question.view, method);
    let drawn = drawn.unwrap_or_else(|e| panic!("{name}: {e}"));
    assert_eq!(drawn.outcome, Outcome::Complete, "{name}");
    session.layers(method).expect("layers of a drawn frame")
}

fn corpus() -> Vec<(&'static str, Scene)> {
    let mut parallel = row();
    parallel.camera = scenes::orbit(20.0, 35.0, true);
    let mut grazing = ring();
    grazing.camera = scenes::orbit(35.0, 2.0, false);
    let mut inside = ring();
    inside.camera = cutaway::scene::Camera {
        near: Some(2.6),
        ..scenes::orbit(30.0, 20.0, false)
    };
    vec![
        ("ring", ring()),
        ("ring seen edge-on", grazing),
        ("ring, near plane inside", inside),
        ("row", row()),
        ("row, parallel", parallel),
    ]
}

fn back_faces(layers: &Layers) -> usize {
    layers.pixels.iter().filter(|p| p.back_face).count()
}

#[test]
fn all_inside_tests_see_the_same() {
    let mut session = Session::new(gpu());
    for (name, scene) in corpus() {
        let question = Question::new(&scene, SIZE);
        for cells in [5, 40] {
            let grid = |inside: &str| format!("grid:{cells}+{inside}");
            let what = format!("{name}, {cells} cells");
            let by_mask = layers(&mut session, &question, &grid("mask"), Rasteriser::Hardware);
            assert!(by_mask.count(Kind::Cap) > 100, "{what}: caps");
            assert_eq!(back_faces(&by_mask), 0, "{what}");
            let unreliable = by_mask.pixels.iter().filter(|p| p.unreliable).count();
            assert_eq!(unreliable, 0, "{what}: marked");
            for inside in ["abuffer", "kbuffer:32", "stencil"] {
                let other = layers(&mut session, &question, &grid(inside), Rasteriser::Hardware);
                assert!(other == by_mask, "{what}: {inside}");
            }
            let swept = layers(&mut session, &question, &grid("mask"), Rasteriser::Compute);
            for inside in ["abuffer", "kbuffer:32"] {
                let other = layers(&mut session, &question, &grid(inside), Rasteriser::Compute);
                assert!(other == swept, "{what}: {inside} by compute");
            }
            // Two rasterisers differ where a sample lies within their rounding of an edge.
            let pairs = swept.pixels.iter().zip(&by_mask.pixels);
            let differ = pairs.filter(|(a, b)| a.kind != b.kind).count();
            assert!(differ < 12, "{what}: {differ} pixels by compute");
            assert_eq!(back_faces(&swept), 0, "{what} by compute");
        }
    }
}

#[test]
fn a_fine_grid_of_a_smooth_relief_is_nearly_exact() {
    let mut scene = ring();
    scene.cuts[0].surfaces[0] = scenes::relief(
        &scene,
        "-0.3,-1,-0.2@50%,50%,50%",
        "waves:size=8,amplitude=10%",
    );
    let question = Question::new(&scene, SIZE);
    let judged = question.answer(strategy("grid:512+mask"));
    let c = judged.comparison;
    assert!(c.decided_wrong_px <= 3, "{c:?}");
    let coarse = question.answer(strategy("grid:4+mask")).comparison;
    assert!(coarse.decided_wrong_px > 60, "the control: {coarse:?}");
}

/// A fault is seen in back faces, marks, or many wrong pixels; what a frame says of itself.
fn describe(question: &Question, plan: cutaway::plan::Plan) -> [usize; 3] {
    let (layers, _) = run(plan, SIZE, &[]);
    let marks = layers.pixels.iter().filter(|p| p.unreliable).count();
    let wrong = question.compare(&layers).decided_wrong_px;
    [back_faces(&layers), marks, wrong]
}

#[test]
fn a_step_left_out_is_seen() {
    let question = Question::new(&ring(), SIZE);
    let [back, marks, wrong] = describe(&question, roomy(&question, "grid:64+mask"));
    assert_eq!([back, marks], [0, 0], "the plan as it is");
    let planted = |change: &dyn Fn(&mut cutaway::plan::Plan)| {
        let mut plan = roomy(&question, "grid:64+mask");
        change(&mut plan);
        describe(&question, plan)
    };
    let pass = |plan: &mut cutaway::plan::Plan, name: &str| {
        let found = plan.passes.iter().position(|p| p.name == name);
        found.unwrap_or_else(|| panic!("no {name}"))
    };

    let none = planted(&|plan| {
        let merge = pass(plan, "merge");
        plan.passes[merge].constants[1].1 = 0.0;
    });
    assert!(none[2] > 300 + wrong, "no sheet is merged: {none:?}");

    // A crack: some triangles are missing.
    let cracked = planted(&|plan| {
        let at = pass(plan, "sheet 0");
        if let cutaway::plan::Work::Draw { draws, .. } = &mut plan.passes[at].work {
            draws[0].indices.end -= 6 * 64 * 30;
        }
    });
    assert!(cracked[2] > 50 + wrong, "a crack: {cracked:?}");
}

#[test]
fn facings_say_the_same_as_heights() {
    let question = Question::new(&ring(), SIZE);
    let by_height = roomy(&question, "grid:64+mask");
    let [_, _, wrong] = describe(&question, by_height.clone());
    let mut by_facing = by_height;
    let merge = by_facing.passes.iter().position(|p| p.name == "merge");
    let constants = &mut by_facing.passes[merge.expect("a merge")].constants;
    let beside = constants.iter_mut().find(|c| c.0 == "beside");
    beside.expect("a tolerance").1 = 100.0;
    let faced = describe(&question, by_facing.clone());
    assert!(faced[2] <= wrong + 2, "{faced:?}, by height {wrong} wrong");
    // The control: each triangle turned round.
    let grid = by_facing.resource_named("grid indices").expect("indices");
    let resource = &mut by_facing.resources[grid.0];
    let bytes = resource.contents.as_ref().expect("an upload").bytes();
    let mut indices: Vec<u32> = bytemuck::pod_collect_to_vec(&bytes);
    for triangle in indices.chunks_exact_mut(3) {
        triangle.swap(1, 2);
    }
    resource.contents = Some(cutaway::plan::Contents::from_values(&indices));
    let turned = describe(&question, by_facing);
    assert!(
        turned[2] > 300 + wrong,
        "turned: {turned:?}, {wrong} before"
    );
}
