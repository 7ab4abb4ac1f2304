//! The section of an open mesh, closed by generalised winding numbers (Jacobson, Kavan, Sorkine-Hornung 2013).
//!
//! All curves of the section, closed and open, are drawn into one triangulation. A triangle is inside if the mesh's winding number at its
//! centroid, rounded, is inside by the fill rule: the definition by which pictures and the exact reference cap open parts. So the outline
//! is that of the section where there is one, and where curves end, edges of the triangulation take its place, which join
//! ends that are near each other. Triangles that are too flat for the precision of the number follow their neighbours.
//!
//! Cost: a tree over the mesh once, and a logarithmic search in it for each triangle of the triangulation.
//!
//! Limits: the level line of a half within a hole is smooth, and the region is bounded by straight lines; it does not leave the convex
//! hull of the curves. A hole through which no curve passes changes nothing.

use glam::DVec3;

use super::fill::{Filled, fill_between};
use super::trim::chained;
use super::{Loop, Section, SectionDefect, SlicePlane};
use crate::scene::Fill;
use crate::scene::winding::WindingTree;

/// Largest error of a winding number by one ball of triangles that are summed together.
const BALL_TOLERANCE: f64 = 1e-5;

/// Distance to the surface over which a winding number is uncertain, as a share of the size of the mesh: some steps of `f32`.
const UNCERTAIN_SHARE: f64 = 1e-6;

/// Winding numbers of triangles, whose corners are `f32` from a point among them.
#[derive(Debug)]
pub(super) struct WindingNumbers {
    middle: DVec3,
    /// Distance to the surface over which numbers are uncertain.
    pub(super) uncertain: f64,
    tree: WindingTree,
}

impl WindingNumbers {
    /// Prepares triangles, of which there must be at least one.
    pub(super) fn of(positions: &[DVec3], triangles: &[[u32; 3]]) -> Self {
        let used = triangles.iter().flatten().map(|i| positions[*i as usize]);
        let start = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let (low, high) = used.fold(start, |(low, high), p| (low.min(p), high.max(p)));
        let middle = low.midpoint(high);
        let near = positions.iter().map(|p| (*p - middle).as_vec3());
        let tree = WindingTree::of(&near.collect::<Vec<_>>(), triangles);
        Self {
            middle,
            uncertain: UNCERTAIN_SHARE * low.distance(high),
            tree,
        }
    }

    /// The winding number around a point, rounded.
    pub(super) fn rounded(&self, at: DVec3) -> i32 {
        let (number, _) = self.tree.winding(at - self.middle, BALL_TOLERANCE);
        number.round() as i32
    }
}

/// A section with open curves, closed: the region is where winding numbers are inside by the fill rule. Curves that bound no such region
/// stay open.
pub(super) fn closed(
    section: Section,
    plane: &SlicePlane,
    numbers: &WindingNumbers,
    rule: Fill,
) -> Section {
    let loops: Vec<Vec<u32>> = section.loops.iter().map(|l| l.points.clone()).collect();
    let Filled {
        added,
        triangles,
        boundary,
        bridges,
        left_out,
    } = fill_between(
        &section.points,
        &loops,
        &section.open,
        numbers.uncertain,
        |at| rule.holds(numbers.rounded(plane.point(at))),
    );
    if bridges.is_empty() {
        return section;
    }
    let Section {
        mut points,
        open,
        mut defects,
        ..
    } = section;
    defects.retain(|defect| !matches!(defect, SectionDefect::Open { .. }));
    if let Some(first) = left_out.first() {
        let curve = loops.iter().chain(&open).nth(*first);
        let first = curve.and_then(|curve| curve.first());
        let at = first.map(|i| points[*i as usize]).unwrap_or_default();
        defects.push(SectionDefect::LeftOut {
            loops: left_out.len(),
            at: plane.point(at),
        });
    }
    points.extend(added);
    let outline = chained(&boundary, &points).into_iter();
    let mut closed = Section {
        loops: outline.map(|points| Loop { points }).collect(),
        points,
        open: Vec::new(),
        triangles,
        boundary,
        bridges,
        defects,
    };
    closed.defects.extend(closed.bridged(|at| plane.point(at)));
    closed
}
