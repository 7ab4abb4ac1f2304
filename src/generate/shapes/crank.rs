//! `crank`: the crankshaft of an inline engine, about 100,000 triangles, one closed surface.
//!
//! Snout, main journals, counterweighted webs, crank pins, flange. Journals and pins run into the webs with fillets, webs
//! have chamfers. Main journals are hollow right through the webs next to them, and so are the pins; the flange has bolt
//! holes. Each of these bores is a through-hole: the surface has genus `2 throws + 1 + 6`.
//!
//! On each face of a web, the outline contains two disjoint circles: that of the journal or pin that continues there, and
//! that of the bore that ends there. The dimensions below keep them apart; [`super::milled`] does the rest.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use super::lathe::{Fineness, turned};
use super::milled::{Facing, Milled, WallSide};
use super::outline::inset;
use super::spec::{ShapeInfo, ShapeParameter};
use super::web::{Web, throw_angles};
use super::{Mesh, Part};
use crate::Result;

/// The crankshaft pictured in the documentation.
pub(super) const CRANK: ShapeInfo = ShapeInfo {
    name: "crank",
    summary: "a crankshaft with counterweights, fillets and through-bores, about 100,000 triangles",
    parameters: &[
        ShapeParameter::count("throws", "crank pins", 4, [1, 12]),
        ShapeParameter::count(
            "detail",
            "corners around a main journal; triangles grow with its square",
            DETAIL,
            [16, 1600],
        ),
    ],
    triangles: |v| 2.0 * (v.real("throws") + 1.0) * (v.real("detail").powi(2) + 600.0),
    build: |v| {
        let mesh = built(v.count("throws"), v.count("detail"))?;
        Ok(vec![Part::new("crank", mesh)])
    },
};

/// A crank along x, centred at the origin.
pub(super) fn built(throws: usize, detail: usize) -> Result<Mesh> {
    let crank = crank(throws, detail);
    let half = crank.length * 0.5;
    let place = |station: f64, p: DVec2| DVec3::new(station - half, p.x, p.y);
    crank.solid.mesh(place)
}

/// The centre of crank pin `k`.
pub(super) fn pin_middle(throws: usize, k: usize) -> DVec3 {
    let half = (main_end(throws) + FLANGE_LENGTH) * 0.5;
    let along = (main_end(k) + main_start(k + 1)) * 0.5;
    let across = DVec2::from_angle(throw_angles(throws)[k]) * THROW;
    DVec3::new(along - half, across.x, across.y)
}

/// With four throws these two give 99,968 triangles.
const DETAIL: u32 = 120;
/// Spacing of interior points of planar faces, in outline steps.
const FACE_SPACING: f64 = 3.04;

const THROW: f64 = 0.215;
const MAIN: f64 = 0.14;
const MAIN_LENGTH: f64 = 0.15;
const PIN: f64 = 0.12;
const PIN_LENGTH: f64 = 0.15;
const FILLET: f64 = 0.014;
const MAIN_BORE: f64 = 0.045;
const PIN_BORE: f64 = 0.035;
const WEB_LENGTH: f64 = 0.09;
const CHAMFER: f64 = 0.012;
const WEB: Web = Web {
    throw: THROW,
    cheek: 0.165,
    waist: DVec2::new(0.19, -0.02),
    waist_round: 0.06,
    weight: 0.4,
    shoulder: 0.30,
    shoulder_round: 0.05,
};
/// Radius and length of the snout's steps, from the end.
const SNOUT: [[f64; 2]; 2] = [[0.075, 0.2], [0.105, 0.1]];
const FLANGE: f64 = 0.215;
const FLANGE_LENGTH: f64 = 0.06;
/// Radius and depth of the recess that centres the flywheel.
const PILOT: [f64; 2] = [0.07, 0.04];
const BOLTS: usize = 6;
const BOLT: f64 = 0.014;
const BOLT_CIRCLE: f64 = 0.18;

struct Crank {
    solid: Milled,
    length: f64,
}

/// First and last ring of a main journal and of its bore.
struct Bearing {
    journal: (usize, usize),
    bore: (usize, usize),
}

/// Start of the main journal before throw `k`; the last one is followed by the flange.
fn main_start(k: usize) -> f64 {
    let snout: f64 = SNOUT.iter().map(|[_, length]| length).sum();
    snout + k as f64 * (MAIN_LENGTH + PIN_LENGTH + 2.0 * WEB_LENGTH)
}

fn main_end(k: usize) -> f64 {
    main_start(k) + MAIN_LENGTH
}

fn crank(throws: usize, detail: usize) -> Crank {
    let fine = Fineness {
        detail: detail as f64,
        unit: MAIN,
        fillet: FILLET,
    };
    let spacing = FACE_SPACING * fine.step();
    let mut solid = Milled::default();
    let bearings: Vec<Bearing> = (0..=throws)
        .map(|k| bearing(&mut solid, fine, k, throws))
        .collect();
    solid.face(
        Facing::Back,
        &[bearings[0].journal.0, bearings[0].bore.0],
        spacing,
    );
    let outline = WEB.outline(fine.step());
    for (k, angle) in throw_angles(throws).into_iter().enumerate() {
        let up = DVec2::from_angle(angle);
        // Local y to the pin, local x to its right.
        let web: Vec<DVec2> = outline.iter().map(|p| up * p.y - up.perp() * p.x).collect();
        let [outer_back, outer_front] = [main_end(k), main_start(k + 1)];
        let [inner_back, inner_front] = [outer_back + WEB_LENGTH, outer_front - WEB_LENGTH];
        let near = cheek(&mut solid, fine, &web, [outer_back, inner_back]);
        let far = cheek(&mut solid, fine, &web, [inner_front, outer_front]);
        let profile = fine.journal([inner_back, inner_front], PIN);
        let pin = turned(
            &mut solid,
            WallSide::Outer,
            up * THROW,
            fine.corners(PIN),
            profile,
        );
        let profile = fine.profile(&[[outer_back, PIN_BORE], [outer_front, PIN_BORE]]);
        let corners = fine.corners(PIN_BORE);
        let bore = turned(&mut solid, WallSide::Bore, up * THROW, corners, profile);
        let (before, after) = (&bearings[k], &bearings[k + 1]);
        solid.face(Facing::Back, &[near.0, before.journal.1, bore.0], spacing);
        solid.face(Facing::Front, &[near.1, pin.0, before.bore.1], spacing);
        solid.face(Facing::Back, &[far.0, pin.1, after.bore.0], spacing);
        solid.face(Facing::Front, &[far.1, after.journal.0, bore.1], spacing);
    }
    let length = flange(&mut solid, fine, main_end(throws), &bearings[throws]);
    Crank { solid, length }
}

