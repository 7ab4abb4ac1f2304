//! Cases 10 to 15: what eyes in awkward places ask beyond their outcome.

use cutaway::layers::{Kind, NEAR_PLANE};
use cutaway::scene::{Camera, Scene};
use cutaway::strategies::Strategy;
use glam::{DAffine3, DVec3};

use crate::common::{Question, class_of, scenes, strategy};

#[test]
fn case_10_inside_the_kept_side_the_near_cap_fills_the_picture() {
    let mut scene = scenes::sectioned("cube", &["-z=0.3"]);
    scene.camera = Camera {
        near: Some(0.02),
        ..scenes::looking(DVec3::new(0.1, 0.05, -0.2), DVec3::Z, 50.0)
    };
    let judged = Question::new(&scene, [64; 2]).answer(Strategy::RAYCAST_MASK);
    let near = judged.layers.pixels.iter();
    let caps = near.filter(|p| p.kind == Kind::Cap && p.clip_surface == NEAR_PLANE);
    assert_eq!(
        caps.count(),
        64 * 64,
        "the near plane is within the solid everywhere"
    );
}

#[test]
fn case_11_from_a_void_the_wall_is_seen_and_no_cap() {
    let mut scene = scenes::sectioned("shells?subdivisions=3", &["-x=0.2"]);
    scene.camera = Camera {
        near: Some(0.01),
        ..scenes::looking(DVec3::new(0.02, 0.01, 0.03), -DVec3::X, 70.0)
    };
    let judged = Question::new(&scene, [64; 2]).answer(Strategy::RAYCAST_MASK);
    assert_eq!(
        judged.layers.count(Kind::Surface),
        64 * 64,
        "the wall is all around"
    );
}

/// A scene moved and scaled, with its clip-surfaces.
fn placed(scene: &Scene, scale: f64, offset: DVec3) -> Scene {
    let mut placed = scene.clone();
    let map = DAffine3::from_translation(offset) * DAffine3::from_scale(DVec3::splat(scale));
    for part in &mut placed.parts {
        part.world_from_part = map * part.world_from_part;
    }
    for surface in placed.cuts.iter_mut().flat_map(|c| &mut c.surfaces) {
        surface.origin = map.transform_point3(surface.origin);
        surface.u *= scale;
        surface.v *= scale;
        surface.scale.z *= scale;
    }
    placed
}

#[test]
fn case_14_far_tiny_and_huge_scenes_look_the_same() {
    let scene = scenes::torus_cut();
    for px in [64, 256] {
        let home = Question::new(&scene, [px; 2]);
        let here = home.answer(Strategy::RAYCAST_MASK);
        for (scale, offset) in [
            (1.0, 1e6),
            (1e-6, 0.0),
            (1e6, 0.0),
            (1e-6, 1e-6),
            (1e6, 1e9),
        ] {
            let placed = placed(&scene, scale, DVec3::splat(offset));
            let away = Question::new(&placed, [px; 2]);
            let there = away.answer(Strategy::RAYCAST_MASK);
            let differing = (0..here.layers.pixels.len())
                .filter(|i| {
                    let undecided = home.exact.undecided[*i] || away.exact.undecided[*i];
                    !undecided
                        && class_of(&here.layers.pixels[*i]) != class_of(&there.layers.pixels[*i])
                })
                .count();
            assert_eq!(differing, 0, "scale {scale}, offset {offset}, {px} px");
        }
    }
}

/// How far a depth moves when its value in a buffer of f32 moves by half an ulp.
fn resolution(buffer: f64, depth_from_buffer: impl Fn(f64) -> f64) -> f64 {
    let stored = buffer as f32;
    let next = f32::from_bits(stored.to_bits() + 1);
    0.5 * (depth_from_buffer(f64::from(next)) - depth_from_buffer(f64::from(stored))).abs()
}

#[test]
fn case_15_reversed_depth_keeps_its_precision_at_every_distance() {
    let scene = &scenes::of_case("15-near-and-far", 64)[0];
    let question = Question::new(scene, [64; 2]);
    let view = &question.view;
    let ratio = view.far / view.near;
    assert!(ratio > 1e5, "far is only {ratio} times near");
    // The standard buffer with the far plane just behind the scene, for comparison: z = f / (f - n) (1 - n / w).
    let (n, f) = (view.near, view.far);
    for share in [1.5, 10.0, 1e3, 9e4] {
        let depth = n * share;
        let reversed = resolution(view.buffer_from_depth(depth), |z| view.depth_from_buffer(z));
        let standard = resolution(f / (f - n) * (1.0 - n / depth), |z| {
            n / (1.0 - z * (f - n) / f)
        });
        // Half an ulp is between 2^-25 and 2^-24 of the value.
        let predicted = depth * 2.0_f64.powi(-24);
        assert!(
            reversed <= predicted * 1.01,
            "{reversed} at {depth}, predicted {predicted}"
        );
        let predicted = depth * depth / n * 2.0_f64.powi(-26);
        assert!(
            share < 2.1 || standard >= predicted,
            "{standard} at {depth}, predicted {predicted}"
        );
    }
    let judged = question.answer(Strategy::RAYCAST_MASK);
    let depths: Vec<f64> = judged.layers.pixels.iter().map(|p| p.depth / n).collect();
    assert!(
        depths.iter().any(|d| *d < 50.0),
        "the bolt is in the picture"
    );
    assert!(
        depths.iter().any(|d| d.is_finite() && *d > 5e4),
        "the tower is in the picture"
    );
}

#[test]
fn case_12_without_the_near_cap_the_ray_shows_what_it_enters_next_and_no_pixel_is_odd() {
    let mut scene = scenes::sectioned("cube", &["-x=0.25"]);
    scene.camera = Camera {
        near: Some(1.6),
        near_cap: false,
        ..scenes::looking(DVec3::new(0.3, 0.4, 2.0), DVec3::ZERO, 40.0)
    };
    let question = Question::new(&scene, [64; 2]);
    for name in ["raycast+mask", "grid:256+vds:512"] {
        let judged = question.answer(strategy(name));
        assert_eq!(
            judged.comparison.odd_parity_px, 0,
            "{name}: the mesh is closed"
        );
        assert_eq!(
            judged.comparison.crack_px, 0,
            "{name}: what exact sees is covered"
        );
        let back = judged.layers.pixels.iter().filter(|p| p.back_face).count();
        assert_eq!(back, 0, "{name}: the wall by which the ray leaves");
        assert_eq!(judged.comparison.decided_wrong_px, 0, "{name}");
    }
}
