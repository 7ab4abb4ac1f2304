//! What a cutter adds to a plan: only where there is one that reaches some part.

use cutaway::Model;
use cutaway::plan::{Capacities, Clock, Plan};
use cutaway::scene::{ClipSurface, Cut, Scene};
use cutaway::strategies::{self, Strategy};
use glam::DVec3;

use super::common::meshes::shape;
use super::common::strategy;
use super::scenes::{shaped, solid};

fn ball(at: DVec3) -> cutaway::scene::Cutter {
    shaped("sphere?subdivisions=2", 0.3, at)
}

fn plan(scene: &Scene, strategy: &Strategy) -> Result<Plan, strategies::Refusal> {
    let model = Model::new(scene);
    let view = model.prepared.view([64, 48]);
    strategies::plan(&model, &view, strategy, &Capacities::UNKNOWN)
}

fn passes(plan: &Plan) -> Vec<&str> {
    plan.passes.iter().map(|p| p.name.as_str()).collect()
}

#[test]
fn a_cutter_costs_what_it_adds_to_the_list_and_nothing_else() {
    let mask = strategy("raycast+mask");
    let scene = solid("cube", shape("cube"), vec![ball(DVec3::splat(0.4))]);
    let with = plan(&scene, &mask).expect("a plan");
    let with = passes(&with).join(" ");
    assert_eq!(
        with,
        "crossings sheet clear cutter merge solid resolve shade"
    );
    let mut plane = solid("cube", shape("cube"), Vec::new());
    plane.cuts = vec![Cut::new(
        "plane",
        vec![ClipSurface::plane(DVec3::ZERO, DVec3::Z)],
    )];
    let without = plan(&plane, &mask).expect("a plan");
    assert_eq!(passes(&without).join(" "), "crossings solid resolve shade");
    let sheets = |plan: &Plan| {
        let names = plan.resources.iter().map(|r| r.name.as_str());
        names
            .filter(|n| n.contains("cutter") || n.contains("sheet"))
            .count()
    };
    assert_eq!(sheets(&without), 0, "no cutter, no resource");
    // Beside the part it is as good as none; around it, it is not.
    let far = solid("cube", shape("cube"), vec![ball(DVec3::X * 2.0)]);
    let far = plan(&far, &mask).expect("a plan");
    assert_eq!(passes(&far).join(" "), "surface gather shade");
    let gone = solid("cube", shape("cube"), vec![ball(DVec3::X * 2.0).flipped()]);
    let gone = plan(&gone, &mask).expect("a plan");
    assert_eq!(
        passes(&gone).join(" "),
        "surface gather shade",
        "nothing is left"
    );
}

#[test]
fn one_pass_draws_all_cutters() {
    let bites = [0.4, -0.4, 0.0].map(|x| ball(DVec3::new(x, 0.4, 0.4)));
    let scene = solid("cube", shape("cube"), bites.into());
    let plan = plan(&scene, &strategy("raycast+mask")).expect("a plan");
    let named = passes(&plan).into_iter().filter(|n| *n == "cutter");
    assert_eq!(named.count(), 1);
}

#[test]
fn who_keeps_no_list_refuses_by_name() {
    let scene = solid("cube", shape("cube"), vec![ball(DVec3::splat(0.4))]);
    for name in ["stencil", "grid:64+vds:128", "grid:64+ldi:128", "planar"] {
        let refusal = plan(&scene, &strategy(name)).expect_err(name);
        assert!(refusal.reason.contains("closed mesh"), "{name}: {refusal}");
    }
    for name in [
        "raycast+mask",
        "raycast+vds:128",
        "grid:64+mask",
        "grid:64+abuffer",
    ] {
        let plan = plan(&scene, &strategy(name));
        assert!(plan.is_ok(), "{name}: {plan:?}");
    }
}

#[test]
fn what_moves_is_uploaded_and_what_does_not_is_not() {
    let still = ball(DVec3::splat(0.4));
    let scene = |x: f64| {
        let moving = still
            .clone()
            .placed(glam::DAffine3::from_translation(DVec3::new(x, -0.8, 0.0)));
        solid("cube", shape("cube"), vec![still.clone(), moving])
    };
    let mut first = scene(0.0);
    first.stage = Some(first.bounds());
    let model = Model::new(&first);
    let mut second = scene(0.1);
    second.parts = first.parts.clone();
    second.stage = first.stage;
    let moved = model.updated(&second);
    assert_eq!(model.vertices, moved.vertices, "the part");
    let changed: Vec<u64> = (moved.cutters.vertices.not_in(&model.cutters.vertices))
        .map(|piece| piece.offset)
        .collect();
    assert_eq!(changed.len(), 1, "one cutter of two");
    assert!(changed[0] > 0, "the second");
    assert_eq!(
        moved.cutters.indices.not_in(&model.cutters.indices).count(),
        0
    );
    let of = |model: &Model| {
        let view = model.prepared.view([64, 48]);
        strategies::plan(model, &view, strategy("raycast+mask"), &Capacities::UNKNOWN)
            .expect("a plan")
    };
    let (before, after) = (of(&model), of(&moved));
    let clocks: Vec<Clock> = (before.resources.iter().zip(&after.resources))
        .filter(|(a, b)| a.contents != b.contents)
        .map(|(_, b)| b.clock)
        .collect();
    assert!(
        !clocks.contains(&Clock::Solid),
        "the clock of solids stands still: {clocks:?}"
    );
    assert!(
        clocks.contains(&Clock::Cut),
        "the clock of cuts does not: {clocks:?}"
    );
}
