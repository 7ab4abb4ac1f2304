//! What sheets cost a plan, and when there are none.

use cutaway::Model;
use cutaway::plan::{Access, Capacities, Limits, Plan, Work};
use cutaway::scene::Scene;
use cutaway::strategies::{self, DrawOptions, Method, Rasteriser, Strategy};

use super::{ring, row};
use crate::common::{scenes, strategy};

const LISTED: [&str; 4] = [
    "grid:8+mask",
    "grid:8+stencil",
    "grid:8+abuffer",
    "grid:8+kbuffer:4",
];

fn plan_by(scene: &Scene, strategy: &Strategy, rasteriser: Rasteriser) -> Plan {
    let model = Model::new(scene);
    let view = model.prepared.view([320, 200]);
    let method = Method::new(*strategy, DrawOptions::by(rasteriser));
    strategies::plan(&model, &view, method, &Capacities::UNKNOWN).unwrap_or_else(|e| panic!("{e}"))
}

fn plan_of(scene: &Scene, name: &str) -> Plan {
    plan_by(scene, &strategy(name), Rasteriser::Hardware)
}

fn names(plan: &Plan) -> Vec<&str> {
    plan.passes.iter().map(|p| p.name.as_str()).collect()
}

#[test]
fn planes_are_never_drawn_as_sheets() {
    let scene = scenes::sectioned("torus?segments=12&sides=8", &["-z=50%", "-x=45%"]);
    for name in LISTED {
        let by_ray = name.replace("grid:8", "raycast");
        assert_eq!(plan_of(&scene, name), plan_of(&scene, &by_ray), "{name}");
    }
    // The control: a relief makes another plan.
    assert_ne!(
        plan_of(&ring(), "grid:8+mask"),
        plan_of(&ring(), "raycast+mask"),
        "a relief"
    );
}

#[test]
fn a_sheet_is_drawn_once_and_merged_before_the_mesh_is_drawn() {
    let plan = plan_of(&ring(), "grid:8+mask");
    assert_eq!(
        names(&plan),
        [
            "crossings",
            "sheet clear",
            "sheet 0",
            "merge",
            "solid",
            "resolve",
            "shade"
        ],
        "passes"
    );
    let crossings = &plan.passes[0];
    assert_eq!(
        crossings.shader.path, "strategies/surface/raycast/planes.wgsl",
        "no walk"
    );
    assert!(
        plan.bounded.iter().all(|b| !b.what.contains("cells")),
        "no cells are counted: {:?}",
        plan.bounded
    );
}

#[test]
fn only_reliefs_are_drawn_all_in_one_pass() {
    let plan = plan_of(&row(), "grid:8+mask");
    let instances = |name: &str| {
        let pass = plan.passes.iter().find(|p| p.name == name);
        match &pass.unwrap_or_else(|| panic!("no {name}")).work {
            Work::Draw { draws, .. } => draws.iter().map(|d| d.instance).collect::<Vec<u32>>(),
            Work::Compute { .. } | Work::ComputeIndirect { .. } => panic!("{name} draws nothing"),
        }
    };
    assert_eq!(instances("sheet 0"), [0, 1], "two of three");
}

#[test]
fn plans_with_sheets_keep_the_rules_and_the_limits() {
    let limits = Limits {
        depth32_stencil8: true,
        ..Limits::CORE
    };
    for scene in [ring(), row()] {
        for name in LISTED {
            for rasteriser in [Rasteriser::Hardware, Rasteriser::Compute] {
                if rasteriser == Rasteriser::Compute && name.contains("stencil") {
                    continue;
                }
                let plan = plan_by(&scene, &strategy(name), rasteriser);
                let checked = plan.check(&limits);
                assert!(checked.is_ok(), "{name} by {rasteriser}: {checked:?}");
                assert!(names(&plan).contains(&"merge"), "{name} by {rasteriser}");
            }
        }
    }
}

#[test]
fn nobody_reads_the_list_before_it_is_whole() {
    for name in LISTED {
        let plan = plan_of(&row(), name);
        let merge = names(&plan).iter().position(|n| *n == "merge");
        let merge = merge.expect("a merge");
        let z = plan.resource_named("crossing_z").expect("a list");
        for (at, pass) in plan.passes.iter().enumerate() {
            let reads =
                (pass.bindings.iter()).any(|b| b.resource == z && b.access != Access::Write);
            assert!(!reads || at >= merge, "{name}: {} reads it", pass.name);
        }
    }
}

#[test]
fn the_papers_rule_draws_its_triangles_once_and_lists_nothing() {
    let plan = plan_of(&ring(), "grid:8+vds:64");
    let is_listed = |n: &str| n.contains("sheet") || n == "merge" || n == "crossings";
    let listed: Vec<&str> = names(&plan).into_iter().filter(|n| is_listed(n)).collect();
    assert!(listed.is_empty(), "{listed:?}");
    assert!(names(&plan).contains(&"cap 0"), "{:?}", names(&plan));
}
