//! Promise: faces that coincide (a fin, a shell without thickness, shells on each other) are drawn by the one that faces the eye, by every
//! exact strategy and both rasterisers, wherever the lists of their corners begin (hard cases 52 and 54).

use crate::common;

use common::meshes::{joined, shape, turned};
use common::scenes::{orbit, scene};
use common::{Judged, Question};
use cutaway::scene::{ClipSurface, Mesh, Scene};
use cutaway::strategies::Method;
use glam::{DAffine3, DVec3};

const EXACT: [&str; 6] = [
    "raycast+mask",
    "raycast+stencil",
    "raycast+abuffer",
    "stencil",
    "raycast+mask@compute",
    "raycast+abuffer@compute",
];

/// What the exact strategies get wrong in some views.
fn faults(scene: &Scene) -> Vec<String> {
    let mut all = Vec::new();
    for (azimuth, elevation) in [(35.0, 25.0), (215.0, -25.0), (80.0, 5.0)] {
        let question = Question::through(scene, &orbit(azimuth, elevation, false), [160, 120]);
        let (undecided, covered) = (question.exact.undecided_px(), question.exact.covered_px());
        if undecided * 20 > covered {
            all.push(format!(
                "{}: {undecided} of {covered} px are undecided",
                scene.name
            ));
        }
        for name in EXACT {
            let method = name.parse::<Method>().expect("a strategy");
            let judged: Judged = question.answer(method);
            if judged.comparison.decided_wrong_px > 0 {
                let found = judged.fault_of_exact().unwrap_or_default();
                all.push(format!("{} at {azimuth}: {method}: {found}", scene.name));
            }
        }
    }
    all
}

/// A cube with a fin: two triangles back to back that stand on an edge of it, lists begun at some corners.
fn with_fin(first: usize, second: usize) -> Mesh {
    let mut mesh = shape("cube");
    let apex = mesh.positions.len() as u32;
    mesh.positions.push(DVec3::new(0.1, 1.2, 0.9));
    let at = |wanted: DVec3| {
        let found = mesh.positions.iter().position(|p| *p == wanted);
        found.expect("a corner of the cube") as u32
    };
    let edge = [
        at(DVec3::new(-0.5, 0.5, 0.5)),
        at(DVec3::new(0.5, 0.5, 0.5)),
    ];
    let mut front = [edge[0], edge[1], apex];
    let mut back = [edge[1], edge[0], apex];
    front.rotate_left(first);
    back.rotate_left(second);
    mesh.triangles.extend([front, back]);
    mesh
}

#[test]
fn a_fin_is_drawn_wherever_its_lists_begin() {
    let mut all = Vec::new();
    for first in 0..3 {
        for second in 0..3 {
            let mesh = with_fin(first, second);
            let cut = ClipSurface::plane(DVec3::new(0.13, 0.0, 0.0), DVec3::new(-1.0, 0.1, 0.2));
            for (name, cuts) in [("cut", vec![cut]), ("whole", Vec::new())] {
                let name = format!("fin {first} {second} {name}");
                all.extend(faults(&scene(&name, mesh.clone(), cuts)));
            }
        }
    }
    assert!(all.is_empty(), "{}", all.join("\n"));
}

#[test]
fn shells_on_each_other_show_the_face_that_faces_the_eye() {
    let ball = shape("sphere?subdivisions=3");
    let cut = || {
        vec![ClipSurface::plane(
            DVec3::new(0.0, 0.03, 0.0),
            DVec3::new(0.1, -1.0, 0.2),
        )]
    };
    let mut all = Vec::new();
    all.extend(faults(&scene(
        "opposite",
        joined(&[ball.clone(), turned(&ball)]),
        cut(),
    )));
    for thickness in [1e-5, 1e-6, 1e-7] {
        let inner = common::meshes::moved(
            &turned(&ball),
            DAffine3::from_scale(DVec3::splat(1.0 - thickness)),
        );
        let name = format!("shell of {thickness:e}");
        let thin = scene(&name, joined(&[ball.clone(), inner]), cut());
        all.extend(
            faults(&thin)
                .into_iter()
                .filter(|f| !f.contains("undecided")),
        );
    }
    assert!(all.is_empty(), "{}", all.join("\n"));
}
