//! The mesh made ready to be cut again and again, and one cut of it.

use std::sync::Arc;

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::capped::in_world;
use super::fill::{Filled, fill};
use super::loops::{Curves, Piece, join};
use super::plane::is_within;
use super::{Loop, Section, SectionDefect, SlicePlane};
use crate::scene::tree::{BRANCHES, Tree, sort};
use crate::scene::{Bounds, Fill, Part, Side};

/// A mesh with a tree over its triangles. Building it looks at every triangle, a section only at those near the plane.
#[derive(Debug)]
pub struct Slicer {
    positions: Arc<Vec<DVec3>>,
    /// Those that can be computed with, in the order of the tree.
    triangles: Vec<[u32; 3]>,
    tree: Tree,
    /// Triangles left out.
    unusable: usize,
}

impl Slicer {
    /// Makes a mesh ready. Any triangles will do: what cannot be computed with is left out and reported by every section.
    pub fn new(positions: impl Into<Arc<Vec<DVec3>>>, triangles: &[[u32; 3]]) -> Self {
        let positions = positions.into();
        let is_usable = |t: &[u32; 3]| {
            t.iter()
                .all(|i| positions.get(*i as usize).is_some_and(|p| is_within(*p)))
        };
        let mut usable: Vec<[u32; 3]> = triangles
            .par_iter()
            .copied()
            .filter(|t| is_usable(t))
            .collect();
        sort(&positions, &mut usable);
        Self {
            tree: Tree::over(&positions, &usable),
            unusable: triangles.len() - usable.len(),
            triangles: usable,
            positions,
        }
    }

    /// Makes a part ready as it stands in the world, in its pose.
    pub fn of_part(part: &Part) -> Self {
        let mesh = in_world(&part.posed_mesh(), &part.world_from_part);
        Self::new(mesh.positions, &mesh.triangles)
    }

    /// The section by a plane, of the points that an odd number of crossings encloses.
    pub fn section(&self, plane: &SlicePlane) -> Section {
        self.section_by(plane, Fill::EvenOdd)
    }

    /// The section by a plane, of the points that the mesh encloses by a rule.
    pub fn section_by(&self, plane: &SlicePlane, rule: Fill) -> Section {
        let mut section = Section::default();
        if self.unusable > 0 {
            section.defects.push(SectionDefect::Unusable {
                triangles: self.unusable,
            });
        }
        if !plane.is_usable() {
            section.defects.push(SectionDefect::Plane);
            return section;
        }
        let pieces = self.pieces(plane);
        let Curves {
            points,
            loops,
            open,
            turned,
        } = join(&pieces, |edge| self.crossing(plane, edge));
        let Filled {
            added,
            triangles,
            boundary,
            left_out,
        } = fill(&points, &loops, |winding| rule.holds(winding));

        let at = |p: DVec2| plane.point(p);
        let mut tell = |defect| section.defects.push(defect);
        if let Some(end) = open.first().and_then(|chain| chain.first()) {
            tell(SectionDefect::Open {
                chains: open.len(),
                at: at(points[*end as usize]),
            });
        }
        if turned > 0 {
            tell(SectionDefect::Turned { pieces: turned });
        }
        if let Some(first) = added.first() {
            tell(SectionDefect::Crossing {
                crossings: added.len(),
                at: at(*first),
            });
        }
        if let Some(first) = left_out.first() {
            tell(SectionDefect::LeftOut {
                loops: left_out.len(),
                at: at(points[loops[*first][0] as usize]),
            });
        }
        section.points = points;
        section.points.extend(added);
        section.loops = loops.into_iter().map(|points| Loop { points }).collect();
        section.open = open;
        section.triangles = triangles;
        section.boundary = boundary;
        section
    }

