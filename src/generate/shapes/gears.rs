//! `gears`: a wheel and a pinion in mesh, two parts with bores.
//!
//! Full-depth involute teeth at 20 degrees. From 17 teeth on such flanks need no undercut, whatever they mesh with, and a
//! little backlash keeps the two solids apart.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};

use super::milled::{Facing, Milled, WallSide};
use super::outline::{arc, circle, subdivided};
use super::spec::{ShapeInfo, ShapeParameter, Values};
use super::{Mesh, parts_of};
use crate::Result;

/// Two gears.
pub(super) const GEARS: ShapeInfo = ShapeInfo {
    name: "gears",
    summary: "two meshing involute gears with bores, as two parts",
    parameters: &[
        ShapeParameter::count("wheel", "teeth of the wheel", 28, TEETH),
        ShapeParameter::count("pinion", "teeth of the pinion", 19, TEETH),
        ShapeParameter::length("module", "pitch diameter per tooth", 0.04),
        ShapeParameter::length("thickness", "along z", 0.25),
        ShapeParameter::real(
            "bore",
            "radius of a bore as a share of the pitch radius",
            0.3,
            [0.01, 0.7],
        ),
        ShapeParameter::count("flank", "pieces of a tooth's flank", 8, [1, 256]),
    ],
    triangles: |v| {
        let flank = v.real("flank");
        // Outline and bore, in six layers and at both ends; then the lattice points inside the two faces.
        let gear = |teeth: f64| teeth * (28.0 * flank + 360.0) + 10.5 * teeth * teeth + 500.0;
        gear(v.real("wheel")) + gear(v.real("pinion"))
    },
    build: |v| {
        let (wheel, pinion) = (v.count("wheel") as f64, v.count("pinion") as f64);
        let module = v.real("module");
        let [left, right] = [wheel, pinion].map(|teeth| module * (0.5 * teeth + 1.0));
        // The pair's bounds are centred at the origin, and the pitch circles touch.
        let x_wheel = -0.5 * (left + right) + left + 0.5 * module;
        let x_pinion = x_wheel + 0.5 * module * (wheel + pinion);
        // A tooth of the wheel points to the pinion, a gap of the pinion to the wheel.
        let parts = [
            ("wheel", gear(v, wheel, 0.0, x_wheel)?),
            ("pinion", gear(v, pinion, PI + PI / pinion, x_pinion)?),
        ];
        Ok(parts_of(parts))
    },
};

const TEETH: [u32; 2] = [17, 2000];
const PRESSURE_ANGLE: f64 = PI / 9.0;
/// Tooth height above and below the pitch circle, and the backlash taken off each tooth, in modules.
const ADDENDUM: f64 = 1.0;
const DEDENDUM: f64 = 1.25;
const BACKLASH: f64 = 0.05;

fn gear(v: &Values, teeth: f64, phase: f64, x: f64) -> Result<Mesh> {
    let (module, thickness) = (v.real("module"), v.real("thickness"));
    let outline = outline(teeth, module, v.count("flank"), phase);
    let radius = 0.5 * module * teeth * v.real("bore");
    // Enough corners that the bore's edges are about as long as those of the teeth.
    let spacing = 0.6 * module;
    let corners = 4 * ((TAU * radius / spacing / 4.0).ceil() as usize).clamp(8, 500);
    let bore = circle(DVec2::ZERO, radius, corners);
    let layers = 6_u32;
    let stations = (0..=layers).map(|k| (f64::from(k) / f64::from(layers) - 0.5) * thickness);
    let mut solid = Milled::default();
    let rim = solid.walls(
        WallSide::Outer,
        stations.clone().map(|s| (s, outline.clone())),
    );
    let hole = solid.walls(WallSide::Bore, stations.map(|s| (s, bore.clone())));
    solid.face(Facing::Back, &[rim.0, hole.0], spacing);
    solid.face(Facing::Front, &[rim.1, hole.1], spacing);
    solid.mesh(|z, p| DVec3::new(p.x + x, p.y, z))
}

