//! No point of a tessellation is seen farther than TAU pixels from where the relief is: on the triangles, and in the frames.

use cutaway::layers::Kind;
use cutaway::passes::{ActiveCuts, Model};
use cutaway::scene::{Camera, Cut, Scene, View, Wrap};
use cutaway::session::{Outcome, Session};
use cutaway::strategies::Strategy;
use glam::{DVec2, DVec3};

use super::common::{Question, meshes, scenes, session, strategy};
use super::refined::{Sheet, Triangle, drawn, is_seen};
use super::{cut_ball, noise};

fn cameras() -> Vec<Camera> {
    vec![
        Camera::default(),
        // Along the cut, close to it.
        scenes::looking(DVec3::new(1.4, 0.0, -0.1), DVec3::new(0.0, 0.05, 0.0), 35.0),
        scenes::looking(DVec3::new(0.3, 0.5, 0.7), DVec3::new(0.0, 0.0, 0.1), 70.0),
        scenes::parallel(DVec3::new(1.0, 1.0, 2.0), DVec3::ZERO, 1.3),
    ]
}

fn ball() -> Scene {
    cut_ball(noise([48, 64], 9), 0.9, 0.12, Wrap::Repeat)
}

/// The greatest distance, in pixels, between a point of a triangle and the point of the relief over the same point of the plane.
fn farthest_px(sheet: &Sheet, model: &Model, view: &View, triangles: &[Triangle]) -> f64 {
    let surface = &model.prepared.surfaces[0];
    let cut_box = ActiveCuts::new(&model.prepared, view)
        .expect("a plain scene")
        .cut_box;
    let mut farthest: f64 = 0.0;
    for t in triangles {
        let corners = t.map(|v| DVec2::from(v.map(f64::from)));
        let heights = corners.map(|at| sheet.height(surface, at));
        for (i, j) in [
            (0, 2),
            (2, 0),
            (2, 2),
            (1, 1),
            (1, 2),
            (2, 1),
            (0, 0),
            (3, 1),
            (1, 3),
            (0, 1),
        ] {
            let weights = [f64::from(4 - i - j), f64::from(i), f64::from(j)].map(|w| w / 4.0);
            let at = corners[0] * weights[0] + corners[1] * weights[1] + corners[2] * weights[2];
            let flat = heights[0] * weights[0] + heights[1] * weights[1] + heights[2] * weights[2];
            let right = sheet.point(surface, at, sheet.height(surface, at));
            if is_seen(view, &cut_box, right) {
                let off = sheet.point(surface, at, flat);
                farthest = farthest.max((view.project(off).0 - view.project(right).0).length());
            }
        }
    }
    farthest
}

fn draw(
    session: &mut Session,
    model: &Model,
    view: &View,
    strategy: &Strategy,
) -> (Sheet, Vec<Triangle>) {
    let _ = session
        .draw(model, view, strategy)
        .expect("a frame")
        .outcome;
    (Sheet::of(session, strategy, 0), drawn(session, strategy, 0))
}

#[test]
fn triangles_stay_within_tau_of_the_relief() {
    let scene = ball();
    let model = Model::new(&scene);
    for camera in cameras() {
        let view = model.prepared.view_of(&camera, [320, 240]);
        let mut counts = Vec::new();
        for tau in [0.5, 1.0, 4.0] {
            let strategy = strategy(&format!("adaptive:{tau}+mask"));
            let (sheet, triangles) = draw(&mut session(), &model, &view, &strategy);
            let farthest = farthest_px(&sheet, &model, &view, &triangles);
            // Rounding of f32 is a ten thousandth of a pixel here.
            assert!(farthest <= tau + 1e-3, "{camera:?}: {farthest} px of {tau}");
            // What is drawn for no use would show here.
            assert!(
                farthest > 0.2 * tau,
                "{camera:?}: {farthest} px of {tau}: finer than asked for"
            );
            counts.push(triangles.len());
        }
        assert!(
            counts.is_sorted_by(|a, b| a > b),
            "{camera:?}: {counts:?} triangles"
        );
    }
}

