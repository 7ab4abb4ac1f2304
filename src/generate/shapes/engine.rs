//! `engine`: an inline engine with its moving parts, about 145,000 triangles; the typical model to cut open.
//!
//! A block with bores and water jacket, a head and a crankcase; inside them the crank, and rods, pistons and piston pins in positions that
//! match it; bolts through the head. Block, head and case are exterior, moving parts are interior, bolts are whole. Solids that
//! overlap others (bolts, pins, the crank in the case walls) have the higher priority there.

mod train;

use glam::{DVec2, DVec3, Vec3};

use super::crank::{self, pin_middle};
use super::lathe::{Fineness, turned};
use super::milled::{Facing, Milled, WallSide};
use super::outline::{arc, circle, subdivided};
use super::spec::{ShapeInfo, ShapeParameter};
use super::{Mesh, Part};
use crate::Result;
use crate::scene::{Material, Role};

/// Our own model of the scene in Diepstraten, Weiskopf and Ertl (2003), Figure 6.
pub(super) const ENGINE: ShapeInfo = ShapeInfo {
    name: "engine",
    summary: "an inline engine: block, head and case around crank, rods and pistons, about 145,000 triangles",
    parameters: &[
        ShapeParameter::count("cylinders", "cylinders", 4, [1, 8]),
        ShapeParameter::count(
            "detail",
            "corners around a main journal; triangles grow with its square",
            120,
            [16, 800],
        ),
    ],
    triangles: |v| {
        let (cylinders, detail) = (v.real("cylinders"), v.real("detail"));
        2.0 * (cylinders + 1.0) * (detail.powi(2) + 600.0)
            + (cylinders + 1.0) * (1.0 * detail.powi(2) + 60.0 * detail + 2000.0)
    },
    build: |v| {
        let (cylinders, detail) = (v.count("cylinders"), v.count("detail"));
        Engine::new(cylinders, detail).parts()
    },
};

/// Detail of all parts other than the crank, relative to the crank's.
const COARSER: f64 = 0.45;
/// Distance between solids that are bolted together: the thickness of a gasket.
const GASKET: f64 = 0.004;
/// Distance from crank pin to piston pin.
const ROD: f64 = 0.75;
/// Height of the piston's crown above its pin, and depth of its skirt below.
const CROWN: f64 = 0.16;
const SKIRT: f64 = 0.13;
const PISTON: f64 = 0.184;
const PISTON_INSIDE: f64 = 0.145;
const BORE: f64 = 0.19;
/// Outer radius of a bore's wall, which the water jacket surrounds.
const LINER: f64 = 0.215;
const PISTON_PIN: f64 = 0.042;
/// Heights of the ends of the block, and of the jacket in it, above the crank axis.
const BLOCK: [f64; 2] = [0.46, 1.16];
const JACKET: [f64; 2] = [0.66, 1.06];
const HEAD: f64 = 0.2;
/// Half the width of block and case, and of the jacket.
const HALF_WIDTH: f64 = 0.47;
const JACKET_HALF: f64 = 0.30;
const CASE_BOTTOM: f64 = -0.52;
const WALL: f64 = 0.06;
/// Radius of the head bolts, and half the distance between them.
const BOLT: f64 = 0.028;
const BOLT_HEAD: f64 = 0.05;
const BOLTS_APART: f64 = 0.38;

struct Engine {
    cylinders: usize,
    detail: usize,
    fine: Fineness,
    /// Centres of the crank pins.
    pins: Vec<DVec3>,
}

/// A rectangle with round corners about a point, counter-clockwise.
fn rounded(centre: DVec2, half: DVec2, radius: f64, step: f64) -> Vec<DVec2> {
    let quarter = std::f64::consts::FRAC_PI_2;
    let corners = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
    let corners = corners.into_iter().zip(0..).flat_map(|((x, y), i)| {
        let middle = centre + (half - radius) * DVec2::new(x, y);
        let from = quarter * f64::from(i);
        arc(middle, radius, [from, from + quarter], step)
    });
    subdivided(&corners.collect::<Vec<_>>(), 4.0 * step)
}

/// Maps a solid with a vertical axis to world space: its planes have coordinates z, then x.
fn upright(station: f64, p: DVec2) -> DVec3 {
    DVec3::new(p.y, station, p.x)
}

/// Maps a solid along the crank axis to world space.
fn along(station: f64, p: DVec2) -> DVec3 {
    DVec3::new(station, p.x, p.y)
}

