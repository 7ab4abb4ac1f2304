//! Faults planted in a scene: what the mask marks is there to be marked.

use cutaway::scene::Scene;
use cutaway::strategies::Strategy;

use crate::common::{Question, meshes, scenes};

fn open(scene: &Scene, triangle: usize) -> Scene {
    let mut open = scene.clone();
    open.parts[0].mesh = meshes::without(&scene.parts[0].mesh, triangle).into();
    open
}

#[test]
fn a_missing_triangle_is_odd() {
    let scene = scenes::sectioned("sphere?subdivisions=1", &["-z=0.1"]);
    let whole = Question::new(&scene, [96; 2]).answer(Strategy::RAYCAST_MASK);
    assert_eq!(
        whole.comparison.odd_parity_px, 0,
        "the whole ball is closed"
    );
    let mut seen = 0;
    for triangle in 0..scene.parts[0].mesh.triangles.len() {
        let judged = Question::new(&open(&scene, triangle), [96; 2]).answer(Strategy::RAYCAST_MASK);
        let odd = judged.exact.odd_parity.iter().filter(|o| **o).count();
        seen += odd;
        let marked = judged.comparison.odd_parity_px;
        assert_eq!(
            marked > 0,
            odd > 0,
            "triangle {triangle}: {odd} odd, {marked} marked"
        );
    }
    assert!(seen > 1000, "only {seen} odd pixels in all");
}

#[test]
fn a_moved_surface_is_another_picture() {
    let right = Question::new(&scenes::sectioned("cube", &["-z=0.1"]), [96; 2]);
    let moved = Question::new(&scenes::sectioned("cube", &["-z=0.13"]), [96; 2]);
    let judged = moved.answer(Strategy::RAYCAST_MASK);
    assert!(
        right.compare(&judged.layers).decided_wrong_px > 50,
        "a surface 0.03 beside"
    );
}
