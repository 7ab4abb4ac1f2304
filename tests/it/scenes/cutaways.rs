//! Promise: openings place themselves so that what is inside is seen from wherever one looks, parts that are whole are never cut and never
//! float, and all of it is cut as exactly as by any other clip-surface.

mod agree;
mod axes;
mod files;
mod see_through;
mod whole;

use crate::common::{self, Question, command, meshes, real, scenes};

use cutaway::layers::{Kind, Layers};
use cutaway::scene::{Bounds, Breakaway, Camera, Cut, Part, Role, Scene, Viewpoint};
use glam::{DAffine3, DVec3};

fn placed(name: &str, shape: &str, scale: DVec3, at: DVec3) -> Part {
    let mut part = Part::new(name, meshes::shape(shape));
    part.world_from_part =
        DAffine3::from_scale_rotation_translation(scale, glam::DQuat::IDENTITY, at);
    part
}

fn interior(part: Part) -> Part {
    Part {
        role: Role::Interior,
        ..part
    }
}

/// A scene of parts with a breakaway, and room around for cameras.
fn broken_open(name: &str, parts: Vec<Part>, breakaway: Breakaway) -> Scene {
    let mut scene = scenes::of_parts(name, parts, Vec::new());
    scene.stage = Some(scene.bounds());
    scene.cuts = vec![Cut {
        breakaway: Some(breakaway),
        ..Cut::new("opening", Vec::new())
    }];
    scene
}

/// Scenes with something inside: one ball, two far from each other, a bar, nested balls, and half a dozen.
fn boxes_with_something_inside() -> Vec<Scene> {
    let ball = |name: &str, size: f64, at: DVec3| {
        interior(placed(
            name,
            "sphere?subdivisions=3",
            DVec3::splat(size),
            at,
        ))
    };
    let cube = placed(
        "box",
        "cube?divisions=3",
        DVec3::new(2.0, 1.4, 1.2),
        DVec3::ZERO,
    );
    let shell = placed(
        "shell",
        "sphere?subdivisions=4",
        DVec3::splat(2.0),
        DVec3::ZERO,
    );
    let bar = interior(placed(
        "bar",
        "cube",
        DVec3::new(1.4, 0.15, 0.2),
        DVec3::splat(0.1),
    ));
    let six = (0..6).map(|i| {
        let turn = f64::from(i) * std::f64::consts::FRAC_PI_3;
        ball(
            &format!("ball {i}"),
            0.25,
            DVec3::new(turn.cos(), turn.sin(), 0.0) * 0.5,
        )
    });
    let all = [
        (
            "one",
            vec![cube.clone(), ball("ball", 0.5, DVec3::splat(0.1))],
        ),
        (
            "two",
            vec![
                cube.clone(),
                ball("left", 0.3, DVec3::X * -0.6),
                ball("right", 0.3, DVec3::X * 0.6),
            ],
        ),
        ("bar", vec![shell.clone(), bar]),
        (
            "nested",
            vec![
                shell.clone(),
                placed(
                    "inner",
                    "sphere?subdivisions=3",
                    DVec3::splat(1.5),
                    DVec3::ZERO,
                ),
                ball("core", 0.4, DVec3::ZERO),
            ],
        ),
        ("six", std::iter::once(shell).chain(six).collect()),
    ];
    let scenes = all.into_iter();
    scenes
        .map(|(name, parts)| broken_open(name, parts, Breakaway::default()))
        .collect()
}

/// Cameras all around a box, at a distance in its radii.
fn cameras_around(bounds: &Bounds, count: u32, radii: f64) -> impl Iterator<Item = Camera> {
    let (centre, distance) = (bounds.centre(), bounds.radius() * radii);
    (0..count).map(move |i| {
        let z = 1.0 - 2.0 * (f64::from(i) + 0.5) / f64::from(count);
        let flat = glam::DVec2::from_angle(2.399_963 * f64::from(i)) * (1.0 - z * z).sqrt();
        Camera {
            viewpoint: Viewpoint::Explicit {
                position: centre + flat.extend(z) * distance,
                focal_point: centre,
                view_up: Some(flat.extend(z).any_orthonormal_vector()),
            },
            ..Camera::default()
        }
    })
}

/// A scene with its openings as its camera sees it, asked of exact.
fn opened(scene: &Scene, size_px: [u32; 2]) -> (Scene, Question) {
    let mut open = scene.clone();
    open.open_breakaways(size_px).expect("openings");
    let question = Question::new(&open, size_px);
    (open, question)
}