/// The teeth of a gear around the origin, a tooth at angle `phase`.
fn outline(teeth: f64, module: f64, flank: usize, phase: f64) -> Vec<DVec2> {
    let pitch = 0.5 * module * teeth;
    let base = pitch * PRESSURE_ANGLE.cos();
    let (root, tip) = (pitch - DEDENDUM * module, pitch + ADDENDUM * module);
    // Half the angle that a tooth spans at a given radius.
    let involute = |angle: f64| angle.tan() - angle;
    let half_at = |radius: f64| {
        let on_base = (base / radius).min(1.0).acos();
        PI / (2.0 * teeth) - 0.5 * BACKLASH * module / pitch + involute(PRESSURE_ANGLE)
            - involute(on_base)
    };
    let start = base.max(root);
    let mut half_tooth: Vec<[f64; 2]> = Vec::new();
    if root < base {
        // The involute ends at the base circle; below, the flank is radial.
        half_tooth.push([root, half_at(base)]);
    }
    half_tooth.extend((0..=flank).map(|i| {
        let t = i as f64 / flank as f64;
        let radius = start * (1.0 - t) + tip * t;
        [radius, half_at(radius)]
    }));
    let mut corners = Vec::new();
    for k in 0..teeth as usize {
        let middle = phase + TAU * k as f64 / teeth;
        let polar = |angle: f64, radius: f64| DVec2::from_angle(middle + angle) * radius;
        corners.extend(half_tooth.iter().map(|[r, half]| polar(-half, *r)));
        corners.extend(half_tooth.iter().rev().map(|[r, half]| polar(*half, *r)));
        let feet = [
            middle + half_tooth[0][1],
            middle + TAU / teeth - half_tooth[0][1],
        ];
        let floor = arc(DVec2::ZERO, root, feet, 0.3 * module);
        corners.extend(&floor[1..floor.len() - 1]);
    }
    subdivided(&corners, 0.4 * module)
}

#[cfg(test)]
mod tests {
    use super::super::outline::area;
    use super::*;

    /// Returns true if a point is in a polygon: parity of the edges to its right.
    fn contains(polygon: &[DVec2], p: DVec2) -> bool {
        let n = polygon.len();
        let crossed = (0..n).filter(|i| {
            let (a, b) = (polygon[*i], polygon[(i + 1) % n]);
            (a.y > p.y) != (b.y > p.y) && a.x + (b.x - a.x) * ((p.y - a.y) / (b.y - a.y)) > p.x
        });
        crossed.count() % 2 == 1
    }

    #[test]
    fn teeth_mesh_without_touching_in_every_position() {
        let (wheel, pinion) = (28.0, 17.0);
        for turn in 0..10 {
            let turn = f64::from(turn) / 10.0 * TAU;
            let a = outline(wheel, 1.0, 8, turn / wheel);
            let b = outline(pinion, 1.0, 8, PI + (PI - turn) / pinion);
            let b: Vec<DVec2> = (b.iter())
                .map(|p| *p + DVec2::X * (0.5 * (wheel + pinion)))
                .collect();
            assert!(
                a.iter().all(|p| !contains(&b, *p)) && b.iter().all(|p| !contains(&a, *p)),
                "teeth overlap at turn {turn}"
            );
        }
    }

    #[test]
    fn teeth_take_about_half_of_the_ring_between_root_and_tip() {
        let (teeth, module) = (30.0, 1.0);
        let gear = area(&outline(teeth, module, 32, 0.3));
        let disc = |r: f64| PI * r * r;
        let share =
            (gear - disc(15.0 - DEDENDUM)) / (disc(15.0 + ADDENDUM) - disc(15.0 - DEDENDUM));
        assert!((0.4..0.5).contains(&share), "{share}");
    }
}