#[test]
fn a_bound_that_is_too_wide_is_noticed() {
    let model = Model::new(&ball());
    let view = model.prepared.view([320, 240]);
    let (mut sheet, _) = draw(&mut session(), &model, &view, &strategy("adaptive:1+mask"));
    sheet.refinement.error_per_depth *= 4.0;
    let planted: Vec<Triangle> = sheet.triangles().into_iter().collect();
    let farthest = farthest_px(&sheet, &model, &view, &planted);
    assert!(farthest > 1.2, "{farthest} px");
}

/// The greatest distance of a cap's pixel from the relief, in pixels of the picture: along the normal of the plane, as it was moved.
fn cap_error_px(question: &Question, strategy: &Strategy) -> (f64, usize) {
    let judged = question.answer(strategy);
    let (model, view) = (&question.model, &question.view);
    let surface = &model.prepared.surfaces[0];
    let map = surface.relief.as_ref().expect("a relief");
    let (mut farthest, mut caps): (f64, usize) = (0.0, 0);
    for (i, layer) in judged.layers.pixels.iter().enumerate() {
        if layer.kind != Kind::Cap {
            continue;
        }
        let (x, y) = (i as u32 % view.size_px[0], i as u32 / view.size_px[0]);
        let (origin, ray) = view.ray(DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5));
        let point = origin + ray * layer.depth;
        let from = point - surface.origin;
        let at = DVec2::new(
            from.dot(surface.frame.u_hat) * surface.map_per_unit[0],
            from.dot(surface.frame.v_hat) * surface.map_per_unit[1],
        );
        let off =
            from.dot(surface.frame.normal) + map.sample(surface.wrap, at).0 * surface.height_scale;
        let right = point - surface.frame.normal * off;
        farthest = farthest.max((view.project(right).0 - view.project(point).0).length());
        caps += 1;
    }
    (farthest, caps)
}

#[test]
fn caps_in_frames_stay_within_tau_of_the_relief() {
    let scene = ball();
    for camera in cameras() {
        let question = Question::through(&scene, &camera, [160, 120]);
        for tau in [0.5, 1.0, 4.0] {
            let (farthest, caps) =
                cap_error_px(&question, &strategy(&format!("adaptive:{tau}+mask")));
            assert!(caps > 500, "{camera:?}: {caps} cap pixels");
            assert!(farthest <= tau + 1e-2, "{camera:?}: {farthest} px of {tau}");
        }
    }
    // The control: a grid that knows nothing of the view.
    let question = Question::new(&scene, [160, 120]);
    let (farthest, _) = cap_error_px(&question, &strategy("grid:16+mask"));
    assert!(farthest > 1.0, "the control: {farthest} px");
}

#[test]
fn the_crank_of_the_demo_takes_fewer_triangles_than_a_grid() {
    // As `cutaway demo` cuts it.
    let mut scene = scenes::of_parts("crank", meshes::parts("crank"), Vec::new());
    let surfaces = [
        ("-z=50%", "fractal:amplitude=4%,period=45%,seed=7"),
        ("x=60%", "fractal:amplitude=5%,period=30%,seed=4"),
    ]
    .map(|(section, relief)| scenes::relief(&scene, section, relief));
    scene.cuts = vec![Cut::new("cut", surfaces.to_vec())];
    let model = Model::new(&scene);
    let view = model.prepared.view([1024, 768]);
    let strategy = strategy("adaptive:0.5+mask");
    let mut session = session();
    let outcome = session
        .draw(&model, &view, strategy)
        .expect("a frame")
        .outcome;
    assert_eq!(outcome, Outcome::Complete, "the paper's view");
    let counts = [0, 1].map(|slot| drawn(&session, &strategy, slot).len());
    eprintln!("the crank of the demo takes {counts:?} triangles");
    assert!(counts.iter().sum::<usize>() < 2 * 256 * 256, "{counts:?}");
    assert!(counts.iter().all(|n| *n > 1000), "{counts:?}");
}
