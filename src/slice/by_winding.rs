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

use super::fill::{Filled, fill_between};
use super::trim::chained;
use super::{Loop, Section, SectionDefect, SlicePlane};
use crate::scene::Fill;
use crate::scene::winding::CentredTree;

/// Distance to the surface over which a winding number is uncertain, as a share of the size of the mesh: some steps of `f32`.
const UNCERTAIN_SHARE: f64 = 1e-6;

/// A section with open curves, closed: the region is where winding numbers are inside by the fill rule. Curves that bound no such region
/// stay open.
pub(super) fn closed(
    section: Section,
    plane: &SlicePlane,
    tree: &CentredTree,
    rule: Fill,
) -> Section {
    let loops: Vec<Vec<u32>> = section.loops.iter().map(|l| l.points.clone()).collect();
    let centre = tree.bounds.centre();
    let uncertain = UNCERTAIN_SHARE * tree.bounds.size().length();
    let Filled {
        added,
        triangles,
        boundary,
        bridges,
        left_out,
    } = fill_between(&section.points, &loops, &section.open, uncertain, |at| {
        rule.holds(tree.winding(plane.point(at) - centre).round() as i32)
    });
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
