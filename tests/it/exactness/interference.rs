//! Promise: where solids overlap at a cap is told right, shown if asked for, and costs nothing if not.

use crate::common;

use common::{Question, meshes, scenes, session, strategy};
use cutaway::Model;
use cutaway::layers::{Kind, Layers};
use cutaway::plan::{Capacities, Plan};
use cutaway::scene::{Camera, ClipSurface, Cut, Part, Role, Scene};
use cutaway::session::Outcome;
use cutaway::strategies::{self, DrawOptions, Method, Rasteriser, Strategy};
use glam::{DAffine3, DVec3, Vec3};

const SIZE: [u32; 2] = [128, 96];
const MAGENTA: [u8; 3] = [255, 0, 170];

/// The scene, with its overlaps hatched.
fn asking(scene: &Scene) -> Scene {
    Scene {
        interference: Some(Vec3::from(MAGENTA.map(f32::from)) / 255.0),
        ..scene.clone()
    }
}

/// Balls that share space, each a part of its own.
fn balls(offsets: &[f64]) -> Scene {
    let parts = offsets.iter().map(|x| {
        let mut ball = Part::new(
            format!("ball at {x}"),
            meshes::shape("sphere?subdivisions=3"),
        );
        ball.world_from_part = DAffine3::from_translation(DVec3::X * *x);
        ball
    });
    let mut scene = scenes::of_parts("balls", parts.collect(), Vec::new());
    let plane = ClipSurface::parse("-0.1,-0.2,-1@0,0,0.03", &scene.bounds()).expect("a section");
    scene.cuts = vec![Cut::new("cut", vec![plane])];
    scene
}

fn shown(question: &Question, strategy: &Strategy, options: DrawOptions) -> (Layers, Vec<u8>) {
    let mut session = session();
    let method = Method::new(*strategy, options);
    let drawn = (session.draw(&question.model, &question.view, method)).expect("a frame");
    assert_eq!(drawn.outcome, Outcome::Complete, "{strategy}");
    (
        session.layers(method).expect("layers"),
        session.picture(method).expect("a picture"),
    )
}

/// Decided pixels where two frames disagree on overlap.
fn differing(question: &Question, layers: &Layers) -> usize {
    let exact = &question.exact;
    (0..layers.pixels.len())
        .filter(|i| !exact.undecided[*i] && !exact.overlap_open[*i])
        .filter(|i| exact.layers.pixels[*i].overlap != layers.pixels[*i].overlap)
        .count()
}

/// Scenes in which solids overlap at caps of every kind.
fn overlapping() -> Vec<(&'static str, Scene)> {
    let mut relief = balls(&[-0.2, 0.2]);
    let rough = scenes::relief(&relief, "-z=55%", "waves:size=32,amplitude=8%");
    relief.cuts = vec![Cut::new("cut", vec![rough])];
    let mut preferred = balls(&[-0.2, 0.2]);
    preferred.parts[0].priority = Some(3);
    let mut near = balls(&[-0.2, 0.1]);
    near.camera = Camera {
        near: Some(0.05),
        ..scenes::looking(DVec3::new(0.0, 0.1, -0.1), DVec3::new(0.3, 0.0, -1.0), 60.0)
    };
    let mut several = balls(&[-0.2, 0.2]);
    let bounds = several.bounds();
    let side = ClipSurface::parse("1,0.1,0.2@-0.1,0,0", &bounds).expect("a section");
    several.cuts.push(Cut::new("side", vec![side]));
    vec![
        ("two balls", balls(&[-0.2, 0.2])),
        ("three balls", balls(&[-0.3, 0.0, 0.3])),
        ("a relief", relief),
        ("the left one preferred", preferred),
        ("the eye in both", near),
        ("two cuts", several),
        (
            "nested by design",
            scenes::sectioned("earth?subdivisions=3", &["-z=50%"]),
        ),
    ]
}

#[test]
fn overlaps_are_those_of_exact() {
    for (name, scene) in overlapping() {
        let (question, unasked) = (
            Question::new(&asking(&scene), SIZE),
            Question::new(&scene, SIZE),
        );
        let open = question.exact.overlap_open.iter().filter(|o| **o).count();
        let caps = question.exact.layers.count(Kind::Cap);
        assert!(open * 50 < caps, "{name}: {open} of {caps} are open");
        let truth = question.exact.layers.overlap_px();
        assert!(
            truth > 40,
            "{name}: {truth} pixels overlap: it asks nothing"
        );
        for (strategy, rasteriser) in [
            (Strategy::RAYCAST_MASK, Rasteriser::Hardware),
            (Strategy::RAYCAST_MASK, Rasteriser::Compute),
            (Strategy::RAYCAST_STENCIL, Rasteriser::Hardware),
            (strategy("raycast+abuffer"), Rasteriser::Hardware),
            (strategy("raycast+abuffer"), Rasteriser::Compute),
        ] {
            let (layers, _) = shown(&question, &strategy, DrawOptions::by(rasteriser));
            let what = format!("{name}: {strategy} by {rasteriser}");
            assert_eq!(question.compare(&layers).decided_wrong_px, 0, "{what}");
            assert_eq!(
                question.compare(&layers).overlap_px,
                layers.overlap_px(),
                "{what}"
            );
            assert_eq!(differing(&question, &layers), 0, "{what}");
        }
        // The control: who does not ask is not told, and that is noticed.
        let (layers, _) = shown(&unasked, &Strategy::RAYCAST_MASK, DrawOptions::default());
        assert_eq!(layers.overlap_px(), 0, "{name}: nobody asked");
        assert!(differing(&unasked, &layers) > 0, "{name}: anything passes");
    }
}

