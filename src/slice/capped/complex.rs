//! Triangles divided by planes that stay one surface: the faces of a mesh and the caps of the regions removed from it.
//!
//! # Invariant
//!
//! The kept faces, taken as a sum of oriented triangles, have the same boundary as the mesh: in a closed mesh each
//! directed edge occurs as often as its opposite. Only three operations are applied, and none changes that:
//!
//! - an edge gets new vertices, and all faces with this edge are divided there, whatever their state;
//! - vertices are merged, and triangles that then have a vertex twice are dropped;
//! - a closed surface is subtracted: everything in a convex region, with the caps of its planes. Its caps stay, reversed.
//!
//! So walls between touching regions cancel automatically, and whether the result is closed does not depend on coordinates.
//!
//! # Sides
//!
//! The sign of a vertex is exact ([`SlicePlane::is_above`]); a vertex made on a plane counts as on it, whatever its rounded coordinates
//! are. Only an edge between both sides is crossed, in one new vertex, computed from the lesser end by coordinates. A triangle in
//! the plane is assigned to the side of the solid behind it: no face is doubled by a cap, and nothing without thickness remains.
//!
//! Cost: for each plane a parallel pass over all vertices and faces, and sorts of the elements it meets.

use std::collections::HashMap;

use glam::DVec3;
use rayon::prelude::*;

use super::super::slicer::share;
use super::super::{SectionDefect, SlicePlane};
use super::cap::{CapEdge, PlaneUse, pieces};
use super::groups::groups;
use crate::scene::meshes::weld::has_three;
use crate::scene::{Bounds, FacesInPlane, Mesh, Side};

/// State of a face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FaceState {
    /// A face of the kept half.
    Kept,
    /// A face that may lie in the region that is being removed.
    Candidate,
    /// A face of the removed half that comes from the mesh.
    Removed,
    /// A cap that is no longer needed.
    Gone,
}

/// A triangle, or part of one, of the mesh or of a cap.
#[derive(Clone, Copy, Debug)]
pub(super) struct ComplexFace {
    pub(super) corners: [u32; 3],
    /// Number of the mesh triangle; for a cap, [`CAP`] and the number of its plane.
    pub(super) source: u32,
    pub(super) state: FaceState,
    /// The group of bodies with which it is capped ([`groups`]).
    pub(super) group: u32,
}

/// Marks the source of a cap.
pub(super) const CAP: u32 = 1 << 31;

impl ComplexFace {
    /// The plane that it caps.
    pub(super) fn plane(&self) -> Option<usize> {
        (self.source & CAP != 0).then_some((self.source & !CAP) as usize)
    }
}

/// A plane, and the mark of the vertices made on it; equal planes share one mark.
#[derive(Clone, Copy, Debug)]
pub(super) struct MarkedPlane {
    pub(super) plane: SlicePlane,
    pub(super) mark: u64,
}

/// Vertices to insert on edges, keyed by the edge's ends, lesser first, and ordered from the lesser end.
pub(super) type Splits = HashMap<[u32; 2], Vec<u32>>;

/// Triangles that planes divide, as described in the module documentation.
pub(super) struct Complex<'a> {
    /// Mesh that planes divide.
    pub(super) mesh: &'a Mesh,
    pub(super) planes: Vec<MarkedPlane>,
    pub(super) positions: Vec<DVec3>,
    /// Marks of the planes on which each vertex was made.
    pub(super) marks: Vec<u64>,
    pub(super) faces: Vec<ComplexFace>,
    pub(super) defects: Vec<SectionDefect>,
    /// A point near the mesh.
    pub(super) middle: DVec3,
    pub(super) is_inside_out: bool,
    /// The faces in each plane, if these were decided beforehand.
    pub(super) in_planes: Vec<FacesInPlane>,
}

