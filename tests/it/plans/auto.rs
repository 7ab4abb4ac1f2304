//! `auto`: who draws where nobody is named, and what that is said to be.

use std::sync::Arc;

use cutaway::passes::Model;
use cutaway::plan::{Capacities, Limits};
use cutaway::scene::{Part, Scene};
use cutaway::strategies::{AdapterTraits, DrawOptions, Rasteriser, Strategy, choose, plan};
use serde_json::Value;

use crate::common::command::Scratch;
use crate::common::scenes;

/// A cut row of so many cubes.
fn row(count: usize) -> Scene {
    let mut scene = scenes::sectioned("cube", &["-z=50%"]);
    let cube = scene.parts[0].clone();
    scene.parts = (0..count)
        .map(|i| Part {
            name: format!("cube {i}"),
            mesh: Arc::clone(&cube.mesh),
            ..cube.clone()
        })
        .collect();
    scene
}

/// What is chosen on an adapter, if a software one by its limits.
fn chosen_on(
    scene: &Scene,
    asked: DrawOptions,
    size_px: [u32; 2],
    software: Option<&Limits>,
) -> (Option<Rasteriser>, String) {
    let model = Model::new(scene);
    let view = model.prepared.view(size_px);
    let traits = |limits| AdapterTraits {
        limits,
        software: true,
        sub_pixel_bits: Some(8),
    };
    let choice = choose(&model, &view, asked, software.map(traits));
    (choice.method.options.rasteriser, choice.reason)
}

fn chosen(scene: &Scene, asked: DrawOptions, software: bool) -> (Option<Rasteriser>, String) {
    let eight = Some(8);
    chosen_with(scene, asked, software, eight)
}

fn chosen_with(
    scene: &Scene,
    asked: DrawOptions,
    software: bool,
    sub_pixel_bits: Option<u32>,
) -> (Option<Rasteriser>, String) {
    let model = Model::new(scene);
    let view = model.prepared.view([64, 48]);
    let adapter = AdapterTraits {
        limits: &Limits::CORE,
        software,
        sub_pixel_bits,
    };
    let choice = choose(&model, &view, asked, Some(adapter));
    assert_eq!(choice.method.strategy, Strategy::RAYCAST_MASK, "exact");
    // What was chosen draws the scene.
    let plan = plan(&model, &view, choice.method, &Capacities::UNKNOWN);
    let plan = plan.unwrap_or_else(|refusal| panic!("{}", refusal.reason));
    plan.check(&Limits::CORE).unwrap_or_else(|e| panic!("{e}"));
    (choice.method.options.rasteriser, choice.reason)
}

#[test]
fn adapter_wish_and_refusal_choose_who_rasterises() {
    let (compute, hardware) = (Some(Rasteriser::Compute), Some(Rasteriser::Hardware));
    let any = DrawOptions::default();
    let one = row(1);
    assert_eq!(chosen(&one, any, true).0, compute, "software");
    assert_eq!(chosen(&one, any, false).0, hardware, "another adapter");
    let (by, reason) = chosen_with(&one, any, false, Some(4));
    assert_eq!(by, compute, "{reason}");
    assert!(reason.contains("1/16 px"), "{reason}");
    let unknown = chosen_with(&one, any, false, None);
    assert_eq!(unknown.0, hardware, "as in a browser");
    for asked in [Rasteriser::Hardware, Rasteriser::Compute] {
        let (by, reason) = chosen(&one, DrawOptions::by(asked), true);
        assert_eq!(by, Some(asked));
        assert!(reason.contains("requested"), "{reason}");
    }
    let (by, reason) = chosen(&row(1025), any, true);
    assert_eq!(by, hardware, "more parts than the table holds");
    assert!(reason.contains("1025"), "{reason}");
    // The control: as many as it holds.
    assert_eq!(chosen(&row(1024), any, true).0, compute);
}