    /// The triangles that lie in a plane, with the solid above them, by their corners: they are in the section, and in no cap, for what
    /// is seen there is the face itself.
    pub fn faces_in(&self, plane: &SlicePlane) -> Vec<[DVec3; 3]> {
        let groups = self.tree.groups(|b: &Bounds| plane.misses(b));
        let corners = |t: &[u32; 3]| t.map(|i| self.positions[i as usize]);
        let of_group = |group: &usize| {
            let first = group * BRANCHES;
            let last = (first + BRANCHES).min(self.triangles.len());
            let near = self.triangles[first..last].iter().map(corners);
            near.filter_map(|c| Some((plane.side_of_face(c)?, c)))
        };
        let found: Vec<_> = groups.par_iter().flat_map_iter(of_group).collect();
        if found.is_empty() {
            return Vec::new();
        }
        let volumes = self.triangles.par_iter().map(|t| {
            let [a, b, c] = corners(t);
            a.dot(b.cross(c))
        });
        let solid_above = match volumes.sum::<f64>() < 0.0 {
            true => Side::Removed,
            false => Side::Kept,
        };
        let faces = found.into_iter().filter(|(side, _)| *side == solid_above);
        faces.map(|(_, corners)| corners).collect()
    }

    /// The pieces that crossed triangles make, in the order of the tree.
    fn pieces(&self, plane: &SlicePlane) -> Vec<Piece> {
        let groups = self.tree.groups(|b: &Bounds| plane.misses(b));
        let of_group = |group: &usize| {
            let first = group * BRANCHES;
            let last = (first + BRANCHES).min(self.triangles.len());
            let triangles = self.triangles[first..last].iter();
            triangles.filter_map(|t| self.piece(plane, *t))
        };
        groups
            .par_iter()
            .with_min_len(256)
            .flat_map_iter(of_group)
            .collect()
    }

    /// From the edge in which a triangle goes down, in its own order, to that in which it goes up: then the inner side is left.
    fn piece(&self, plane: &SlicePlane, triangle: [u32; 3]) -> Option<Piece> {
        let above = triangle.map(|i| plane.is_above(self.positions[i as usize]));
        if above[0] == above[1] && above[1] == above[2] {
            return None;
        }
        let [mut down, mut up] = [[0; 2]; 2];
        for (i, j) in [(0, 1), (1, 2), (2, 0)] {
            let edge = [triangle[i], triangle[j]];
            match (above[i], above[j]) {
                (true, false) => down = edge,
                (false, true) => up = edge,
                _ => {}
            }
        }
        let [from, to] = [down, up].map(|[a, b]| [a.min(b), a.max(b)]);
        // A triangle that has a vertex twice goes down and up in one edge, and joins nothing.
        (from != to).then_some(Piece { from, to })
    }

    /// Where a crossed edge meets the plane. Computed from the lesser of its ends, so that edges that are equal in all
    /// coordinates are equal here.
    fn crossing(&self, plane: &SlicePlane, edge: [u32; 2]) -> DVec2 {
        let [mut a, mut b] = edge.map(|i| self.positions[i as usize]);
        if b.to_array() < a.to_array() {
            (a, b) = (b, a);
        }
        let [height_a, height_b] = [a, b].map(|p| plane.height(p).abs());
        let [at_a, at_b] = [a, b].map(|p| plane.coordinates(p));
        // Shares of the way from either end: at most 1, and 0 exactly where that end is on the plane. From the nearer end.
        let at = if height_a <= height_b {
            at_a + (at_b - at_a) * share(height_a, height_b)
        } else {
            at_b + (at_a - at_b) * share(height_b, height_a)
        };
        // Adding zero leaves only one zero, which equality and order then tell apart from nothing.
        at.clamp(at_a.min(at_b), at_a.max(at_b)) + DVec2::ZERO
    }
}

/// `near / (near + far)` where the sum may be too large; 0 for two zeros.
pub(super) fn share(near: f64, far: f64) -> f64 {
    if near == 0.0 {
        0.0
    } else {
        1.0 / (1.0 + far / near)
    }
}
