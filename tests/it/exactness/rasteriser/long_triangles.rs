//! Regression 34.1: thousands of long triangles in large pictures. Drivers end loops after so many rounds of an invocation (llvmpipe after
//! 65,535), so an invocation that takes its share of all long triangles draws half of them, and says nothing.
//!
//! Every part is closed, so any odd total is a sample that was lost.

use cutaway::Model;
use cutaway::plan::Plan;
use cutaway::scene::{Camera, ClipSurface, Cut, Cutter, Mesh, Precision, Scene};
use cutaway::strategies::Method;
use cutaway_io::document::section;
use cutaway_lab::hard_cases::meshes::prisms;
use cutaway_lab::hard_cases::{Judged, Question};
use glam::DVec3;

use super::ways::{as_recorded, frame};
use crate::common::{meshes, scenes, session};

/// Cut by one plane, or by two, for which a pass before the sweeps finds the touched tiles.
fn cut(mesh: Mesh, planes: usize) -> Scene {
    let normals = [DVec3::new(0.1, 0.2, -1.0), DVec3::new(-1.0, 0.3, 0.1)];
    let planes = normals[..planes]
        .iter()
        .map(|n| ClipSurface::plane(DVec3::Z * 0.05, n.normalize()));
    scenes::scene("prisms", mesh, planes.collect())
}

/// Counts the pieces of the first 2048 queued triangles alone.
fn too_few_pieces(plan: &mut Plan) {
    for pass in plan.passes.iter_mut().filter(|p| p.name == "pieces scan") {
        for (name, value) in &mut pass.constants {
            if *name == "length" {
                *value = 1.0;
            }
        }
    }
}

#[test]
fn every_sample_of_long_triangles_is_there_at_every_size() {
    let tubes = cut(prisms(64, 24), 1);
    let fins = cut(prisms(900, 3), 2);
    for (scene, size) in [
        (&tubes, [800, 300]),
        (&tubes, [2400, 1800]),
        (&fins, [1600, 1200]),
    ] {
        let model = Model::new(scene);
        let view = model.prepared.view_of(&Camera::default(), size);
        let drawn = frame(&model, &view, false, as_recorded);
        assert_eq!(drawn.odd_words(), 0, "{} at {size:?}", scene.name);
        if size == [800, 300] {
            let lost = frame(&model, &view, false, too_few_pieces);
            assert!(lost.odd_words() > 0, "a lost piece is not noticed");
        }
    }
}

/// A frame by the adapter's rasteriser whose depths the band of its sub-pixel bits decides wrong, and the band of slopes in f32 does not.
fn undecided_by_slopes(scene: &Scene) -> (Question, Judged) {
    let model = Model::new(scene);
    let camera = scenes::orbit(215.0, 25.0, false);
    let view = model.prepared.view_of(&camera, [2400, 1800]);
    let question = Question::of_model(model, scene, view);
    let drawn = answer(&question, "raycast+mask@hardware");
    assert_eq!(drawn.comparison.decided_wrong_px, 0, "{}", scene.name);
    assert!(
        question.compare(&drawn.layers).decided_wrong_px > 0,
        "the usual band is wide enough: nothing was tried"
    );
    (question, drawn)
}

fn answer(question: &Question, method: &str) -> Judged {
    let method: Method = method.parse().expect("a strategy");
    question.answer(&mut session(), &method).expect("a frame")
}

/// Regression: llvmpipe interpolates depths by slopes in f32, and so moved the edges of caps by more than the band of doubt of its
/// sub-pixel bits, along walls that are a thousand times as long as they are wide.
#[test]
fn where_slopes_of_depth_are_rounded_nothing_is_decided() {
    let mut scene = cut(prisms(900, 24), 0);
    let plane = section("z=52%").on(&scene.bounds()).expect("a section");
    scene.cuts = vec![Cut::new("along the tubes", vec![plane])];
    let (question, drawn) = undecided_by_slopes(&scene);
    let computed = answer(&question, "raycast+mask@compute");
    assert_eq!(computed.fault_of_exact(), None);
    let usual = question.exact.at(Precision::USUAL);
    assert!(
        usual.undecided == computed.exact.undecided,
        "what the compute rasteriser draws is judged by the usual band"
    );
    assert!(
        usual.layers == drawn.exact.layers,
        "rounding changes no layer"
    );
}

/// Regression 0020: the walls of a cutter are rasterised as the faces of parts are.
#[test]
fn where_the_walls_of_a_cutter_are_rounded_nothing_is_decided() {
    let mut scene = scenes::scene("ball", meshes::shape("sphere?subdivisions=4"), Vec::new());
    let tubes = Cutter::new("tubes", prisms(9, 240)).expect("closed tubes");
    scene.cuts = vec![Cut::by(tubes)];
    undecided_by_slopes(&scene);
}