#[test]
fn a_mesh_that_no_binding_holds_is_left_to_fixed_functions() {
    let compute = Some(Rasteriser::Compute);
    let any = DrawOptions::default();
    let scene = row(20);
    let tight = Limits {
        // 160 corners take 2560 bytes, and as much on the screen.
        storage_binding_bytes: 2500,
        ..Limits::CORE
    };
    let (by, reason) = chosen_on(&scene, any, [4, 4], Some(&tight));
    assert_eq!(by, Some(Rasteriser::Hardware), "{reason}");
    assert!(reason.contains("the limit is 2500"), "{reason}");
    // The controls: fewer corners; and a picture that is too large, which is drawn in bands.
    assert_eq!(chosen_on(&row(1), any, [4, 4], Some(&tight)).0, compute);
    let limits = Limits::CORE;
    let large = chosen_on(&scene, any, [8192, 8192], Some(&limits));
    assert_eq!(large.0, compute, "{}", large.1);
}

#[test]
fn what_was_chosen_is_told_with_its_reason() {
    let folder = Scratch::new("auto");
    let cut = "shape:cube --section -z=50%";
    let text = folder.run(&format!("plan {cut}")).exits(0);
    let lines: Vec<&str> = text.text().lines().take(2).collect();
    assert!(lines[0].starts_with("raycast+mask@"), "{lines:?}");
    assert!(lines[1].starts_with("auto, for "), "{lines:?}");
    let told = |words: &str| {
        let line = format!("render {cut} {words} --resolution 32,24 --json - -o out.png");
        folder.run(&line).exits(0).json()
    };
    for words in ["", "--strategy auto", "--set strategy.name=auto"] {
        let json = told(words);
        assert_eq!(json["strategy"], "raycast+mask", "{words}");
        assert!(json["chosen_for"].is_string(), "{words}");
    }
    for words in ["--strategy raycast+mask", "--strategy exact"] {
        assert_eq!(told(words)["chosen_for"], Value::Null, "{words}");
    }
    let json = told("--rasteriser hardware");
    assert_eq!(json["rasteriser"], "hardware");
    let reason = json["chosen_for"].as_str().unwrap_or_default();
    assert!(reason.contains("hardware"), "{reason}");
    let refused = folder.run(&format!("render {cut} --strategy auot -o out.png"));
    refused.must_refuse(&["auot", "help:"]);
}

#[test]
fn a_cut_is_priced_against_the_uncut_scene_by_its_own_rasteriser() {
    let folder = Scratch::new("price");
    let compare = |methods: &str| {
        let scene = "shape:cube --section -z=50% --resolution 64,48 --rounds 3";
        let line = format!("compare {scene} --strategies {methods} --json -");
        folder.run(&line).exits(0).json()
    };
    let numbers = |value: &Value| -> Vec<f64> {
        let samples = value["samples"].as_array().into_iter().flatten();
        samples.filter_map(Value::as_f64).collect()
    };
    let middle = |mut values: Vec<f64>| {
        values.sort_by(f64::total_cmp);
        values[values.len() / 2]
    };
    let json = compare("raycast+mask,raycast+mask@compute");
    for (i, uncut) in ["draw_only_ms", "draw_only_compute_ms"].iter().enumerate() {
        let strategy = &json["strategies"][i];
        let frame = numbers(&strategy["time_ms"]["frame"]);
        let uncut = numbers(&json[uncut]);
        let pairs = || frame.iter().zip(&uncut);
        let ratio = middle(pairs().map(|(a, b)| a / b).collect());
        let rest = middle(pairs().map(|(a, b)| a - b).collect());
        let told = |field: &str| strategy["cut"][field].as_f64().unwrap_or(f64::NAN);
        assert!((told("over_uncut") - ratio).abs() < 1e-9, "{strategy}");
        assert!((told("ms") - rest).abs() < 1e-9, "{strategy}");
        let covered = ["cap_px", "surface_px"].map(|f| json["exact"][f].as_f64().unwrap());
        let each = rest * 1e6 / (covered[0] + covered[1]);
        assert!((told("ns_per_px") - each).abs() < 1e-6 * each.abs().max(1.0));
    }
    // The control: who is not asked is not measured.
    assert!(compare("raycast+mask")["draw_only_compute_ms"].is_null());
}
