//! Solids described station by station along an axis, as if turned on a lathe and milled.
//!
//! A solid is a list of *rings* (closed polygons, each in a plane perpendicular to the axis), *walls* between rings with equally many
//! corners, and planar *faces* between rings at the same station. Where neighbouring sections differ, one outline contains
//! the other, so a face is a region with holes; no outline crosses another, and the surface is closed by construction if
//! each ring has a wall on one side and a wall or a face on the other.

use glam::{DVec2, DVec3};

use super::Mesh;
use super::fill::fill;
use crate::Result;

/// A closed polygon perpendicular to the axis, counter-clockwise seen from the axis' positive end.
#[derive(Clone, Debug)]
pub(super) struct Ring {
    /// Position along the axis.
    pub(super) station: f64,
    /// The corners.
    pub(super) points: Vec<DVec2>,
}

/// Solid side of a wall.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum WallSide {
    /// The wall bounds the solid from outside.
    Outer,
    /// The wall of a bore.
    Bore,
}

/// The end of the axis that a face points to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Facing {
    /// The negative end.
    Back,
    /// The positive end.
    Front,
}

#[derive(Clone, Debug)]
struct MilledFace {
    facing: Facing,
    rings: Vec<usize>,
    spacing: f64,
}

/// A solid under construction.
#[derive(Clone, Debug, Default)]
pub(super) struct Milled {
    pub(super) rings: Vec<Ring>,
    pub(super) walls: Vec<(usize, usize, WallSide)>,
    faces: Vec<MilledFace>,
}

impl Milled {
    /// Adds a chain of rings in order along the axis, with walls between them; returns the first and the last ring.
    pub(super) fn walls(
        &mut self,
        side: WallSide,
        rings: impl IntoIterator<Item = (f64, Vec<DVec2>)>,
    ) -> (usize, usize) {
        let first = self.rings.len();
        for (station, points) in rings {
            self.rings.push(Ring { station, points });
        }
        let last = self.rings.len() - 1;
        self.walls.extend((first..last).map(|i| (i, i + 1, side)));
        (first, last)
    }

    /// Adds the planar face between rings at the same station: the region inside an odd number of them.
    pub(super) fn face(&mut self, facing: Facing, rings: &[usize], spacing: f64) {
        self.faces.push(MilledFace {
            facing,
            rings: rings.to_vec(),
            spacing,
        });
    }

    /// The surface; `place` maps a station and a point of its plane to a point in space.
    pub(super) fn mesh(&self, place: impl Fn(f64, DVec2) -> DVec3) -> Result<Mesh> {
        let mut mesh = Mesh::default();
        let mut first_of = Vec::with_capacity(self.rings.len());
        for ring in &self.rings {
            first_of.push(mesh.positions.len() as u32);
            let points = ring.points.iter().map(|p| place(ring.station, *p));
            mesh.positions.extend(points);
        }
        for (a, b, side) in &self.walls {
            let n = self.rings[*a].points.len() as u32;
            let (a, b) = (first_of[*a], first_of[*b]);
            for j in 0..n {
                let k = (j + 1) % n;
                mesh.triangles.extend(match side {
                    WallSide::Outer => [[a + j, a + k, b + k], [a + j, b + k, b + j]],
                    WallSide::Bore => [[a + j, b + k, a + k], [a + j, b + j, b + k]],
                });
            }
        }
        for face in &self.faces {
            let polygons: Vec<&[DVec2]> = face
                .rings
                .iter()
                .map(|r| self.rings[*r].points.as_slice())
                .collect();
            let filled = fill(&polygons, face.spacing)?;
            let station = self.rings[face.rings[0]].station;
            debug_assert!(
                (face.rings.iter()).all(|r| self.rings[*r].station == station),
                "the rings of a face lie in one plane, to the last bit"
            );
            // Maps vertex indices of the filled region to those of the mesh.
            let mut number: Vec<u32> = Vec::new();
            for ring in &face.rings {
                number.extend((first_of[*ring]..).take(self.rings[*ring].points.len()));
            }
            number.extend((mesh.positions.len() as u32..).take(filled.added.len()));
            let added = filled.added.iter().map(|p| place(station, *p));
            mesh.positions.extend(added);
            mesh.triangles.extend(filled.triangles.iter().map(|t| {
                let [a, b, c] = t.map(|i| number[i as usize]);
                match face.facing {
                    Facing::Front => [a, b, c],
                    Facing::Back => [a, c, b],
                }
            }));
        }
        Ok(mesh)
    }

    /// Volume by the prismatoid formula, wall by wall, from the outlines' areas alone. The volume that the triangles enclose
    /// must equal it, because every wall's quads are planar.
    #[cfg(test)]
    pub(super) fn volume_by_slabs(&self) -> f64 {
        use super::outline::area;
        self.walls
            .iter()
            .map(|(a, b, side)| {
                let (a, b) = (&self.rings[*a], &self.rings[*b]);
                let middle: Vec<DVec2> = (a.points.iter().zip(&b.points))
                    .map(|(p, q)| p.midpoint(*q))
                    .collect();
                let slab = (b.station - a.station) / 6.0
                    * (area(&a.points) + 4.0 * area(&middle) + area(&b.points));
                match side {
                    WallSide::Outer => slab,
                    WallSide::Bore => -slab,
                }
            })
            .sum()
    }
}
