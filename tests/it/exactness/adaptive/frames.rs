//! Frames of `adaptive`: what every inside test makes of its list, what is measured again and what is not, and room for triangles.

use std::sync::Arc;

use cutaway::gpu::{ClockSet, Program};
use cutaway::layers::{Kind, Layers};
use cutaway::passes::{Model, NEED_OF_TRIANGLES};
use cutaway::plan::{Capacities, Clock, Limits, Plan};
use cutaway::scene::{Camera, ClipSurface, Cut, Scene, Wrap};
use cutaway::session::Outcome;
use cutaway::strategies::{self, DrawOptions, Method, Rasteriser};
use glam::DVec3;

use super::common::{
    Question, class_of, gpu, hardware_precision, meshes, scenes, session, strategy,
};
use super::refined::drawn;
use super::{cut_ball, noise};

fn smooth() -> Scene {
    let waves = scenes::map([40, 24], |x, y| {
        (x as f32 * 0.6).sin() + (y as f32 * 0.5).cos()
    });
    cut_ball(waves, 0.8, 0.06, Wrap::Mirror)
}

/// Two reliefs and a plane.
fn three() -> Scene {
    let relief = |normal, seed| {
        scenes::mapped(
            DVec3::ZERO,
            normal,
            noise([20, 20], seed),
            (0.7, 0.05),
            Wrap::Repeat,
        )
    };
    let mut scene = scenes::scene(
        "three",
        meshes::shape("sphere?subdivisions=3"),
        vec![
            relief(DVec3::new(-1.0, -0.2, -0.1), 1),
            relief(DVec3::new(-0.1, -1.0, -0.2), 2),
        ],
    );
    scene.cuts.push(Cut::new(
        "plane",
        vec![ClipSurface::plane(DVec3::Z * 0.3, -DVec3::Z)],
    ));
    scene
}

#[test]
fn no_frame_has_a_crack() {
    let mut coarse = 0;
    for (scene, least) in [
        (smooth(), 150),
        (three(), 350),
        (cut_ball(noise([31, 17], 8), 0.7, 0.1, Wrap::Clamp), 150),
    ] {
        for camera in [
            scene.camera,
            scenes::orbit(-70.0, 5.0, false),
            scenes::orbit(120.0, 60.0, true),
        ] {
            let question = Question::through(&scene, &camera, [128, 96]);
            let exact = question.exact.layers.count(Kind::Cap);
            assert!(exact > least, "{}: {exact} cap pixels", scene.name);
            let boundary = question.boundary_px();
            // Of so many pixels on boundaries one may be wrong.
            for (tau, share) in [(0.5, 20), (2.0, 5), (20.0, 2)] {
                let judged = question.answer(strategy(&format!("adaptive:{tau}+mask")));
                let c = &judged.comparison;
                let name = format!("{}: tau {tau}", scene.name);
                assert_eq!(
                    [c.odd_parity_px, back_faces(&judged.layers)],
                    [0, 0],
                    "{name}"
                );
                let wrong = c.decided_wrong_px;
                assert!(wrong * share < boundary, "{name}: {wrong} of {boundary}");
                if tau < 1.0 {
                    assert_eq!(c.crack_px, 0, "{name}");
                } else {
                    coarse += usize::from(wrong * 20 > boundary);
                }
            }
        }
    }
    // The control: what is asked of half a pixel is more than coarser triangles give.
    assert!(coarse > 4, "{coarse} coarser frames are worse");
}

fn back_faces(layers: &Layers) -> usize {
    layers
        .pixels
        .iter()
        .filter(|l| l.kind == Kind::Surface && l.back_face)
        .count()
}

#[test]
fn every_inside_test_makes_the_same_of_the_list() {
    for scene in [smooth(), three()] {
        let question = Question::new(&scene, [128, 96]);
        let of = |inside: &str| {
            question
                .answer(strategy(&format!("adaptive:0.5+{inside}")))
                .layers
        };
        let mask = of("mask");
        for inside in ["stencil", "abuffer", "kbuffer:32"] {
            let other = of(inside);
            let wrong = mask.pixels.iter().zip(&other.pixels).filter(|(a, b)| {
                class_of(a) != class_of(b) || a.depth.to_bits() != b.depth.to_bits()
            });
            assert_eq!(wrong.count(), 0, "{}: {inside}", scene.name);
        }
    }
}

#[test]
fn the_papers_rule_draws_the_same_triangles() {
    let question = Question::new(&smooth(), [128, 96]);
    for inside in ["vds:256", "ldi:256"] {
        let judged = question.answer(strategy(&format!("adaptive:0.5+{inside}")));
        assert_eq!(judged.outcome, Outcome::Complete, "{inside}");
        let boundary = question.boundary_px();
        let wrong = judged.comparison.decided_wrong_px;
        assert!(
            wrong * 8 < boundary,
            "{inside}: {wrong} wrong, {boundary} on boundaries"
        );
        let caps = judged
            .layers
            .pixels
            .iter()
            .filter(|l| l.kind == Kind::Cap)
            .count();
        assert!(caps > 500, "{inside}: {caps} cap pixels");
    }
}

