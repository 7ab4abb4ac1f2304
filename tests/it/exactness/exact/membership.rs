//! A second evaluation that shares nothing with the first: points along a ray, each tested by itself in world space.
//!
//! Inside is a winding number from solid angles, removed is [`ClipSurface::kept_height`]: no crossings, no parity, no
//! events, no scene space. Slow, so only for some pixels; blind to what is thinner than its step, so only for decided ones.

use std::f64::consts::TAU;

use cutaway::layers::Kind;
use cutaway::scene::{ClipSurface, Mesh, Prepared, Scene};
use cutaway_lab::exact::evaluate;
use glam::{DVec2, DVec3, dvec3};

use crate::exactness::exact::solids::{ball, cuboid, eye, fractal, noise, orbit, relief, scene};

/// Winding number of a mesh around a point (Van Oosterom and Strackee 1983).
fn winding(mesh: &Mesh, p: DVec3) -> f64 {
    let angle = |t: usize| {
        let [a, b, c] = mesh.corners(t).map(|v| v - p);
        let [x, y, z] = [a.length(), b.length(), c.length()];
        let numerator = a.dot(b.cross(c));
        let denominator = x * y * z + a.dot(b) * z + b.dot(c) * x + c.dot(a) * y;
        2.0 * numerator.atan2(denominator)
    };
    (0..mesh.triangles.len()).map(angle).sum::<f64>() / (2.0 * TAU)
}

#[derive(Clone, Copy, PartialEq)]
struct Point {
    inside: bool,
    removed: bool,
}

fn test(scene: &Scene, part: usize, p: DVec3) -> Point {
    let gone = |s: &ClipSurface| s.kept_height(p) < 0.0;
    Point {
        inside: winding(&scene.parts[part].mesh, p) > 0.5,
        removed: scene.cuts.iter().any(|c| c.surfaces.iter().all(gone)),
    }
}

/// Depths of points between two depths, near ones and far ones alike.
fn samples([near, far]: [f64; 2]) -> impl Iterator<Item = f64> {
    let steps = 1500;
    (0..steps).map(move |i| near + (far - near) * f64::from(i) / f64::from(steps))
}

#[test]
fn points_tested_one_by_one_agree() {
    let ring = |z: f64| relief(z, 0.8, 0.25, fractal(16, 3));
    let half = ClipSurface::plane(dvec3(0.1, 0.0, 0.0), dvec3(-1.0, 0.3, 0.2));
    let ridge = ClipSurface {
        u: dvec3(0.5, 0.0, 0.2),
        v: dvec3(0.0, 0.3, 0.0),
        scale: dvec3(0.7, -1.3, 0.2),
        ..ring(0.1)
    };
    let meshes = || {
        vec![
            ball(0.9, 12, 14),
            cuboid(dvec3(-0.2, -0.3, -1.1), dvec3(0.25, 0.2, 1.1)),
        ]
    };
    let mut random = noise(77);
    let mut kinds = [0; 3];
    for (cuts, camera) in [
        (vec![vec![ring(0.1), half.clone()]], orbit(35.0, 25.0)),
        (vec![vec![ring(-0.2)], vec![half]], orbit(-60.0, 40.0)),
        (
            vec![vec![ridge]],
            eye(dvec3(1.0, 2.0, 1.5), DVec3::ZERO, 50.0),
        ),
    ] {
        let scene = scene(meshes(), cuts, camera);
        let prepared = Prepared::new(&scene);
        let view = prepared.view([256, 256]);
        let exact = evaluate(&prepared, &view);
        for _ in 0..60 {
            let [x, y] = [0, 1].map(|_| 40 + (random() * 176.0) as u32);
            if exact.undecided[(y * 256 + x) as usize] {
                continue;
            }
            let (o, d) = view.ray(DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5));
            let ray = |t: f64| (o + d * t) / prepared.scale + prepared.centre_in_world;
            let far = view.near + 2.5 * prepared.bounds.radius();
            let layer = *exact.layers.at(x, y);
            let shows = |t: f64, part: usize| {
                let p = test(&scene, part, ray(t));
                p.inside && !p.removed
            };
            // The mesh in scene space is rounded to f32; this one is not.
            let step = 2e-6;
            let before = layer.depth - step;
            let early =
                samples([view.near, before.min(far)]).find(|t| (0..2).any(|part| shows(*t, part)));
            assert_eq!(early, None, "{layer:?} at {x}, {y} is not the first");
            let kind = layer.kind;
            if kind != Kind::Background {
                let part = usize::from(layer.part);
                let [a, b] = [before, layer.depth + step].map(|t| test(&scene, part, ray(t)));
                assert!(
                    b.inside && !b.removed,
                    "{layer:?} at {x}, {y} shows nothing"
                );
                let cause = if a.inside { Kind::Cap } else { Kind::Surface };
                assert_eq!(kind, cause, "{layer:?} at {x}, {y}");
                // Of parts that show at one point the smaller is seen, here the second.
                let smaller = (part + 1..2).any(|other| shows(layer.depth + step, other));
                assert!(!smaller, "{layer:?} at {x}, {y} hides a smaller part");
            }
            kinds[kind as usize] += 1;
        }
    }
    assert!(
        kinds.iter().all(|k| *k > 12),
        "too few of some kind: {kinds:?}"
    );
}