impl<'a> Complex<'a> {
    /// All usable triangles of a mesh, as kept faces.
    pub(super) fn new(
        mesh: &'a Mesh,
        planes: &[SlicePlane],
        is_usable: impl Fn(usize) -> bool,
    ) -> Self {
        let usable: Vec<(usize, [u32; 3])> = (mesh.triangles.iter().copied().enumerate())
            .filter(|(i, _)| is_usable(*i))
            .collect();
        let corners: Vec<[u32; 3]> = usable.iter().map(|(_, t)| *t).collect();
        let faces: Vec<ComplexFace> = (usable.iter().zip(groups(mesh, &corners)))
            .map(|((i, t), group)| ComplexFace {
                corners: *t,
                source: *i as u32,
                state: FaceState::Kept,
                group,
            })
            .collect();
        let corners = |f: &ComplexFace| f.corners.map(|i| mesh.positions[i as usize]);
        let bounds = (faces.par_iter().with_min_len(1 << 14))
            .map(|f| Bounds::from_points(corners(f)))
            .reduce(|| Bounds::EMPTY, Bounds::union);
        let middle = if faces.is_empty() {
            DVec3::ZERO
        } else {
            bounds.centre()
        };
        let volume: f64 = (faces.iter())
            .map(|f| {
                let [a, b, c] = corners(f).map(|p| p - middle);
                a.dot(b.cross(c))
            })
            .sum();
        Self {
            mesh,
            planes: marked(planes),
            positions: mesh.positions.clone(),
            marks: vec![0; mesh.positions.len()],
            faces,
            defects: Vec::new(),
            middle,
            is_inside_out: volume < 0.0,
            in_planes: Vec::new(),
        }
    }

    /// Removes everything that lies below all planes of a range.
    pub(super) fn remove(&mut self, region: std::ops::Range<usize>) {
        for face in self.faces.iter_mut().filter(|f| f.state == FaceState::Kept) {
            face.state = FaceState::Candidate;
        }
        for plane in region.clone() {
            let pieces = self.cut(plane, region.start);
            for of_group in pieces.chunk_by(|a, b| a.group == b.group) {
                self.cap(plane, of_group);
            }
            if !self.faces.iter().any(|f| f.state == FaceState::Candidate) {
                break;
            }
        }
        for face in self
            .faces
            .iter_mut()
            .filter(|f| f.state == FaceState::Candidate)
        {
            face.state = match face.plane() {
                None => FaceState::Removed,
                Some(plane) if region.contains(&plane) => {
                    face.corners.swap(1, 2);
                    FaceState::Kept
                }
                Some(_) => FaceState::Gone,
            };
        }
        self.faces.retain(|f| f.state != FaceState::Gone);
    }

    /// Divides the candidates by a plane, and keeps those above. Returns the outline to be capped: directed edges with the solid on
    /// their left, seen from above. Caps of planes from `first` on belong to the region itself, and end at the plane.
    fn cut(&mut self, plane: usize, first: usize) -> Vec<CapEdge> {
        let in_plane = self.in_planes.get(plane).cloned().unwrap_or_default();
        let MarkedPlane { plane, mark } = self.planes[plane];
        let mut sides: Vec<i8> = (self.positions.par_iter().zip(&self.marks))
            .with_min_len(1 << 12)
            .map(|(p, on)| match on & mark {
                0 => side(&plane, *p),
                _ => 0,
            })
            .collect();
        let is_crossed = |f: &ComplexFace| {
            let of = f.corners.map(|i| sides[i as usize]);
            f.state == FaceState::Candidate && of.contains(&1) && of.contains(&-1)
        };
        let crossed: Vec<[u32; 3]> = (self.faces.par_iter().with_min_len(1 << 12))
            .filter(|f| is_crossed(f))
            .map(|f| f.corners)
            .collect();
        let mut splits = Splits::new();
        for [a, b, c] in crossed {
            for [from, to] in [[a, b], [b, c], [c, a]] {
                if sides[from as usize] * sides[to as usize] < 0 {
                    let ends = [from.min(to), from.max(to)];
                    (splits.entry(ends)).or_insert_with(|| vec![self.crossing(&plane, mark, ends)]);
                }
            }
        }
        self.divide(&splits);
        sides.resize(self.positions.len(), 0);

        let mut uses = Vec::new();
        for face in self
            .faces
            .iter_mut()
            .filter(|f| f.state == FaceState::Candidate)
        {
            let of = face.corners.map(|i| sides[i as usize]);
            let corners = || face.corners.map(|i| self.positions[i as usize]);
            let is_above = match of.iter().find(|s| **s != 0) {
                Some(side) => *side > 0,
                None if in_plane.side(face.source).is_some() => {
                    in_plane.side(face.source) == Some(Side::Kept)
                }
                None => {
                    let [a, b, c] = corners();
                    let up = (b - a).cross(c - a).dot(plane.frame.normal);
                    if self.is_inside_out {
                        up > 0.0
                    } else {
                        up < 0.0
                    }
                }
            };
            for i in 0..3 {
                let j = (i + 1) % 3;
                if of[i] == 0 && of[j] == 0 {
                    let ends = [face.corners[i], face.corners[j]];
                    uses.push(PlaneUse::new(ends, is_above, face.group));
                }
            }
            if is_above {
                let is_of_region = face.plane().is_some_and(|p| p >= first);
                face.state = match is_of_region {
                    true => FaceState::Gone,
                    false => FaceState::Kept,
                };
            }
        }
        pieces(uses)
    }