/// The `k`-th main journal (the first includes the snout) and its bore through the webs on both sides.
fn bearing(solid: &mut Milled, fine: Fineness, k: usize, throws: usize) -> Bearing {
    let [start, end] = [main_start(k), main_end(k)];
    let profile = if k == 0 {
        let [[tip, tip_length], [seat, _]] = SNOUT;
        let mut profile = fine.profile(&[
            [0.0, tip - CHAMFER],
            [CHAMFER, tip],
            [tip_length, tip],
            [tip_length, seat - CHAMFER],
            [tip_length + CHAMFER, seat],
            [start, seat],
            [start, MAIN - CHAMFER],
            [start + CHAMFER, MAIN],
            [end - FILLET, MAIN],
        ]);
        profile.extend(fine.filleted(end, -1.0, MAIN).rev().skip(1));
        profile
    } else {
        fine.journal([start, end], MAIN)
    };
    let journal = turned(
        solid,
        WallSide::Outer,
        DVec2::ZERO,
        fine.corners(MAIN),
        profile,
    );

    let bore_start = if k == 0 { 0.0 } else { start - WEB_LENGTH };
    let bore = if k == throws {
        let (end, [pilot, depth]) = (end + FLANGE_LENGTH, PILOT);
        let bottom = end - depth;
        fine.profile(&[
            [bore_start, MAIN_BORE],
            [bottom, MAIN_BORE],
            [bottom, pilot],
            [end, pilot],
        ])
    } else {
        fine.profile(&[[bore_start, MAIN_BORE], [end + WEB_LENGTH, MAIN_BORE]])
    };
    let corners = fine.corners(MAIN_BORE);
    let bore = turned(solid, WallSide::Bore, DVec2::ZERO, corners, bore);
    Bearing { journal, bore }
}

/// The rim of a web between two stations, with chamfers.
fn cheek(
    solid: &mut Milled,
    fine: Fineness,
    outline: &[DVec2],
    [from, to]: [f64; 2],
) -> (usize, usize) {
    let narrow = inset(outline, CHAMFER);
    let flat = fine.profile(&[[from + CHAMFER, 0.0], [to - CHAMFER, 0.0]]);
    let mut rings = vec![(from, narrow.clone())];
    rings.extend(flat.into_iter().map(|[x, _]| (x, outline.to_vec())));
    rings.push((to, narrow));
    solid.walls(WallSide::Outer, rings)
}

/// Adds the flange after the last main journal; returns the station where the crank ends.
fn flange(solid: &mut Milled, fine: Fineness, start: f64, last: &Bearing) -> f64 {
    let end = start + FLANGE_LENGTH;
    let profile = fine.profile(&[
        [start, FLANGE - CHAMFER],
        [start + CHAMFER, FLANGE],
        [end - CHAMFER, FLANGE],
        [end, FLANGE - CHAMFER],
    ]);
    let rim = turned(
        solid,
        WallSide::Outer,
        DVec2::ZERO,
        fine.corners(FLANGE),
        profile,
    );
    let mut back = vec![rim.0, last.journal.1];
    let mut front = vec![rim.1, last.bore.1];
    for k in 0..BOLTS {
        let centre = DVec2::from_angle(TAU * (k as f64 + 0.5) / BOLTS as f64) * BOLT_CIRCLE;
        let profile = fine.profile(&[[start, BOLT], [end, BOLT]]);
        let hole = turned(solid, WallSide::Bore, centre, fine.corners(BOLT), profile);
        back.push(hole.0);
        front.push(hole.1);
    }
    let spacing = FACE_SPACING * fine.step();
    solid.face(Facing::Back, &back, spacing);
    solid.face(Facing::Front, &front, spacing);
    end
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_volume_is_that_of_the_slabs() {
        for (throws, detail) in [(1, 16), (3, 40), (4, 120)] {
            let crank = crank(throws, detail);
            let slabs = crank.solid.volume_by_slabs();
            let mesh = crank.solid.mesh(|x, p| DVec3::new(x, p.x, p.y)).unwrap();
            let relative = mesh.volume() / slabs - 1.0;
            assert!(
                relative.abs() < 1e-12,
                "{throws} throws at {detail}: {} against {slabs}",
                mesh.volume()
            );
        }
    }

    #[test]
    fn outlines_keep_apart_at_every_detail() {
        for detail in 16..=64 {
            let built = crank(1, detail).solid.mesh(|x, p| DVec3::new(x, p.x, p.y));
            assert!(built.is_ok(), "detail {detail}: {built:?}");
        }
    }
}
