//! A style adds what it asks for and nothing else.

use cutaway::plan::{Capacities, Plan};
use cutaway::scene::style::{Shading, Strokes};
use cutaway::{shader, strategies};

use super::*;

fn plan_in(style: Style) -> Plan {
    let model = Model::new(&scene_in(style));
    let view = model.prepared.view(SIZE_PX);
    strategies::plan(&model, &view, Strategy::RAYCAST_MASK, &Capacities::UNKNOWN)
        .unwrap_or_else(|refusal| panic!("{}", refusal.reason))
}

fn passes(plan: &Plan) -> Vec<&str> {
    plan.passes.iter().map(|p| p.name.as_str()).collect()
}

/// Names of the functions that the last pass is made of.
fn functions(plan: &Plan) -> Vec<String> {
    let last = plan.passes.last().expect("a pass");
    let composed = shader::compose(&last.shader).unwrap_or_else(|e| panic!("{e}"));
    let functions = composed.module.functions.iter();
    functions.filter_map(|(_, f)| f.name.clone()).collect()
}

#[test]
fn each_style_has_the_passes_that_it_asks_for() {
    let lit = plan_in(Style::default());
    let [shared @ .., "shade"] = &passes(&lit)[..] else {
        panic!("lit ends in {:?}", passes(&lit).last());
    };
    let tiles = ["find tiles", "clear picture", "list tiles"];
    for (name, end) in [
        (
            "technical",
            &[
                "find borders",
                "place strokes",
                "find horizons",
                "smooth occlusion",
                "illustrate",
            ][..],
        ),
        ("drafting", &["find borders", "place strokes", "illustrate"]),
        ("clay", &["find horizons", "smooth occlusion", "illustrate"]),
    ] {
        let plan = plan_in(style(name));
        assert_eq!(passes(&plan), [shared, &tiles, end].concat(), "{name}");
        for (resource, pass) in [
            ("borders", "find borders"),
            ("strokes", "place strokes"),
            ("visibility", "smooth occlusion"),
        ] {
            let is_there = plan.resource_named(resource).is_some();
            assert_eq!(is_there, end.contains(&pass), "{name}: {resource}");
        }
    }
    let unsharp = Style {
        occlusion: Occlusion {
            kind: OcclusionKind::Unsharp,
            ..Occlusion::default()
        },
        ..Style::default()
    };
    let end = ["blur depth", "mask depth", "illustrate"];
    assert_eq!(passes(&plan_in(unsharp)), [shared, &tiles, &end].concat());
    let without_effect = Style {
        occlusion: Occlusion {
            surface: 0.0,
            cap: 0.0,
            ..unsharp.occlusion
        },
        ..unsharp
    };
    let end = ["illustrate"];
    assert_eq!(
        passes(&plan_in(without_effect)),
        [shared, &tiles, &end].concat()
    );
}

#[test]
fn what_is_drawn_on_the_background_has_no_tiles() {
    let ghostly = Style {
        ghost: Ghost {
            kind: GhostKind::Lines,
            ..Ghost::default()
        },
        ..style("technical")
    };
    assert!(!passes(&plan_in(ghostly)).contains(&"find tiles"), "ghost");
    // The control.
    assert!(passes(&plan_in(style("technical"))).contains(&"find tiles"));
}

#[test]
fn no_effect_leaves_a_trace_where_it_is_not_asked_for() {
    let has = |style, name: &str| functions(&plan_in(style)).iter().any(|f| f.contains(name));
    for (name, with, without) in [
        ("stroke_cover", "technical", "clay"),
        ("half_px_of", "technical", "clay"),
        ("hatch_cover", "drafting", "clay"),
        ("occluded_share", "clay", "drafting"),
        ("family_cover", "ink", "technical"),
    ] {
        assert!(has(style(with), name), "{name}: the control");
        assert!(!has(style(without), name), "{name} in {without}");
        assert!(!has(Style::default(), name), "{name} in lit");
    }
    let without = Style {
        strokes: Strokes::default(),
        ..style("technical")
    };
    assert!(
        !passes(&plan_in(without)).contains(&"find borders"),
        "no strokes"
    );
    let flat = Style {
        shading: Shading::Flat,
        paper: Paper::Gradient,
        ..Style::default()
    };
    let plan = plan_in(flat);
    assert!(
        plan.resource_named("style").is_none(),
        "flat asks for no number"
    );
    assert!(!has(flat, "diffuse_light"), "flat has no light");
    assert!(has(Style::default(), "diffuse_light"), "the control");
}

#[test]
fn the_compute_rasteriser_leaves_colours_to_a_style() {
    let painted = |style| {
        let model = Model::new(&scene_in(style));
        let view = model.prepared.view(SIZE_PX);
        let method = Method::new(Strategy::RAYCAST_MASK, DrawOptions::by(Rasteriser::Compute));
        let plan = strategies::plan(&model, &view, method, &Capacities::UNKNOWN);
        let plan = plan.unwrap_or_else(|refusal| panic!("{}", refusal.reason));
        let names: Vec<String> = plan.passes.iter().map(|p| p.name.clone()).collect();
        let paint = plan.passes.iter().find(|p| p.name == "paint");
        let colours =
            (paint.expect("a pass that paints").bindings.iter()).any(|b| b.name == "picture");
        (names.last().cloned().unwrap_or_default(), colours)
    };
    assert_eq!(painted(Style::default()), ("paint".to_owned(), true));
    assert_eq!(
        painted(style("technical")),
        ("illustrate".to_owned(), false)
    );
}