    /// A new vertex where a plane crosses an edge.
    fn crossing(&mut self, plane: &SlicePlane, mark: u64, ends: [u32; 2]) -> u32 {
        let [mut a, mut b] = ends.map(|i| self.positions[i as usize]);
        if b.to_array() < a.to_array() {
            (a, b) = (b, a);
        }
        let [height_a, height_b] = [a, b].map(|p| plane.height(p).abs());
        let at = if height_a <= height_b {
            a + (b - a) * share(height_a, height_b)
        } else {
            b + (a - b) * share(height_b, height_a)
        };
        let marks = self.marks[ends[0] as usize] & self.marks[ends[1] as usize] | mark;
        self.add(plane.preclassified(at.clamp(a.min(b), a.max(b))), marks)
    }

    /// A new vertex.
    pub(super) fn add(&mut self, at: DVec3, marks: u64) -> u32 {
        self.positions.push(at);
        self.marks.push(marks);
        self.positions.len() as u32 - 1
    }

    /// Divides all faces that have any of the split edges.
    pub(super) fn divide(&mut self, splits: &Splits) {
        if splits.is_empty() {
            return;
        }
        let mut is_end = vec![false; self.positions.len()];
        for ends in splits.keys().flatten() {
            is_end[*ends as usize] = true;
        }
        let on = |from: u32, to: u32| -> Vec<u32> {
            match splits.get(&[from.min(to), from.max(to)]) {
                Some(all) if from < to => all.clone(),
                Some(all) => all.iter().rev().copied().collect(),
                None => Vec::new(),
            }
        };
        let has_end =
            |f: &ComplexFace| f.corners.iter().filter(|i| is_end[**i as usize]).count() > 1;
        let near: Vec<usize> = (self.faces.par_iter().enumerate().with_min_len(1 << 12))
            .filter(|(_, f)| has_end(f))
            .map(|(i, _)| i)
            .collect();
        let mut parts = Vec::new();
        for index in near {
            let face = self.faces[index];
            let [a, b, c] = face.corners;
            parts.clear();
            divided(
                &self.positions,
                [a, b, c],
                [on(a, b), on(b, c), on(c, a)],
                &mut parts,
            );
            // Parts with a repeated vertex have no area and bound nothing; they arise where a vertex lies on a side of its own triangle.
            let mut parts = (parts.iter().filter(|t| has_three(t))).map(|corners| ComplexFace {
                corners: *corners,
                ..face
            });
            match parts.next() {
                Some(first) => self.faces[index] = first,
                None => self.faces[index].state = FaceState::Gone,
            }
            self.faces.extend(parts);
        }
    }
}

