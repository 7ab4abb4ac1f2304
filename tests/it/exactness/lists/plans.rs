//! Plans of these strategies: no pass that they do not need, and what does not fit a binding is refused by name.

use cutaway::plan::{Capacities, Clock, Limits, Plan};
use cutaway::strategies::{self, DrawOptions, Method, Rasteriser};

use super::{SIZE, plan_with, ring, row};
use crate::common::{Question, strategy};

fn plan(question: &Question, name: &str, fragments: Option<u32>) -> Plan {
    let capacities = Capacities {
        fragments,
        ..Capacities::UNKNOWN
    };
    plan_with(question, &strategy(name), &capacities)
}

fn names(plan: &Plan) -> Vec<&str> {
    plan.passes.iter().map(|p| p.name.as_str()).collect()
}

fn bytes(plan: &Plan, name: &str) -> u64 {
    let id = plan.resource_named(name);
    let id = id.unwrap_or_else(|| panic!("no `{name}`"));
    plan.resource(id).shape.bytes()
}

#[test]
fn passes_are_those_that_each_needs() {
    let question = Question::new(&ring(), SIZE);
    for (name, expected) in [
        (
            "raycast+abuffer",
            "crossings count lists-sum-1 lists-scan lists-spread-1 solid reduce resolve shade",
        ),
        ("raycast+kbuffer:4", "crossings solid reduce resolve shade"),
        (
            "raycast+ldi:64",
            "image-clear image-count lists-sum-1 lists-scan lists-spread-1 image-fill crossings solid probe-0 resolve shade",
        ),
        (
            "raycast+ldi:32",
            "image-clear image-count lists-scan image-fill crossings solid probe-0 resolve shade",
        ),
        (
            "raycast+vds:64",
            "sprite-clear-0 sprite-count-0 sprite-peel-0.0 sprite-peel-0.1 crossings solid probe-0 resolve shade",
        ),
        (
            "grid:8+ldi:32",
            "image-clear image-count lists-scan image-fill clip cap-0 gather shade",
        ),
    ] {
        let plan = plan(&question, name, None);
        plan.check(&Limits::CORE)
            .unwrap_or_else(|e| panic!("{name}: {e}"));
        let expected: Vec<String> = expected.split(' ').map(|n| n.replace('-', " ")).collect();
        // 32 x 32 texels are one block of a prefix sum, and the pixels are more.
        assert_eq!(names(&plan), expected, "{name}");
        // What follows a moving mesh is made in every frame; a sprite is not.
        let per_frame = plan.passes.iter().all(|p| p.clock == Clock::Frame);
        assert_eq!(per_frame, !name.contains("vds"), "{name}");
    }
}

#[test]
fn images_of_all_parts_are_built_in_one_go() {
    let question = Question::new(&row(), SIZE);
    let images = |name: &str| {
        let plan = plan(&question, name, None);
        let of_image = |n: &&str| n.starts_with("image") || n.starts_with("sprite");
        names(&plan).into_iter().filter(of_image).count()
    };
    assert_eq!(images("raycast+ldi:64"), 3, "six parts");
    assert_eq!(
        images("raycast+vds:64"),
        24,
        "sprites are built part by part"
    );
}

#[test]
fn owners_are_kept_where_there_are_several() {
    let pixels = u64::from(SIZE[0] * SIZE[1]);
    for (scene, words_each) in [(ring(), 1), (row(), 2)] {
        let plan = plan(&Question::new(&scene, SIZE), "raycast+abuffer", Some(1000));
        let found = bytes(&plan, "fragments of the A-buffer");
        assert_eq!(found, 4 * (pixels + 1000 * words_each), "{}", scene.name);
    }
    let plan = plan(&Question::new(&row(), SIZE), "raycast+kbuffer:4", None);
    assert_eq!(
        bytes(&plan, "nearest fragments"),
        4 * pixels * 6 * 5,
        "six parts"
    );
}

#[test]
fn what_no_binding_holds_is_refused_by_name() {
    let question = Question::new(&row(), SIZE);
    let large = Question::new(&row(), [1600, 1200]);
    for (question, name, fragments, phrase) in [
        (
            &question,
            "raycast+abuffer",
            20_000_000,
            "fragments of the A-buffer",
        ),
        (
            &question,
            "raycast+ldi:64",
            40_000_000,
            "fragments of the layered depth images",
        ),
        (
            &question,
            "raycast+ldi:8192",
            1,
            "fragments of the layered depth images",
        ),
        (&large, "raycast+kbuffer:8", 1, "nearest fragments"),
    ] {
        let plan = plan(question, name, Some(fragments));
        let refusal = plan.check(&Limits::CORE).expect_err(name).to_string();
        assert!(
            refusal.contains(phrase) && refusal.contains("limit"),
            "{refusal}"
        );
    }
    let one = plan(&question, "raycast+abuffer", Some(1_000_000));
    one.check(&Limits::CORE).unwrap_or_else(|e| panic!("{e}"));
}

#[test]
fn what_the_compute_rasteriser_does_not_draw_is_refused_with_a_reason() {
    let question = Question::new(&ring(), SIZE);
    for name in ["raycast+vds:64", "grid:8+vds:64", "grid:8+ldi:64"] {
        let refusal = strategies::plan(
            &question.model,
            &question.view,
            Method::new(strategy(name), DrawOptions::by(Rasteriser::Compute)),
            &Capacities::UNKNOWN,
        )
        .expect_err(name);
        assert!(refusal.reason.contains("hardware rasteriser"), "{refusal}");
    }
}
