//! `height_filter = "hardware"`: what of a plan it changes, who refuses it and why, and that frames read heights through the sampler.
//!
//! Mesa's software adapter interpolates 32-bit floats in f32 whatever it says of its bits, so that frames by either filter are the
//! same there to rounding; that they come from different places is proved by heights that are changed in one of them.

use cutaway::gpu::{ClockSet, Program};
use cutaway::layers::{Kind, Layers};
use cutaway::plan::{Capacities, Limits, Plan, Shape};
use cutaway::scene::{Cut, HeightFilter, Scene, Wrap};
use cutaway::strategies::{self, DrawOptions, Method};
use glam::DVec3;

use crate::common;
use crate::common::command;

use command::Scratch;
use common::{Question, is_wrong, meshes, scenes, session, strategy};

const SIZE: [u32; 2] = [240, 180];

/// What a device that filters 32-bit floats offers.
const FILTERING: Limits = Limits {
    filters_f32: true,
    ..Limits::CORE
};

fn options(filter: HeightFilter) -> DrawOptions {
    DrawOptions {
        height_filter: Some(filter),
        ..DrawOptions::default()
    }
}

/// A ring cut by two steep reliefs, the second of maps of this size that goes on in this way.
fn ring(size: [u32; 2], wrap: Wrap) -> Scene {
    let mut scene = scenes::of_parts("ring", meshes::parts("torus?segments=60&sides=30"), vec![]);
    let height = |x: u32, y: u32| ((x * 5 + y * 3 + x * y) % 7) as f32 / 6.0 - 0.5;
    let relief = |normal: DVec3, size: [u32; 2], wrap: Wrap| {
        scenes::mapped(
            DVec3::ZERO,
            normal,
            scenes::map(size, height),
            (1.1, 0.35),
            wrap,
        )
    };
    scene.cuts = vec![Cut::new(
        "cut",
        vec![
            relief(DVec3::new(-0.3, -0.25, -1.0), [8, 8], Wrap::Repeat),
            relief(DVec3::new(-1.0, 0.2, 0.1), size, wrap),
        ],
    )];
    scene
}

fn recorded(scene: &Scene, name: &str, options: &DrawOptions) -> Result<Plan, String> {
    let question = Question::new(scene, [64, 48]);
    let capacities = Capacities {
        sheets: Some(100_000),
        crossings: Some(31),
        ..Capacities::UNKNOWN
    };
    let plan = strategies::plan(
        &question.model,
        &question.view,
        Method::new(strategy(name), *options),
        &capacities,
    );
    plan.map_err(|refusal| refusal.reason)
}

fn plan(scene: &Scene, name: &str, filter: HeightFilter) -> Plan {
    recorded(scene, name, &options(filter)).unwrap_or_else(|e| panic!("{name}: {e}"))
}

/// Passes that read heights through a sampler.
fn sampling(plan: &Plan) -> Vec<&str> {
    let sampled = plan.passes.iter().filter(|p| {
        p.bindings
            .iter()
            .any(|b| matches!(plan.resource(b.resource).shape, Shape::Sampler { .. }))
    });
    sampled.map(|p| p.name.as_str()).collect()
}

#[test]
fn only_what_asks_for_heights_at_points_reads_them_through_the_sampler() {
    let scene = ring([8, 8], Wrap::Repeat);
    for (name, passes) in [
        ("grid:16+vds:32", vec!["clip", "cap 0"]),
        ("grid:16+ldi:32", vec!["clip", "cap 0"]),
        ("grid:16+mask", vec!["sheet 0", "merge"]),
    ] {
        let by_sampler = plan(&scene, name, HeightFilter::Hardware);
        assert_eq!(sampling(&by_sampler), passes, "{name}");
        let maps = by_sampler.resource_named("relief_maps").expect(name);
        let bytes = by_sampler.resource(maps).shape.bytes();
        assert_eq!(bytes, 8 * 8 * 4 * 2, "{name}: two maps of 8 x 8");
        by_sampler
            .check(&FILTERING)
            .unwrap_or_else(|e| panic!("{name}: {e}"));

        let exact = plan(&scene, name, HeightFilter::Exact);
        assert_eq!(sampling(&exact), Vec::<&str>::new(), "{name}");
        exact
            .check(&Limits::CORE)
            .unwrap_or_else(|e| panic!("{name}: {e}"));
        let usual = recorded(&scene, name, &DrawOptions::default());
        assert_eq!(usual.map(|p| p.to_text()), Ok(exact.to_text()), "{name}");
    }
}

#[test]
fn planes_and_level_reliefs_hear_nothing_of_it() {
    let plane = scenes::sectioned("torus?segments=40&sides=20", &["-z=50%"]);
    let mut level = plane.clone();
    let map = scenes::map([4, 4], |_, _| 0.25);
    let surface = scenes::mapped(DVec3::ZERO, DVec3::NEG_Z, map, (1.0, 0.5), Wrap::Mirror);
    level.cuts = vec![Cut::new("cut", vec![surface])];
    for scene in [plane, level] {
        for name in [
            "grid:16+vds:32",
            "grid:16+mask",
            "raycast+mask",
            "adaptive:1+ldi:32",
        ] {
            let [by_sampler, exact] = [HeightFilter::Hardware, HeightFilter::Exact]
                .map(|filter| plan(&scene, name, filter).to_text());
            assert_eq!(by_sampler, exact, "{name}");
        }
    }
}