/// Triangles between a triangle's corners and the vertices on its sides, in order from each corner to the next. Neighbouring vertices
/// of a corner on two sides are joined: no edge crosses the line between them.
pub(super) fn divided(
    at: &[DVec3],
    corners: [u32; 3],
    sides: [Vec<u32>; 3],
    parts: &mut Vec<[u32; 3]>,
) {
    let [a, b, c] = corners;
    // Of the two diagonals that divide the rest next to a corner, the one with the shorter new edge is used.
    let length = |i: &u32, j: u32| at[*i as usize].distance_squared(at[j as usize]);
    let across = |i: usize| sides[i].first().map(|v| length(v, [c, a, b][i]));
    let first = (0..3)
        .filter_map(|i| Some((i, across(i)?)))
        .min_by(|x, y| x.1.total_cmp(&y.1));
    let [ab, bc, ca] = sides;
    match first {
        None => parts.push([a, b, c]),
        Some((0, _)) => {
            let [first, last] = [ab[0], ab[ab.len() - 1]];
            divided(at, [a, first, c], [Vec::new(), Vec::new(), ca], parts);
            parts.extend(ab.windows(2).map(|w| [w[0], w[1], c]));
            divided(at, [last, b, c], [Vec::new(), bc, Vec::new()], parts);
        }
        Some((1, _)) => divided(at, [b, c, a], [bc, ca, ab], parts),
        Some(_) => divided(at, [c, a, b], [ca, ab, bc], parts),
    }
}

/// Side of a plane on which a point lies: 1 above, 0 on it, -1 below.
fn side(plane: &SlicePlane, point: DVec3) -> i8 {
    let height = plane.signed(point);
    i8::from(height > 0.0) - i8::from(height < 0.0)
}

/// Planes with their marks. From the 65th different plane on, vertices are identified by their coordinates instead of by marks.
fn marked(planes: &[SlicePlane]) -> Vec<MarkedPlane> {
    let mut marked: Vec<MarkedPlane> = Vec::with_capacity(planes.len());
    let mut marks = 0;
    for plane in planes {
        let same = marked.iter().find(|m| m.plane.is_same(plane));
        let mark = same.map(|m| m.mark).unwrap_or_else(|| {
            marks += 1;
            1_u64.checked_shl(marks - 1).unwrap_or(0)
        });
        marked.push(MarkedPlane {
            plane: *plane,
            mark,
        });
    }
    marked
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(parts: &[[u32; 3]], at: &[DVec3]) -> f64 {
        let twice = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|i| at[i as usize]);
            (b - a).cross(c - a).z
        };
        parts.iter().map(|t| 0.5 * twice(t)).sum()
    }

    #[test]
    fn a_triangle_is_divided_at_all_vertices_of_its_sides() {
        let at = [(0, 0), (4, 0), (0, 4), (1, 0), (3, 0), (2, 2), (0, 1)];
        let at = at.map(|(x, y)| DVec3::new(f64::from(x), f64::from(y), 0.0));
        let mut parts = Vec::new();
        let sides = [vec![3, 4], vec![5], vec![6]];
        divided(&at, [0, 1, 2], sides, &mut parts);
        assert_eq!(parts.len(), 5, "one more for each vertex: {parts:?}");
        assert_eq!(area(&parts, &at), 8.0, "{parts:?}");
        assert!(
            parts.iter().all(|t| area(&[*t], &at) > 0.0),
            "none is flat: {parts:?}"
        );
    }

    #[test]
    fn crossings_beside_a_corner_are_joined() {
        let at = [(0, 0), (4, 0), (0, 4), (1, 0), (0, 3), (2, 2)];
        let at = at.map(|(x, y)| DVec3::new(f64::from(x), f64::from(y), 0.0));
        for (sides, [v, w]) in [
            ([vec![3], vec![], vec![4]], [3, 4]),
            ([vec![3], vec![5], vec![]], [3, 5]),
            ([vec![], vec![5], vec![4]], [5, 4]),
        ] {
            let mut parts = Vec::new();
            divided(&at, [0, 1, 2], sides, &mut parts);
            let both = parts.iter().filter(|t| t.contains(&v) && t.contains(&w));
            assert_eq!(both.count(), 2, "{v} and {w} are joined: {parts:?}");
        }
    }
}
