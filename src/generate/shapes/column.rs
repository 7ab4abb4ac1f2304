//! `column`: a fluted column on a base, with a capital.
//!
//! Twenty flutes that meet in sharp arrises, as on Doric shafts, and a shaft that narrows upwards along a parabola.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use super::Part;
use super::milled::{Facing, Milled, WallSide};
use super::outline::circle;
use super::spec::{ShapeInfo, ShapeParameter};

pub(super) const COLUMN: ShapeInfo = ShapeInfo {
    name: "column",
    summary: "a fluted column between a round base and a square slab",
    parameters: &[
        ShapeParameter::count("flutes", "flutes", 20, [4, 64]),
        ShapeParameter::count("detail", "points across a flute", 10, [2, 200]),
        ShapeParameter::length("height", "of the shaft, over the radius at its foot", 8.0),
    ],
    triangles: |v| {
        let around = v.real("flutes") * v.real("detail");
        2.0 * around * (RINGS as f64 + 40.0)
    },
    build: |v| {
        let (flutes, detail) = (v.count("flutes"), v.count("detail"));
        let mesh = column(flutes, detail, v.real("height")).mesh(|y, p| DVec3::new(p.y, y, p.x))?;
        Ok(vec![Part::new("column", mesh)])
    },
};

/// Sections of the shaft.
const RINGS: usize = 24;
/// Depth of a flute relative to its width.
const DEPTH: f64 = 0.22;
/// Taper of the shaft, as a share of its radius.
const NARROWING: f64 = 0.18;
/// Profiles of the base below the shaft and of the capital above it, as heights and radii relative to the shaft's radius.
const BASE: [[f64; 2]; 4] = [[0.0, 1.35], [0.18, 1.35], [0.18, 1.18], [0.34, 1.18]];
const CAPITAL: [[f64; 2]; 3] = [[0.0, 0.92], [0.3, 1.3], [0.34, 1.3]];
const SLAB: f64 = 0.28;

/// The outline of a fluted shaft of the given radius.
fn fluted(radius: f64, flutes: usize, detail: usize) -> Vec<DVec2> {
    let width = TAU * radius / flutes as f64;
    let points = (0..flutes * detail).map(|i| {
        let across = (i % detail) as f64 / detail as f64;
        let depth = DEPTH * width * (1.0 - (2.0 * across - 1.0).powi(2));
        DVec2::from_angle(TAU * i as f64 / (flutes * detail) as f64) * (radius - depth)
    });
    points.collect()
}

fn column(flutes: usize, detail: usize, height: f64) -> Milled {
    let mut solid = Milled::default();
    let corners = flutes * detail;
    let round = |solid: &mut Milled, from: f64, profile: &[[f64; 2]]| {
        let rings = profile
            .iter()
            .map(|[y, r]| (from + y, circle(DVec2::ZERO, *r, corners)));
        solid.walls(WallSide::Outer, rings.collect::<Vec<_>>())
    };
    // Ledges are faces between rings at the same height.
    let plinth = round(&mut solid, 0.0, &BASE[..2]);
    let torus = round(&mut solid, 0.0, &BASE[2..]);
    let foot = BASE[3][0];
    let shaft = (0..=RINGS).map(|i| {
        let share = i as f64 / RINGS as f64;
        let radius = 1.0 - NARROWING * share * share;
        (foot + height * share, fluted(radius, flutes, detail))
    });
    let shaft = solid.walls(WallSide::Outer, shaft.collect::<Vec<_>>());
    let top = foot + height;
    let capital = round(&mut solid, top, &CAPITAL);
    let under = top + CAPITAL[2][0];
    let half = DVec2::splat(1.42);
    let square = [
        half,
        DVec2::new(-half.x, half.y),
        -half,
        DVec2::new(half.x, -half.y),
    ]
    .to_vec();
    let slab = solid.walls(
        WallSide::Outer,
        [under, under + SLAB].map(|y| (y, square.clone())),
    );
    // Flat annular faces need no interior points.
    let spacing = 100.0;
    solid.face(Facing::Back, &[plinth.0], spacing);
    solid.face(Facing::Front, &[plinth.1, torus.0], spacing);
    solid.face(Facing::Front, &[torus.1, shaft.0], spacing);
    solid.face(Facing::Back, &[capital.0, shaft.1], spacing);
    solid.face(Facing::Back, &[slab.0, capital.1], spacing);
    solid.face(Facing::Front, &[slab.1], spacing);
    solid
}
