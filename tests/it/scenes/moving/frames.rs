//! Frames of parts that move, against the exact reference.

use std::sync::Arc;

use cutaway::Model;
use cutaway::layers::Kind;
use cutaway::scene::{ClipSurface, Part, Scene};
use cutaway::strategies::{DrawOptions, Method, Rasteriser, Strategy};
use cutaway_lab::{Comparison, compare};
use glam::{DAffine3, DVec2, DVec3};

use super::actors::{both, deformed_bar, deformers, morphing_ball, still, torn_bar};
use super::common::meshes::lumpy;
use super::common::{Judged, Question, class_of, scenes, session};

const SIZE_PX: [u32; 2] = [160, 120];
const RASTERISERS: [Rasteriser; 2] = [Rasteriser::Hardware, Rasteriser::Compute];

/// The exact strategy's answer by a rasteriser.
fn answer(question: &Question, rasteriser: Rasteriser) -> Judged {
    question.answer(Method::new(
        Strategy::RAYCAST_MASK,
        DrawOptions::by(rasteriser),
    ))
}

#[track_caller]
fn is_exact(question: &Question, what: &str) {
    for rasteriser in RASTERISERS {
        let judged = answer(question, rasteriser);
        let fault = judged.fault_of_exact();
        assert_eq!(fault, None, "{what}, {rasteriser}");
        assert!(
            judged.layers.count(Kind::Cap) > 100,
            "{what}: no cap to speak of"
        );
    }
}

/// A part and a torus, cut by a plane and by waves.
fn cut(name: &str, part: Part) -> Scene {
    let other = still("torus", DVec3::new(0.7, 0.3, 0.1));
    let mut scene = scenes::of_parts(name, vec![part, other], Vec::new());
    scene.camera = scenes::orbit(20.0, 15.0, false);
    let plane = ClipSurface::plane(DVec3::Z * 0.02, DVec3::new(0.1, 0.15, -1.0));
    let waves = scenes::relief(&scene, "-z=48%", "waves:amplitude=5%,period=30%");
    scene.cuts = vec![
        cutaway::Cut::new("plane", vec![plane]),
        cutaway::Cut::new("waves", vec![waves]),
    ];
    scene
}

/// Regression: the box of a skinned part is found without its vertices, and may reach before the near plane when the part does not.
#[test]
fn a_posed_part_behind_the_near_plane_is_not_met_by_it() {
    let plane = ClipSurface::plane(DVec3::Z * 0.02, DVec3::new(0.1, 0.15, -1.0));
    let mut scene = scenes::of_parts("torn", vec![torn_bar()], vec![plane]);
    scene.camera = scenes::orbit(20.0, 15.0, false);
    let fault = |scene: &Scene, strategy| {
        let judged = Question::new(scene, SIZE_PX).answer(strategy);
        judged.fault_of_exact()
    };
    let model = Model::new(&scene);
    let view = model.prepared.view(SIZE_PX);
    assert!(
        view.near_plane_meets(&model.prepared.parts[0].bounds),
        "the box that is found without vertices is in the way"
    );
    for strategy in [Strategy::STENCIL, Strategy::PLANAR] {
        assert_eq!(fault(&scene, strategy), None, "{strategy}");
    }
    // The control: one that it does meet.
    let mut near = scene.clone();
    near.camera.near = Some((view.near + 0.3) / model.prepared.scale);
    for strategy in [Strategy::STENCIL, Strategy::PLANAR] {
        let reason = fault(&near, strategy).unwrap_or_default();
        assert!(reason.contains("near plane meets `bar`"), "{reason}");
    }
}

#[test]
fn posed_parts_are_cut_exactly() {
    let mut actors: Vec<(String, Part)> = vec![
        ("both".to_owned(), both(65.0, 0.5)),
        ("ball".to_owned(), morphing_ball([0.7, 0.8])),
    ];
    for (name, list) in deformers() {
        actors.push((name.to_owned(), deformed_bar(list, Some(20.0))));
    }
    for (name, part) in actors {
        let mut scene = cut(&name, part);
        for orthographic in [false, true] {
            scene.camera = scenes::orbit(20.0, 15.0, orthographic);
            is_exact(&Question::new(&scene, SIZE_PX), &name);
        }
    }
}

#[test]
fn no_frame_of_an_animation_is_that_of_another_time() {
    let at = |degrees: f64| {
        let mut scene = cut("bar", both(degrees, degrees / 90.0));
        let whole = scene.bounds().union(cut("bar", both(90.0, 1.0)).bounds());
        scene.stage = Some(whole);
        scene
    };
    // Mesh and motion are shared from time to time, as a timeline does it.
    let first = at(0.0);
    let mut model = Model::new(&first);
    let mut before: Option<Question> = None;
    for step in 0..5 {
        let mut scene = at(22.0 * f64::from(step));
        scene.stage = first.stage;
        let pose = scene.parts[0].pose.clone();
        scene.parts = first.parts.clone();
        scene.parts[0].pose = pose;
        model = model.updated(&scene);
        let question = Question::of_model(model.clone(), &scene, SIZE_PX);
        is_exact(&question, &format!("step {step}"));
        if let Some(before) = &before {
            // The control: a frame of the pose before would be found.
            let stale = answer(before, Rasteriser::Hardware);
            let comparison = question.compare(&stale.layers);
            assert!(comparison.decided_wrong_px > 20, "step {step}");
        }
        before = Some(question);
    }
}

