//! Cases 1, 2 and 22: what planes ask beyond their outcome.

use cutaway::layers::Kind;
use cutaway::scene::{Camera, ClipSurface, Scene};
use cutaway::strategies::Strategy;
use glam::DVec3;

use crate::common::{Question, class_of, meshes, scenes, strategy};

fn cube_cut_at(z: f64, sign: f64, camera: Camera) -> Scene {
    let plane = ClipSurface::plane(DVec3::new(0.0, 0.0, z), DVec3::Z * sign);
    let mut scene = scenes::scene("cube", meshes::shape("cube"), vec![plane]);
    scene.camera = camera;
    scene
}

#[test]
fn case_01_the_cap_is_the_unit_square_to_the_pixel() {
    for px in [64, 256] {
        // Two units of picture: the square takes half the side, and its edges lie between samples.
        let camera = scenes::parallel(DVec3::Z * 3.0, DVec3::ZERO, 2.0);
        let question = Question::new(&cube_cut_at(0.0, -1.0, camera), [px; 2]);
        for name in ["raycast+mask", "grid:256+vds:512"] {
            let judged = question.answer(strategy(name));
            assert_eq!(
                judged.layers.count(Kind::Cap),
                (px * px / 4) as usize,
                "{name} at {px}"
            );
            assert_eq!(judged.comparison.wrong_px(), 0, "{name} at {px}");
        }
        assert_eq!(
            question.exact.undecided_px(),
            0,
            "no edge is near a sample at {px}"
        );
    }
}

/// The next f32 after one, in a direction: one ulp.
fn next(z: f32, steps: i32) -> f32 {
    f32::from_bits(z.to_bits().wrapping_add_signed(steps))
}

#[test]
fn case_02_a_face_in_the_plane_flips_only_as_a_whole() {
    for (z, sign, back) in [
        (0.5_f32, 1.0, 1.0),
        (0.5, -1.0, 1.0),
        (-0.5, 1.0, -1.0),
        (-0.5, -1.0, -1.0),
    ] {
        for ulps in [-1, 0, 1] {
            for from in [DVec3::new(0.6, 0.5, 2.0), DVec3::new(0.6, 0.5, -2.0)] {
                let camera = scenes::looking(from, DVec3::ZERO, 40.0);
                let scene = cube_cut_at(f64::from(next(z, ulps)), sign, camera);
                let question = Question::new(&scene, [128; 2]);
                let judged = question.answer(Strategy::RAYCAST_MASK);
                assert_eq!(
                    judged.fault_of_exact(),
                    None,
                    "plane at {z} {ulps:+} ulp, side {sign}"
                );
                // Samples well inside the face, by its own corners.
                let inner = face_pixels(&question, back * 0.5);
                assert!(inner.len() > 1000, "the face has {} pixels", inner.len());
                let classes: Vec<_> = inner
                    .iter()
                    .map(|i| class_of(&judged.layers.pixels[*i]))
                    .collect();
                let strange = classes.iter().filter(|c| **c != classes[0]).count();
                assert_eq!(
                    strange, 0,
                    "speckle: plane at {z} {ulps:+} ulp, side {sign}, from {from}"
                );
            }
        }
    }
}

/// Pixels whose ray passes the square of the cube's face at `z`, a hundredth of a unit inside its edges.
fn face_pixels(question: &Question, z: f64) -> Vec<usize> {
    let prepared = &question.model.prepared;
    let [width, height] = question.view.size_px;
    (0..width * height)
        .filter(|p| {
            let at = glam::DVec2::new(f64::from(p % width) + 0.5, f64::from(p / width) + 0.5);
            let (origin, direction) = question.view.ray(at);
            let plane = (z - prepared.centre_in_world.z) * prepared.scale;
            let depth = (plane - origin.z) / direction.z;
            let point = (origin + direction * depth) / prepared.scale + prepared.centre_in_world;
            point.x.abs() < 0.49 && point.y.abs() < 0.49
        })
        .map(|p| p as usize)
        .collect()
}

#[test]
fn case_22_a_flat_map_is_the_plane_bit_for_bit() {
    for px in [64, 256] {
        for scene in scenes::of_case("22-flat-map", px) {
            let mut plane = scene.clone();
            let surface = &mut plane.cuts[0].surfaces[0];
            let height = surface
                .relief
                .take()
                .map_or(0.0, |map| f64::from(map.texels()[0]));
            surface.origin -= surface.frame().normal * height * surface.scale.z;
            for name in ["raycast+mask", "grid:64+vds:256"] {
                let strategy = strategy(name);
                let mapped = Question::new(&scene, [px; 2]).answer(strategy).layers;
                let planar = Question::new(&plane, [px; 2]).answer(strategy).layers;
                // Moving the origin rounds it: depths may differ in the last place, decisions may not.
                let differing = mapped
                    .pixels
                    .iter()
                    .zip(&planar.pixels)
                    .filter(|(a, b)| class_of(a) != class_of(b) || (height == 0.0 && a != b))
                    .count();
                assert!(
                    differing <= usize::from(height != 0.0) * 2,
                    "{} by {name} at {px}: {differing}",
                    scene.name
                );
            }
        }
    }
}