fn plan_of(scene: &Scene, name: &str) -> Plan {
    let model = Model::new(scene);
    let view = model.prepared.view([128, 96]);
    strategies::plan(&model, &view, strategy(name), &Capacities::UNKNOWN)
        .unwrap_or_else(|e| panic!("{e}"))
}

#[test]
fn planes_alone_are_not_tessellated() {
    let mut scene = smooth();
    scene.cuts = vec![Cut::new(
        "plane",
        vec![ClipSurface::plane(DVec3::ZERO, DVec3::Z)],
    )];
    assert_eq!(
        plan_of(&scene, "adaptive:0.5+mask"),
        plan_of(&scene, "raycast+mask"),
        "planes"
    );
    assert_ne!(
        plan_of(&smooth(), "adaptive:0.5+mask"),
        plan_of(&smooth(), "raycast+mask"),
        "the control"
    );
    // By the paper's rule a plane is two triangles, and there is nothing to measure.
    let paper = plan_of(&scene, "adaptive:0.5+vds:64");
    assert_eq!(
        paper.check(&Limits::CORE).map_err(|e| e.to_string()),
        Ok(()),
        "a good plan"
    );
    assert!(
        paper.resource_named("sheet_errors").is_none(),
        "nothing to measure"
    );
    let question = Question::new(&scene, [128, 96]);
    let (paper, exact) = (
        question.answer(strategy("adaptive:0.5+vds:256")),
        question.answer(strategy("raycast+mask")),
    );
    let differ = paper
        .layers
        .pixels
        .iter()
        .zip(&exact.layers.pixels)
        .filter(|(a, b)| class_of(a) != class_of(b));
    assert!(
        differ.count() * 8 < question.boundary_px(),
        "the plane's square"
    );
}

#[test]
fn a_camera_that_moves_measures_nothing() {
    let scene = smooth();
    let model = Model::new(&scene);
    let strategy = strategy("adaptive:0.7+mask");
    let mut session = session();
    let view = model.prepared.view([96, 64]);
    let first = session.draw(&model, &view, strategy).expect("a frame");
    assert!(
        first.ran_on(Clock::Cut).contains(&"errors 0 cells"),
        "{:?}",
        first.ran_on(Clock::Cut)
    );
    let other = model
        .prepared
        .view_of(&scenes::orbit(50.0, 10.0, false), [96, 64]);
    let second = session.draw(&model, &other, strategy).expect("a frame");
    assert_eq!(
        second.ran_on(Clock::Cut),
        Vec::<&str>::new(),
        "the camera moved"
    );
    // A relief of another height has another table of cuts, and is measured again.
    let mut higher = scene.clone();
    higher.cuts[0].surfaces[0].relief = Some(Arc::new(noise([40, 24], 2)));
    let third = session
        .draw(&model.updated(&higher), &other, strategy)
        .expect("a frame");
    assert!(
        third.ran_on(Clock::Cut).contains(&"errors 0 cells"),
        "another map"
    );
}

/// Passes that measure, of those that are due.
fn measured(after: &Plan, before: &Plan) -> Vec<String> {
    let due = after.due_after(before, |_| false).passes.into_iter();
    due.filter(|p| p.starts_with("errors")).collect()
}

#[test]
fn what_moves_beside_the_map_measures_nothing() {
    let name = "adaptive:0.5+mask";
    let before = plan_of(&three(), name);
    let after = |change: fn(&mut Scene)| {
        let mut scene = three();
        change(&mut scene);
        measured(&plan_of(&scene, name), &before)
    };
    assert!(measured(&before, &Plan::default()).len() > 4, "all of it");
    let plane = |scene: &mut Scene| scene.cuts[1].surfaces[0].origin.z += 0.1;
    assert_eq!(after(plane), [""; 0], "the plane of another cut");
    let lifted = |scene: &mut Scene| {
        let surface = &mut scene.cuts[0].surfaces[0];
        surface.origin += surface.u.cross(surface.v).normalize() * 0.02;
        surface.scale.z *= 1.5;
    };
    assert_eq!(after(lifted), [""; 0], "along its normal, and higher");
    // The controls: other texels, another map, and one that goes on otherwise.
    let aside = |scene: &mut Scene| {
        let surface = &mut scene.cuts[0].surfaces[0];
        surface.origin += surface.u.normalize() * 0.4;
    };
    assert_ne!(after(aside), [""; 0], "across its texels");
    let wrapped = |scene: &mut Scene| scene.cuts[0].surfaces[0].wrap = Wrap::Clamp;
    assert_ne!(after(wrapped), [""; 0], "goes on otherwise");
    let other = |scene: &mut Scene| {
        scene.cuts[0].surfaces[0].relief = Some(Arc::new(noise([20, 20], 9)));
    };
    assert_ne!(after(other), [""; 0], "another map");
}