#[test]
fn what_a_sampler_cannot_do_is_refused_with_the_reason() {
    let hardware = options(HeightFilter::Hardware);
    let alike = ring([8, 8], Wrap::Repeat);
    for (scene, name, phrase) in [
        (&alike, "raycast+mask", "four texels span"),
        (&alike, "raycast+ldi:32", "four texels span"),
        (
            &alike,
            "adaptive:1+mask",
            "measures its triangles against four texels",
        ),
        (&alike, "adaptive:1+vds:32", "asks no sampler"),
        (&alike, "planar", "plan"),
        (
            &ring([8, 4], Wrap::Repeat),
            "grid:16+vds:32",
            "maps of 8 x 8 and of 8 x 4 texels",
        ),
        (
            &ring([8, 8], Wrap::Mirror),
            "grid:16+mask",
            "in different ways (wrap)",
        ),
    ] {
        let reason = recorded(scene, name, &hardware).expect_err(name);
        assert!(reason.contains(phrase), "{name}: {reason}");
    }
    // The control: the same scenes are drawn where no sampler is asked for.
    for scene in [ring([8, 4], Wrap::Repeat), ring([8, 8], Wrap::Mirror)] {
        for name in ["grid:16+vds:32", "raycast+mask"] {
            let usual = recorded(&scene, name, &DrawOptions::default());
            assert!(usual.is_ok(), "{name}: {:?}", usual.err());
        }
    }
    let by_sampler = plan(&alike, "grid:16+vds:32", HeightFilter::Hardware);
    let error = by_sampler
        .check(&Limits::CORE)
        .expect_err("core WebGPU has no such filter");
    assert!(error.to_string().contains("float32-filterable"), "{error}");
}

/// The layers of a plan that was run.
fn layers(plan: Plan) -> Layers {
    let session = session();
    let gpu = session.gpu();
    let mut program = Program::default();
    program.load(gpu, plan).unwrap_or_else(|e| panic!("{e}"));
    (program.run(gpu, ClockSet::ALL)).unwrap_or_else(|e| panic!("{e}"));
    program.layers(gpu, SIZE).unwrap_or_else(|e| panic!("{e}"))
}

/// Pixels that show different things.
fn differing(a: &Layers, b: &Layers) -> usize {
    let pairs = a.pixels.iter().zip(&b.pixels);
    pairs.filter(|(a, b)| is_wrong(a, b)).count()
}

#[test]
fn frames_read_heights_through_the_sampler_and_are_what_they_were_but_for_its_bits() {
    let scene = ring([8, 8], Wrap::Repeat);
    let question = Question::new(&scene, SIZE);
    for name in ["grid:64+vds:128", "grid:64+mask"] {
        let draw = |filter| {
            let mut session = session();
            let method = Method::new(strategy(name), options(filter));
            let drawn = session.draw(&question.model, &question.view, method);
            let drawn = drawn.unwrap_or_else(|e| panic!("{name}: {e}"));
            let layers = session.layers(method).expect("layers");
            let plan = session.plan(method).expect("a plan").clone();
            assert_eq!(drawn.outcome.name(), "complete", "{name}");
            (layers, plan)
        };
        let (exact, _) = draw(HeightFilter::Exact);
        let (sampled, plan) = draw(HeightFilter::Hardware);
        let caps = exact.count(Kind::Cap);
        assert!(caps > 2000, "{name}: {caps} caps");
        let apart = differing(&exact, &sampled);
        println!("{name}: {apart} of {caps} caps differ by the sampler");
        assert!(apart * 50 < caps, "{name}: {apart} pixels of {caps} differ");

        // The control: with other heights in the texture, and the same in the buffer, the frame is another.
        let mut planted = plan;
        let maps = planted.resource_named("relief_maps").expect("a texture");
        let resource = &mut planted.resources[maps.0];
        let bytes = resource.contents.as_ref().expect("heights").bytes();
        let heights: Vec<f32> = bytemuck::pod_collect_to_vec(&bytes);
        let raised: Vec<f32> = heights.iter().map(|h| h + 0.2).collect();
        resource.contents = Some(cutaway::plan::Contents::from_values(&raised));
        let raised = differing(&sampled, &layers(planted));
        assert!(
            raised * 5 > caps,
            "{name}: only {raised} of {caps} pixels differ"
        );
    }
}

#[test]
fn scene_files_and_options_ask_for_it() {
    let folder = Scratch::new("height-filter");
    let scene = |first: &str| {
        format!(
            "{first}\n[[part]]\nname = \"ring\"\nshape = \"torus?segments=20&sides=10\"\n[relief.r]\nkind = \"waves\"\n\
             [[cut]]\nsurfaces = [{{ section = \"-z=50%\", relief = \"r\", amplitude = \"6%\" }}]\n"
        )
    };
    folder.write("asks.toml", scene("height_filter = \"hardware\""));
    folder.write("usual.toml", scene(""));
    folder.write("wrong.toml", scene("height_filter = \"hardwear\""));
    let grid = "--strategy grid:8+vds:16";
    for (line, is_sampled) in [
        (format!("plan asks.toml {grid}"), true),
        (
            format!("plan asks.toml {grid} --height-filter exact"),
            false,
        ),
        (format!("plan usual.toml {grid}"), false),
        (
            format!("plan usual.toml {grid} --height-filter hardware"),
            true,
        ),
    ] {
        let ran = folder.run(&line).exits(0);
        assert_eq!(ran.text().contains("relief_sampler"), is_sampled, "{line}");
    }
    for (line, phrase) in [
        ("plan wrong.toml", "wrong.toml:1:1: `height_filter`"),
        (
            "plan usual.toml --height-filter soft",
            "possible values: exact, hardware",
        ),
        (
            "plan asks.toml --strategy raycast+mask",
            "asks no sampler for heights",
        ),
    ] {
        let ran = folder.run(line).exits(2);
        assert!(ran.stderr.contains(phrase), "{line}: {}", ran.stderr);
    }
}