#[test]
fn what_no_cut_opens_does_not_overlap() {
    let mut apart = balls(&[-0.6, 0.6]);
    apart.name = "apart".to_owned();
    let mut spared = balls(&[-0.2, 0.2]);
    spared.parts[0].role = Role::Interior;
    for scene in [apart, spared] {
        let question = Question::new(&asking(&scene), SIZE);
        assert!(
            question.exact.layers.count(Kind::Cap) > 100,
            "{}",
            scene.name
        );
        assert_eq!(question.exact.layers.overlap_px(), 0, "{}", scene.name);
        let (layers, _) = shown(&question, &Strategy::RAYCAST_MASK, DrawOptions::default());
        assert_eq!(layers.overlap_px(), 0, "{}", scene.name);
    }
}

#[test]
fn the_overlap_is_the_lens_of_the_balls() {
    // Seen from above, two balls of radius 1/2 at x = -0.2 and 0.2 share a lens of the cut plane.
    let mut scene = balls(&[-0.2, 0.2]);
    let plane = ClipSurface::parse("-z=0", &scene.bounds()).expect("a section");
    scene.cuts = vec![Cut::new("cut", vec![plane])];
    scene.camera = scenes::parallel(DVec3::Z * 4.0, DVec3::ZERO, 1.2);
    let exact = Question::new(&scene, [240, 240]).exact;
    let pixel_area = (1.2_f64 / 240.0).powi(2);
    let area = exact.layers.overlap_px() as f64 * pixel_area;
    let (r, half) = (0.5_f64, 0.2_f64);
    let lens = 2.0 * (r * r * (half / r).acos() - half * (r * r - half * half).sqrt());
    assert!((area - lens).abs() < 0.03 * lens, "{area} of {lens}");
}

#[test]
fn the_picture_is_hatched_there_and_nowhere_else() {
    for rasteriser in [Rasteriser::Hardware, Rasteriser::Compute] {
        hatched_by(rasteriser);
    }
}

fn hatched_by(rasteriser: Rasteriser) {
    let scene = balls(&[-0.2, 0.2]);
    let [plain, asked] = [scene.clone(), asking(&scene)].map(|scene| {
        let question = Question::new(&scene, SIZE);
        shown(
            &question,
            &Strategy::RAYCAST_MASK,
            DrawOptions::by(rasteriser),
        )
    });
    let pixels = plain.1.chunks(4).zip(asked.1.chunks(4)).enumerate();
    let (mut striped, mut between) = (0, 0);
    for (i, (before, after)) in pixels {
        let overlaps = asked.0.pixels[i].overlap;
        assert!(
            overlaps || before == after,
            "{rasteriser}: pixel {i} changed without a reason"
        );
        if overlaps {
            let is_magenta = after[1] < after[0] / 2 && after[1] < after[2];
            striped += usize::from(before != after && is_magenta);
            between += usize::from(before == after);
        }
    }
    assert!(
        striped > 200 && between > 100,
        "{rasteriser}: {striped} striped, {between} between"
    );
}

fn plan_of(scene: &Scene, name: &str, options: DrawOptions) -> Result<Plan, String> {
    let model = Model::new(scene);
    let view = model.prepared.view(SIZE);
    let strategy = strategy(name);
    strategies::plan(
        &model,
        &view,
        Method::new(strategy, options),
        &Capacities::UNKNOWN,
    )
    .map_err(|refusal| refusal.reason)
}

#[test]
fn a_plan_asks_where_solids_overlap_only_if_two_could() {
    for rasteriser in [Rasteriser::Hardware, Rasteriser::Compute] {
        asked_of(rasteriser);
    }
}

fn asked_of(rasteriser: Rasteriser) {
    let asks = |plan: &Plan| {
        let one_of = |names: [&str; 2]| {
            let mut passes = plan.passes.iter();
            passes.find(|p| names.contains(&p.name.as_str()))
        };
        let resolve = one_of(["resolve", "decide"]).expect("it resolves");
        let shade = one_of(["shade", "paint"]).expect("it shades");
        let [asks, shows, bound] = [
            resolve.constants.iter().any(|c| c.0 == "overlaps"),
            shade.shader.with.contains(&"lib/overlap/hatched.wgsl"),
            plan.resource_named("interference").is_some(),
        ];
        assert!(asks == shows && shows == bound, "all of it or nothing");
        asks
    };
    let options = DrawOptions::by(rasteriser);
    let plan = |scene: &Scene| plan_of(scene, "raycast+mask", options).expect("a plan");
    let two = balls(&[-0.2, 0.2]);
    assert!(!asks(&plan(&two)), "off");
    assert!(asks(&plan(&asking(&two))), "on");
    let one = balls(&[0.0]);
    let hatched = plan(&asking(&one));
    assert!(!asks(&hatched), "one part");
    assert_eq!(hatched, plan(&one), "one part");
    if rasteriser == Rasteriser::Compute {
        return;
    }
    // Who draws the caps of each part by themselves cannot tell, and says so.
    for name in ["stencil", "grid:8+vds:64"] {
        let message = plan_of(&asking(&two), name, options).expect_err(name);
        assert!(
            message.contains("does not tell where solids overlap"),
            "{message}"
        );
        assert!(plan_of(&two, name, options).is_ok(), "{name}: nobody asked");
    }
}
