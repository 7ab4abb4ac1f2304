//! Draws that take their range from the device: what a plan says of them, and what it checks.

use cutaway::Model;
use cutaway::plan::{Arguments, Capacities, Clock, Draw, Limits, Plan, ResourceId, Vertices, Work};
use cutaway::scene::Wrap;
use cutaway::strategies;

use super::common::strategy;
use super::{cut_ball, noise};

fn plan() -> Plan {
    plan_of([24, 24])
}

fn plan_of(map_size: [u32; 2]) -> Plan {
    let model = Model::new(&cut_ball(noise(map_size, 1), 0.8, 0.1, Wrap::Repeat));
    let view = model.prepared.view([64, 48]);
    strategies::plan(
        &model,
        &view,
        strategy("adaptive:1+mask"),
        &Capacities::UNKNOWN,
    )
    .unwrap_or_else(|e| panic!("{e}"))
}

fn id_of(plan: &Plan, name: &str) -> ResourceId {
    plan.resource_named(name)
        .unwrap_or_else(|| panic!("no `{name}`"))
}

/// Changes the draws of the passes that draw the sheet.
fn with_draws(plan: &mut Plan, change: impl Fn(&mut Vec<Draw>, &mut Vertices)) {
    for pass in &mut plan.passes {
        if let Work::Draw {
            draws, vertices, ..
        } = &mut pass.work
            && pass.name.starts_with("sheet 0")
        {
            change(draws, vertices);
        }
    }
}

#[test]
fn plans_hold_whatever_the_shape_of_the_map() {
    for map_size in [[24, 24], [2, 2], [2048, 2], [2, 2048], [1024, 1024]] {
        let plan = plan_of(map_size);
        plan.check(&Limits::CORE)
            .unwrap_or_else(|e| panic!("{map_size:?}: {e}"));
    }
}

#[test]
fn a_draw_by_arguments_says_so() {
    let plan = plan();
    let text = plan.to_text();
    assert!(
        text.contains("draw up to 65536 triangles in 1 draw"),
        "{text}"
    );
    let pass = plan
        .passes
        .iter()
        .find(|p| p.name == "sheet 0")
        .expect("the pass");
    for name in ["arguments", "triangles"] {
        assert!(
            pass.reads().contains(&id_of(&plan, name)),
            "it reads {name}"
        );
    }
    let json = plan.to_json();
    let passes = json["passes"].as_array().expect("passes");
    let pass = passes
        .iter()
        .find(|p| p["name"] == "sheet 0")
        .expect("the pass");
    assert!(
        pass["reads"]
            .as_array()
            .expect("names")
            .iter()
            .any(|n| n == "arguments"),
        "{pass}"
    );
    assert!(
        pass["work"].as_str().expect("words").contains("up to"),
        "{pass}"
    );
}

#[test]
fn wrong_arguments_are_refused() {
    assert_eq!(
        plan().check(&Limits::CORE).map_err(|e| e.to_string()),
        Ok(()),
        "as it is"
    );
    let refusal = |change: &dyn Fn(&mut Draw, &mut Vertices, &Plan)| {
        let mut planted = plan();
        let copy = planted.clone();
        with_draws(&mut planted, |draws, vertices| {
            change(&mut draws[0], vertices, &copy)
        });
        planted
            .check(&Limits::CORE)
            .expect_err("a wrong plan")
            .to_string()
    };
    let at = |offset: u64| {
        move |d: &mut Draw, _: &mut Vertices, _: &Plan| {
            d.arguments = d.arguments.map(|a| Arguments { offset, ..a });
        }
    };
    for (phrase, refused) in [
        ("no arguments at byte 4", refusal(&at(4))),
        ("no arguments at byte 2", refusal(&at(2))),
        (
            "is not an arguments buffer",
            refusal(&|d, _, plan| {
                d.arguments = d.arguments.map(|a| Arguments {
                    resource: id_of(plan, "need"),
                    ..a
                });
            }),
        ),
        ("only use instance 0", refusal(&|d, _, _| d.instance = 1)),
        (
            "reach beyond triangles",
            refusal(&|d, _, _| d.indices.end += 1),
        ),
        (
            "cannot read a vertex buffer",
            refusal(&|_, vertices, plan| *vertices = Vertices::Mesh(id_of(plan, "vertices"))),
        ),
    ] {
        assert!(
            refused.contains(phrase),
            "`{refused}` does not say `{phrase}`"
        );
    }
}

#[test]
fn other_arguments_make_a_draw_due() {
    // As if all of it hung on the cut, so that passes may be left out.
    let slow = |mut plan: Plan| {
        plan.passes.iter_mut().for_each(|p| p.clock = Clock::Cut);
        plan
    };
    let is_due =
        |plan: &Plan, before: &Plan| plan.due_after(before, |_| false).passes.contains("sheet 0");
    // One more pass writes them, and nothing else that is drawn.
    let mut before = slow(plan());
    let position = |name: &str| before.passes.iter().position(|p| p.name == name);
    let at = position("triangles end").expect("the pass") + 1;
    let mut planted = before.passes[position("triangles begin").expect("the pass")].clone();
    planted.name = "planted".to_owned();
    before.passes.insert(at, planted);
    assert!(!is_due(&before, &before), "nothing changed");
    let change = |plan: &Plan| {
        let mut changed = plan.clone();
        changed.passes[at].constants.push(("planted", 1.0));
        changed
    };
    assert!(is_due(&change(&before), &before), "other arguments");
    // The control: a draw that does not read them does not care.
    let mut deaf = before.clone();
    with_draws(&mut deaf, |draws, _| draws[0].arguments = None);
    assert!(!is_due(&change(&deaf), &deaf), "no arguments");
    // A draw that looks elsewhere is another.
    let mut moved = before.clone();
    with_draws(&mut moved, |draws, _| {
        let other = id_of(&before, "need");
        draws[0].arguments = draws[0].arguments.map(|a| Arguments {
            resource: other,
            ..a
        });
    });
    assert!(is_due(&moved, &before), "another buffer");
}