impl Engine {
    fn new(cylinders: usize, detail: usize) -> Self {
        Self {
            cylinders,
            detail,
            fine: Fineness {
                // Non-rotating parts are coarser than the crank.
                detail: COARSER * detail as f64,
                unit: 0.14,
                fillet: 0.0,
            },
            pins: (0..cylinders).map(|k| pin_middle(cylinders, k)).collect(),
        }
    }

    fn step(&self) -> f64 {
        self.fine.step()
    }

    /// Position of the piston pin of a cylinder.
    fn piston_pin(&self, k: usize) -> DVec3 {
        let pin = self.pins[k];
        DVec3::new(pin.x, pin.y + (ROD * ROD - pin.z * pin.z).sqrt(), 0.0)
    }

    /// Centre and half extent of the cylinder bank, as z and x.
    fn bank(&self) -> (DVec2, f64) {
        let first = self.pins[0].x;
        let last = self.pins[self.cylinders - 1].x;
        (DVec2::new(0.0, (first + last) / 2.0), (last - first) / 2.0)
    }

    fn parts(&self) -> Result<Vec<Part>> {
        let gray = Vec3::new(0.56, 0.60, 0.64);
        let mut parts = vec![
            part("block", self.block()?, Role::Exterior, 0, gray),
            part(
                "head",
                self.head()?,
                Role::Exterior,
                0,
                Vec3::new(0.70, 0.72, 0.74),
            ),
            part(
                "case",
                self.case()?,
                Role::Exterior,
                0,
                Vec3::new(0.62, 0.64, 0.60),
            ),
        ];
        let crank = crank::built(self.cylinders, self.detail)?;
        parts.push(part(
            "crank",
            crank,
            Role::Interior,
            1,
            Vec3::new(0.36, 0.42, 0.55),
        ));
        for k in 0..self.cylinders {
            let n = k + 1;
            let rod = part(
                &format!("rod {n}"),
                self.rod(k)?,
                Role::Interior,
                1,
                Vec3::new(0.75, 0.55, 0.30),
            );
            let piston = self.piston(k)?;
            let piston = part(
                &format!("piston {n}"),
                piston,
                Role::Interior,
                1,
                Vec3::new(0.80, 0.80, 0.78),
            );
            let pin = part(
                &format!("piston pin {n}"),
                self.pin(k)?,
                Role::Interior,
                2,
                Vec3::new(0.45, 0.45, 0.48),
            );
            parts.extend([rod, piston, pin]);
        }
        for (i, at) in self.bolt_places().into_iter().enumerate() {
            let name = format!("bolt {}", i + 1);
            parts.push(part(
                &name,
                self.bolt(at)?,
                Role::Whole,
                2,
                Vec3::new(0.30, 0.30, 0.32),
            ));
        }
        Ok(parts)
    }

    /// The block: bores go right through it and are surrounded by a closed water jacket.
    fn block(&self) -> Result<Mesh> {
        let (middle, half) = self.bank();
        let step = self.step();
        let mut solid = Milled::default();
        let outline = rounded(middle, DVec2::new(HALF_WIDTH, half + 0.36), 0.06, step);
        let heights = self.fine.profile(&[[BLOCK[0], 0.0], [BLOCK[1], 0.0]]);
        let rings = heights.iter().map(|[y, _]| (*y, outline.clone()));
        let rim = solid.walls(WallSide::Outer, rings);
        let (mut bottom, mut top) = (vec![rim.0], vec![rim.1]);
        let corners = self.fine.corners(BORE);
        for pin in &self.pins {
            let profile = self.fine.profile(&[[BLOCK[0], BORE], [BLOCK[1], BORE]]);
            let bore = turned(
                &mut solid,
                WallSide::Bore,
                DVec2::new(0.0, pin.x),
                corners,
                profile,
            );
            bottom.push(bore.0);
            top.push(bore.1);
        }
        let jacket = rounded(middle, DVec2::new(JACKET_HALF, half + 0.28), 0.26, step);
        let around = solid.walls(WallSide::Bore, JACKET.map(|y| (y, jacket.clone())));
        let (mut floor, mut ceiling) = (vec![around.0], vec![around.1]);
        for pin in &self.pins {
            let liner = circle(DVec2::new(0.0, pin.x), LINER, corners);
            let liner = solid.walls(WallSide::Outer, JACKET.map(|y| (y, liner.clone())));
            floor.push(liner.0);
            ceiling.push(liner.1);
        }
        let spacing = 4.0 * step;
        solid.face(Facing::Back, &bottom, spacing);
        solid.face(Facing::Front, &top, spacing);
        solid.face(Facing::Front, &floor, spacing);
        solid.face(Facing::Back, &ceiling, spacing);
        solid.mesh(upright)
    }

