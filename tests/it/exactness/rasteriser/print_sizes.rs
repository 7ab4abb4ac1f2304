//! Promise: 5,000 long triangles and more are drawn exactly at the sizes that are printed, by every exact strategy and both rasterisers
//! (issue 34.1).
//!
//! Six solids that machines are made of: a comb, tubes, fins, a lattice, an exchanger, an extrusion. The suite draws them at 200 x 150; with
//! CUTAWAY_LONG set at 2400 x 1800 and 4961 x 3508 too, which takes hours on two cores.

use std::f64::consts::TAU;
use std::time::Instant;

use cutaway::scene::{ClipSurface, Cut, Fill, Mesh, Scene};
use cutaway::session::Outcome;
use cutaway::strategies::{Method, Unsupported};
use cutaway_lab::hard_cases::meshes::{block, joined, prisms, shape, toothed};
use glam::{DVec2, DVec3};

use crate::common::{Question, is_long, scenes};

/// Every strategy that is exact for planes, by each rasteriser that it has.
const EXACT: [&str; 9] = [
    "raycast+mask",
    "raycast+mask@compute",
    "raycast+stencil",
    "raycast+abuffer",
    "raycast+abuffer@compute",
    "adaptive:0.5+mask",
    "stencil",
    "planar",
    "planar@compute",
];

/// A closed ring of so many sides along x, of two radii.
fn tube(sides: u32, middle: DVec2, radii: [f64; 2], along: [f64; 2]) -> Mesh {
    let mut mesh = Mesh::default();
    let profile = [(0, 0), (0, 1), (1, 1), (1, 0)];
    for (radius, end) in profile {
        mesh.positions.extend((0..sides).map(|i| {
            let turn = TAU * f64::from(i) / f64::from(sides);
            let at = middle + radii[radius] * DVec2::from_angle(turn);
            DVec3::new(along[end], at.x, at.y)
        }));
    }
    for strip in 0..4 {
        let [low, high] = [strip * sides, (strip + 1) % 4 * sides];
        for i in 0..sides {
            let next = (i + 1) % sides;
            mesh.triangles.push([low + i, high + next, high + i]);
            mesh.triangles.push([low + i, low + next, high + next]);
        }
    }
    mesh
}

/// Two plates, a shell, and tubes of 24 sides from one plate into the other.
fn exchanger(tubes: u32) -> Mesh {
    let per_row = f64::from(tubes).sqrt().ceil();
    let pitch = 1.3 / per_row;
    let mut bodies: Vec<Mesh> = (0..tubes)
        .map(|i| {
            let cell = DVec2::new(f64::from(i) % per_row, (f64::from(i) / per_row).floor());
            let middle = (cell - 0.5 * (per_row - 1.0)) * pitch;
            tube(24, middle, [0.33 * pitch, 0.4 * pitch], [-1.9, 1.9])
        })
        .collect();
    bodies.push(tube(96, DVec2::ZERO, [0.95, 1.0], [-2.2, 2.2]));
    for x in [-1.85, 1.85] {
        let half = DVec3::new(0.04, 0.66, 0.66);
        let middle = DVec3::X * x;
        bodies.push(block(middle - half, middle + half));
    }
    joined(&bodies)
}

/// Bars along each axis in turn, which run through each other.
fn lattice(per_axis: u32) -> Mesh {
    let pitch = 2.0 / f64::from(per_axis);
    let mut bars = Vec::new();
    for axis in 0..3 {
        for cell in 0..per_axis * per_axis {
            let [i, j] = [cell % per_axis, cell / per_axis].map(f64::from);
            let mut middle = DVec3::ZERO;
            // No bar has a face in the plane of another's.
            middle[(axis + 1) % 3] = (i + 0.5) * pitch - 1.0 + 0.07 * pitch * axis as f64;
            middle[(axis + 2) % 3] = (j + 0.5) * pitch - 1.0 - 0.05 * pitch * axis as f64;
            let mut half = DVec3::splat(0.2 * pitch);
            half[axis] = 1.1 + 0.01 * axis as f64;
            bars.push(block(middle - half, middle + half));
        }
    }
    joined(&bars)
}

/// Every exact strategy draws the solid, cut by a slanted plane, without a decided wrong pixel at every size.
#[allow(
    clippy::disallowed_methods,
    reason = "a run of hours says how long each frame takes; nothing is tested by it"
)]
fn is_exact(name: &str, mesh: Mesh, fill: Fill) {
    let mut scene: Scene = scenes::scene(name, mesh, Vec::new());
    scene.parts[0].fill = fill;
    let at = scene.bounds().centre() + DVec3::splat(0.013);
    let plane = ClipSurface::plane(at, DVec3::new(0.3, -0.2, 1.0).normalize());
    scene.cuts = vec![Cut::new("slanted", vec![plane])];
    let sizes = [[200, 150], [2400, 1800], [4961, 3508]];
    for size_px in &sizes[..if is_long() { 3 } else { 1 }] {
        let question = Question::new(&scene, *size_px);
        for method in EXACT.map(|name| name.parse::<Method>().expect("a strategy")) {
            let started = Instant::now();
            let judged = question.answer(method);
            let took = started.elapsed().as_secs();
            println!(
                "{name} {size_px:?} {method}: {} px decided wrong, {} undecided, {:?}, {took} s",
                judged.comparison.decided_wrong_px,
                judged.exact.undecided.iter().filter(|u| **u).count(),
                judged.outcome,
            );
            if let Outcome::Refused(refusal) = &judged.outcome {
                // Lists have parity alone, and may outgrow a buffer of the device.
                assert!(
                    method.to_string().contains("abuffer"),
                    "{name}: {method}: {refusal:?}"
                );
                let is_of_size = refusal.unsupported == Unsupported::Limit && *size_px != sizes[0];
                assert!(
                    (refusal.unsupported == Unsupported::Nonzero && fill == Fill::Nonzero)
                        || is_of_size,
                    "{name}: {method}: {refusal:?}"
                );
                continue;
            }
            assert_eq!(judged.fault_of_exact(), None, "{name} {size_px:?} {method}");
        }
    }
}

#[test]
fn comb() {
    is_exact("comb", shape("comb?teeth=400"), Fill::EvenOdd);
}

#[test]
fn tubes() {
    is_exact("tubes", prisms(104, 24), Fill::EvenOdd);
}

#[test]
fn fins() {
    is_exact("fins", prisms(625, 4), Fill::EvenOdd);
}

#[test]
fn lattice_of_bars() {
    is_exact("lattice", lattice(12), Fill::Nonzero);
}

#[test]
fn heat_exchanger() {
    is_exact("exchanger", exchanger(300), Fill::EvenOdd);
}

#[test]
fn extrusion() {
    is_exact("extrusion", toothed(600), Fill::EvenOdd);
}