#[test]
fn meshes_of_another_topology_every_frame_leave_nothing_behind() {
    // Hard case 39. The numbers of triangles go up and down, so that rooms are kept, outgrown and kept again.
    let of = |step: u32| {
        let ball = lumpy([2, 3, 2, 4, 3, 1][step as usize % 6], 0.2, f64::from(step));
        let mut scene = cut("lumps", Part::new("lumps", ball));
        scene.stage = Some(cutaway::scene::Bounds {
            min: DVec3::splat(-1.0),
            max: DVec3::splat(1.0),
        });
        scene
    };
    let still = of(0).parts[1].clone();
    let mut model: Option<Model> = None;
    let mut before: Option<Question> = None;
    for step in 0..8 {
        let mut scene = of(step);
        scene.parts[1] = still.clone();
        let next = model
            .as_ref()
            .map_or_else(|| Model::new(&scene), |m| m.updated(&scene));
        let question = Question::of_model(next.clone(), &scene, SIZE_PX);
        is_exact(&question, &format!("step {step}"));
        // Once more: nothing is drawn into what the first draw left.
        is_exact(&question, &format!("step {step}, again"));
        if let Some(before) = &before {
            let stale = answer(before, Rasteriser::Compute);
            let comparison = question.compare(&stale.layers);
            assert!(comparison.decided_wrong_px > 20, "step {step}: the control");
        }
        (model, before) = (Some(next), Some(question));
    }
}

#[test]
fn a_part_that_comes_and_goes_with_a_cut_is_where_it_belongs() {
    // A part that a cut removes altogether is not posed; when it is back, it stands as it does then.
    let mut scene = cut("bar", both(50.0, 0.4));
    scene.stage = Some(scene.bounds());
    let usual = scene.cuts[0].surfaces[0].origin;
    let mut model = Model::new(&scene);
    for (step, (removed, degrees)) in [(false, 50.0), (true, 20.0), (false, 20.0)]
        .into_iter()
        .enumerate()
    {
        super::actors::bend(&mut scene.parts[0], degrees);
        scene.cuts[0].surfaces[0].origin = usual - DVec3::Z * if removed { 20.0 } else { 0.0 };
        model = model.updated(&scene);
        let question = Question::of_model(model.clone(), &scene, SIZE_PX);
        for rasteriser in RASTERISERS {
            let judged = answer(&question, rasteriser);
            assert_eq!(judged.fault_of_exact(), None, "step {step}");
            let caps = judged.layers.count(Kind::Cap);
            assert_eq!(caps > 100, !removed, "step {step}: {caps} px of cap");
        }
    }
}

#[test]
fn a_camera_that_drifts_flips_what_the_exact_camera_flips() {
    // Hard case 40: a sixty-fourth of a pixel per frame, at an angle; every flip of a decided pixel is one of the reference.
    let scene = cut("bar", both(40.0, 0.6));
    let model = Model::new(&scene);
    let truth = model.truth(&scene);
    let whole = model.prepared.view([64, 64]);
    let mut before: Option<(cutaway::Layers, cutaway_lab::Exact)> = None;
    let (mut flips, mut planted) = (0, 0);
    for frame in 0..64 {
        let drift = DVec2::new(1.0, 0.37) * f64::from(frame) / 64.0;
        let view = whole.sampled_at(DVec2::splat(0.5) + drift);
        let exact = cutaway_lab::exact::evaluate(&truth, &view);
        let layers = {
            let mut session = session();
            let drawn = session.draw(&model, &view, Strategy::RAYCAST_MASK);
            let drawn = drawn.unwrap_or_else(|e| panic!("{e}"));
            assert_eq!(drawn.outcome.reason(), None, "frame {frame}");
            session.layers(Strategy::RAYCAST_MASK).expect("layers")
        };
        if let Some((layers_before, exact_before)) = &before {
            for p in 0..64 * 64 {
                if exact.undecided[p] || exact_before.undecided[p] {
                    continue;
                }
                let flip = |a: &cutaway::Layers, b: &cutaway::Layers| {
                    class_of(&a.pixels[p]) != class_of(&b.pixels[p])
                };
                let of_exact = flip(&exact_before.layers, &exact.layers);
                let found = flip(layers_before, &layers);
                assert_eq!(found, of_exact, "frame {frame}, pixel {p}");
                flips += usize::from(of_exact);
                // The control: a frame that lags by one shows other flips.
                planted += usize::from(flip(layers_before, layers_before) != of_exact);
            }
        }
        before = Some((layers, exact));
    }
    assert!(flips > 30, "only {flips} pixels changed at all");
    assert_eq!(planted, flips, "the control");
}

#[test]
fn both_ways_to_the_truth_are_one() {
    // What `Scene::posed` bakes and what `Prepared::new` poses by itself.
    let mut scene = cut("bar", both(30.0, 0.2));
    scene.parts[0].world_from_part = DAffine3::from_rotation_y(0.4);
    let question = Question::new(&scene, SIZE_PX);
    let posed = Arc::new(Question::new(&scene.posed(), SIZE_PX));
    let none = Comparison {
        depth_error_max: 0.0,
        ..compare(
            &question.exact,
            &posed.exact.layers,
            &question.view,
            question.model.prepared.scale,
        )
    };
    assert_eq!(none.decided_wrong_px, 0, "{none:?}");
    let fault = posed.answer(Strategy::RAYCAST_MASK).fault_of_exact();
    assert_eq!(fault, None, "the baked mesh");
}