#[test]
fn a_camera_that_enters_an_uncut_solid_measures_nothing() {
    // A ball that is cut, and beside it one that is not, which the near plane comes to open.
    let mut scene = smooth();
    let mut beside = scene.parts[0].clone();
    beside.name = "beside".to_owned();
    beside.world_from_part = glam::DAffine3::from_translation(DVec3::X * 3.0);
    scene.cuts[0].except = vec![beside.name.clone()];
    scene.parts.push(beside);
    let model = Model::new(&scene);
    let plan = |eye: DVec3, name: &str| {
        let camera = scenes::looking(eye, DVec3::ZERO, 60.0);
        let view = model.prepared.view_of(&camera, [128, 96]);
        let plan = strategies::plan(&model, &view, strategy(name), &Capacities::UNKNOWN);
        (plan.unwrap_or_else(|e| panic!("{e}")), camera)
    };
    for name in ["adaptive:0.5+mask", "grid:16+mask", "raycast+mask"] {
        let (outside, _) = plan(DVec3::new(7.0, 1.0, 0.0), name);
        let (within, camera) = plan(DVec3::new(3.0, 0.1, 0.0), name);
        assert_ne!(
            passes_of(&within, "resolve"),
            passes_of(&outside, "resolve"),
            "{name}: the near plane opens the ball"
        );
        assert_eq!(measured(&within, &outside), [""; 0], "{name}");
        for table in ["cut_table", "domains"] {
            let contents = |plan: &Plan| {
                let id = plan.resource_named(table);
                id.map(|id| plan.resource(id).contents.clone())
            };
            assert_eq!(contents(&within), contents(&outside), "{name}: {table}");
        }
        let question = Question::through(&scene, &camera, [128, 96]);
        let judged = question.answer(strategy(name));
        let wrong = judged.comparison.decided_wrong_px;
        assert!(
            wrong * 8 <= question.boundary_px(),
            "{name}: {wrong} of {}",
            question.boundary_px()
        );
    }
}

/// The constants of a pass.
fn passes_of(plan: &Plan, name: &str) -> Vec<(&'static str, f64)> {
    let pass = plan.passes.iter().find(|p| p.name == name);
    pass.expect("a pass").constants.clone()
}

#[test]
fn too_many_triangles_are_told_and_then_have_room() {
    let scene = cut_ball(noise([128, 128], 5), 0.9, 0.02, Wrap::Repeat);
    let model = Model::new(&scene);
    let view = model.prepared.view([160, 120]);
    let strategy = strategy("adaptive:0.02+mask");
    // The first try, by itself.
    let gpu = gpu();
    let options = DrawOptions {
        sub_pixel_bits: Some(hardware_precision().sub_pixel_bits),
        ..DrawOptions::by(Rasteriser::Hardware)
    };
    let method = Method::new(strategy, options);
    let plan = strategies::plan(&model, &view, method, &Capacities::UNKNOWN)
        .unwrap_or_else(|e| panic!("{e}"));
    let at = plan
        .bounded
        .iter()
        .position(|b| b.slot == NEED_OF_TRIANGLES)
        .expect("bounded triangles");
    let capacity = plan.bounded[at].capacity;
    let mut program = Program::default();
    program.load(&gpu, plan).expect("a plan");
    program.run(&gpu, ClockSet::ALL).expect("a run");
    let need = program.needs(&gpu).expect("needs")[at];
    assert!(
        need > capacity,
        "{need} triangles need no more than {capacity}"
    );
    let arguments = program.words(&gpu, "arguments").expect("arguments");
    assert_eq!(
        arguments[0],
        3 * capacity,
        "no more than there is room for is drawn"
    );

    let mut session = session();
    let outcome = session
        .draw(&model, &view, strategy)
        .expect("a frame")
        .outcome;
    let reason = outcome.reason().unwrap_or_default();
    assert!(!reason.contains("triangles"), "{reason}");
    assert_eq!(
        drawn(&session, &strategy, 0).len(),
        need as usize,
        "all of them"
    );
}

#[test]
fn a_relief_of_too_many_texels_is_refused_with_the_mend() {
    let refusal = |scale: f64| {
        let mut scene = smooth();
        scene.cuts[0].surfaces[0].scale.x = scale;
        let model = Model::new(&scene);
        let view = model.prepared.view_of(&Camera::default(), [64, 64]);
        strategies::plan(
            &model,
            &view,
            strategy("adaptive:1+mask"),
            &Capacities::UNKNOWN,
        )
        .map(|_| ())
    };
    assert_eq!(refusal(100.0), Ok(()), "some 4000 texels along a side");
    for scale in [1000.0, 1e-4] {
        let message = refusal(scale).expect_err("refused").to_string();
        assert!(
            message.contains("raycast") && message.contains("clip-surface 0"),
            "{message}"
        );
    }
}
