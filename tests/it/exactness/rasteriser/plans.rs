//! Plans of the compute rasteriser: no target of the GPU's own, and no pass that the scene does not call for.

use cutaway::Model;
use cutaway::plan::{Capacities, Limits, Plan, Work};
use cutaway::scene::{Camera, Scene};
use cutaway::strategies::{self, DrawOptions, Method, Rasteriser, Refusal, Strategy};
use glam::DVec3;

use crate::common::{scenes, strategy};

const COMPUTE: DrawOptions = DrawOptions::by(Rasteriser::Compute);
const HARDWARE: DrawOptions = DrawOptions::by(Rasteriser::Hardware);
const WIDE: DrawOptions = DrawOptions {
    wide_atomics: Some(true),
    ..COMPUTE
};
/// Core WebGPU but for atomics of 64 bits.
const LIMITS: Limits = Limits {
    wide_atomics: true,
    ..Limits::CORE
};

fn recorded(
    scene: &Scene,
    camera: &Camera,
    strategy: &Strategy,
    options: &DrawOptions,
) -> Result<Plan, Refusal> {
    let model = Model::new(scene);
    let view = model.prepared.view_of(camera, [320, 200]);
    strategies::plan(
        &model,
        &view,
        Method::new(*strategy, *options),
        &Capacities::UNKNOWN,
    )
}

/// A plan, held to core WebGPU unless it may use more.
fn plan(scene: &Scene, camera: &Camera, options: &DrawOptions) -> Plan {
    let plan =
        recorded(scene, camera, &Strategy::RAYCAST_MASK, options).unwrap_or_else(|e| panic!("{e}"));
    let limits = if options.wide_atomics == Some(true) {
        &LIMITS
    } else {
        &Limits::CORE
    };
    plan.check(limits).unwrap_or_else(|e| panic!("{e}"));
    plan
}

fn names(plan: &Plan) -> Vec<&str> {
    plan.passes.iter().map(|p| p.name.as_str()).collect()
}

#[test]
fn a_computed_frame_has_no_target_to_draw_into() {
    let planes: Vec<String> = (1..10).map(|i| format!("-z={}%", 10 * i)).collect();
    let planes: Vec<&str> = planes.iter().map(String::as_str).collect();
    for sections in [&planes[..1], &planes[..2], &planes[..8], &planes] {
        let scene = scenes::sectioned("earth?subdivisions=3", sections);
        let camera = Camera::default();
        let computed = plan(&scene, &camera, &COMPUTE);
        // The sweep itself finds the tiles, as long as no pass lists crossings.
        let lists = sections.len() > 8;
        let before_sweeps = match lists {
            false => &["blank", "transform"][..],
            true => &[
                "blank",
                "transform",
                "tiles",
                "pieces sum 1",
                "pieces scan",
                "pieces spread 1",
                "large tiles",
                "crossings",
            ],
        };
        let marks = match lists {
            false => &[
                "mark small",
                "pieces sum 1",
                "pieces scan",
                "pieces spread 1",
                "mark large",
            ][..],
            true => &["mark small", "mark large"],
        };
        let passes = ["claim small", "claim large", "decide", "paint"];
        let expected: Vec<&str> = (before_sweeps.iter().chain(marks))
            .copied()
            .chain(passes)
            .collect();
        assert_eq!(names(&computed), expected, "{sections:?}");
        let fused = plan(&scene, &camera, &WIDE);
        let without_claims: Vec<&str> = (expected.iter().copied())
            .filter(|name| !name.starts_with("claim"))
            .collect();
        assert_eq!(names(&fused), without_claims, "{sections:?}");
        assert!(fused.check(&Limits::CORE).is_err(), "64 bits are not core");
        assert!(
            computed
                .passes
                .iter()
                .all(|p| !matches!(p.work, Work::Draw { .. })),
            "{sections:?}"
        );
        for target in ["surface_words", "surface_depth"] {
            assert_eq!(computed.resource_named(target), None, "{sections:?}");
        }
        // The control: the other rasteriser has both.
        let drawn = plan(&scene, &camera, &HARDWARE);
        assert!(
            drawn.resource_named("surface_depth").is_some(),
            "{sections:?}"
        );
        assert!(drawn.resource_named("screen").is_none(), "{sections:?}");
    }
}

#[test]
fn both_sweeps_run_the_same_pipelines() {
    let plan = plan(
        &scenes::sectioned("cube", &["-z=50%"]),
        &Camera::default(),
        &COMPUTE,
    );
    let pass = |name: &str| {
        plan.passes
            .iter()
            .find(|p| p.name == name)
            .unwrap_or_else(|| panic!("{name}"))
    };
    for size in ["small", "large"] {
        let (mark, claim) = (
            pass(&format!("mark {size}")),
            pass(&format!("claim {size}")),
        );
        assert_eq!(
            (&mark.shader, &mark.constants),
            (&claim.shader, &claim.constants),
            "{size}"
        );
        assert_ne!(mark.bindings, claim.bindings, "{size}: another sweep");
    }
}

#[test]
fn only_a_near_plane_or_a_guard_band_calls_for_clipping() {
    let scene = scenes::sectioned("cube", &["-z=50%"]);
    for (camera, clips) in [
        (Camera::default(), false),
        (scenes::looking(DVec3::Z * 0.1, DVec3::X, 60.0), true),
        (scenes::parallel(DVec3::Z * 5.0, DVec3::ZERO, 0.01), true),
        (scenes::parallel(DVec3::Z * 5.0, DVec3::ZERO, 1.0), false),
    ] {
        let plan = plan(&scene, &camera, &COMPUTE);
        assert_eq!(names(&plan).contains(&"clipped"), clips, "{camera:?}");
    }
}

#[test]
fn nothing_cut_is_drawn_as_ever_and_the_paper_is_refused() {
    let plain = scenes::sectioned("cube", &[]);
    let camera = Camera::default();
    assert_eq!(
        plan(&plain, &camera, &COMPUTE),
        plan(&plain, &camera, &HARDWARE),
        "without a cut"
    );
    let cut = scenes::sectioned("cube", &["-z=50%"]);
    let refusal =
        recorded(&cut, &camera, &strategy("grid:8+vds:64"), &COMPUTE).expect_err("a refusal");
    assert!(refusal.reason.contains("vds:64"), "{refusal}");
}