    /// The head: a plate that closes the bores, with a narrower cover on it.
    fn head(&self) -> Result<Mesh> {
        let (middle, half) = self.bank();
        let mut solid = Milled::default();
        let outline = |in_by: f64| {
            let half = DVec2::new(HALF_WIDTH - in_by, half + 0.36 - in_by);
            rounded(middle, half, 0.06, self.step())
        };
        let top = BLOCK[1] + HEAD;
        let plate = solid.walls(
            WallSide::Outer,
            [BLOCK[1] + GASKET, top].map(|y| (y, outline(0.0))),
        );
        let cover = solid.walls(
            WallSide::Outer,
            [top, top + 0.12].map(|y| (y, outline(0.16))),
        );
        let spacing = 4.0 * self.step();
        solid.face(Facing::Back, &[plate.0], spacing);
        solid.face(Facing::Front, &[plate.1, cover.0], spacing);
        solid.face(Facing::Front, &[cover.1], spacing);
        solid.mesh(upright)
    }

    /// The crankcase: a trough around the crank, open towards the block.
    fn case(&self) -> Result<Mesh> {
        let (middle, half) = self.bank();
        let mut solid = Milled::default();
        let outline = |half_width: f64, more: f64, radius: f64| {
            rounded(
                middle,
                DVec2::new(half_width, half + more),
                radius,
                self.step(),
            )
        };
        let outer = outline(HALF_WIDTH, 0.36, 0.06);
        let heights = self
            .fine
            .profile(&[[CASE_BOTTOM, 0.0], [BLOCK[0] - GASKET, 0.0]]);
        let outside = solid.walls(
            WallSide::Outer,
            heights.iter().map(|[y, _]| (*y, outer.clone())),
        );
        let inner = outline(HALF_WIDTH - WALL, 0.36 - WALL, 0.03);
        let heights = self
            .fine
            .profile(&[[CASE_BOTTOM + WALL, 0.0], [BLOCK[0] - GASKET, 0.0]]);
        let inside = solid.walls(
            WallSide::Bore,
            heights.iter().map(|[y, _]| (*y, inner.clone())),
        );
        let spacing = 4.0 * self.step();
        solid.face(Facing::Back, &[outside.0], spacing);
        solid.face(Facing::Front, &[inside.0], spacing);
        solid.face(Facing::Front, &[outside.1, inside.1], spacing);
        solid.mesh(upright)
    }

    /// Positions of the bolts: between the cylinders and at both ends, on both sides.
    fn bolt_places(&self) -> Vec<DVec2> {
        let (_, half) = self.bank();
        let pitch = if self.cylinders > 1 {
            2.0 * half / (self.cylinders - 1) as f64
        } else {
            0.48
        };
        let xs = (0..=self.cylinders).map(|i| self.pins[0].x + (i as f64 - 0.5) * pitch);
        xs.flat_map(|x| [-BOLTS_APART, BOLTS_APART].map(|z| DVec2::new(z, x)))
            .collect()
    }

    /// A bolt, from half way down the block to its head above the plate.
    fn bolt(&self, at: DVec2) -> Result<Mesh> {
        let mut solid = Milled::default();
        let top = BLOCK[1] + HEAD;
        let corners = self.fine.corners(BOLT);
        let profile = self.fine.profile(&[
            [0.8, BOLT],
            [top + GASKET, BOLT],
            [top + GASKET, BOLT_HEAD],
            [top + 0.05, BOLT_HEAD],
        ]);
        let rim = turned(&mut solid, WallSide::Outer, at, corners, profile);
        solid.face(Facing::Back, &[rim.0], 4.0 * self.step());
        solid.face(Facing::Front, &[rim.1], 4.0 * self.step());
        solid.mesh(upright)
    }
}

fn part(name: &str, mesh: Mesh, role: Role, priority: i32, color: Vec3) -> Part {
    Part {
        role,
        priority: (priority > 0).then_some(priority),
        material: Material {
            color,
            ..Material::default()
        },
        ..Part::new(name, mesh)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pistons_hang_on_their_rods_within_the_block() {
        for cylinders in [1, 3, 4] {
            let engine = Engine::new(cylinders, 32);
            for k in 0..cylinders {
                let (pin, small) = (engine.pins[k], engine.piston_pin(k));
                assert!(((small - pin).length() - ROD).abs() < 1e-12, "rod {k}");
                assert!(small.y + CROWN < BLOCK[1], "piston {k} meets the head");
            }
        }
    }
}
