//! The cap that closes the opening left by a plane.
//!
//! The outline consists of the directed edges in the plane, from all faces above it, that do not cancel. Its curves are those of a
//! [`Section`](crate::slice::Section), and the cap covers each point as often as they wind around it: the mesh's winding number
//! at each point is unchanged on the kept side and becomes 0 on the other. So every fill rule finds in the rest of the mesh
//! the solid that it found in the whole mesh, and halves add up to the whole, even if shells overlap. Overlapping bodies are capped one by
//! one ([`groups`](super::groups)).
//!
//! If faces disagree about which side is outside, there is no winding number, but a closed mesh has a parity: the cap then covers once
//! the points around which curves wind an odd number of times.
//!
//! Cost: n log n in the points of the outline, plus a pass over all faces if loops cross or vertices coincide.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3};

use super::super::SectionDefect;
use super::super::cover::{Cover, cover};
use super::super::loops::{self, Curves, join};
use super::complex::{CAP, Complex, ComplexFace, FaceState, MarkedPlane, Splits};
use crate::scene::meshes::weld::has_three;

/// A candidate face's use of an edge in a plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct PlaneUse {
    /// Group of the candidate.
    group: u32,
    /// The ends, lesser first.
    ends: [u32; 2],
    /// True if the edge is used from the greater to the lesser end.
    is_down: bool,
    /// True if the face is above the plane.
    is_above: bool,
}

impl PlaneUse {
    pub(super) fn new([from, to]: [u32; 2], is_above: bool, group: u32) -> Self {
        Self {
            group,
            ends: [from.min(to), from.max(to)],
            is_down: from > to,
            is_above,
        }
    }
}

/// An edge of an outline.
#[derive(Clone, Copy, Debug)]
pub(super) struct CapEdge {
    /// Group of the adjacent faces.
    pub(super) group: u32,
    ends: [u32; 2],
    /// True if the adjacent faces agree on the outward side.
    is_oriented: bool,
}

/// Edges of the faces above a plane that do not cancel, group by group.
pub(super) fn pieces(mut uses: Vec<PlaneUse>) -> Vec<CapEdge> {
    uses.sort_unstable();
    let mut pieces = Vec::new();
    for run in uses.chunk_by(|a, b| (a.group, a.ends) == (b.group, b.ends)) {
        let net = |all: bool| -> i32 {
            let counted = run.iter().filter(|u| all || u.is_above);
            counted.map(|u| if u.is_down { -1 } else { 1 }).sum()
        };
        let above = run.iter().filter(|u| u.is_above).count();
        let (net_above, is_oriented) = (net(false), net(true) == 0);
        let count = match is_oriented {
            true => net_above.unsigned_abs() as usize,
            false => above % 2,
        };
        let group = run[0].group;
        let [low, high] = run[0].ends;
        let ends = if net_above < 0 {
            [high, low]
        } else {
            [low, high]
        };
        let piece = CapEdge {
            group,
            ends,
            is_oriented,
        };
        pieces.extend(std::iter::repeat_n(piece, count));
    }
    pieces
}

impl Complex<'_> {
    /// Closes a group's candidates, which are below a plane, with a cap along their outline.
    pub(super) fn cap(&mut self, number: usize, pieces: &[CapEdge]) {
        let Some(group) = pieces.first().map(|piece| piece.group) else {
            return;
        };
        let MarkedPlane { plane, mark } = self.planes[number];
        let plane = plane.seen_from(self.middle);
        let halves: Vec<loops::CutSegment> = (pieces.iter())
            .map(|p| {
                let [from, to] = p.ends.map(|v| [v, v]);
                loops::CutSegment { from, to }
            })
            .collect();
        // Adding zero turns -0 into +0.
        let place = |v: u32| plane.coordinates(self.positions[v as usize]) + DVec2::ZERO;
        let Curves {
            points,
            loops,
            open,
            turned,
        } = join(&halves, |[v, _]| place(v));
        let number_of = |at: DVec2| {
            let is_before = |p: &DVec2| p.x.total_cmp(&at.x).then(p.y.total_cmp(&at.y)).is_lt();
            points.partition_point(is_before)
        };
        let mut vertices: Vec<(usize, u32)> = (pieces.iter().flat_map(|p| p.ends))
            .map(|v| (number_of(place(v)), v))
            .collect();
        vertices.sort_unstable();
        vertices.dedup();
        // The first of several coincident vertices stands for all.
        let mut vertex_of = vec![u32::MAX; points.len()];
        for (number, vertex) in vertices.iter().rev() {
            vertex_of[*number] = *vertex;
        }
        let Cover {
            added,
            stand_ins,
            triangles,
            paths,
            left_out,
        } = cover(&points, &loops);
        self.tell(&open, turned, |i| plane.point(points[i as usize]));
        if let Some(first) = added.first() {
            let (crossings, at) = (added.len(), plane.point(*first));
            self.defects.push(SectionDefect::Crossing { crossings, at });
        }
        if let Some(first) = left_out.first() {
            let at = plane.point(points[loops[*first][0] as usize]);
            self.defects.push(SectionDefect::LeftOut {
                loops: left_out.len(),
                at,
            });
        }
        let moved: BTreeMap<u32, u32> = (vertices.iter())
            .map(|(number, vertex)| (*vertex, vertex_of[stand_ins[*number] as usize]))
            .filter(|(from, to)| from != to)
            .collect();
        self.merge(&moved);
        for at in added {
            let vertex = self.add(plane.preclassified(plane.point(at)), mark);
            vertex_of.push(vertex);
        }
        self.pass(paths, &vertex_of);
        let is_oriented = turned == 0 && pieces.iter().all(|p| p.is_oriented);
        let caps = triangles.into_iter().flat_map(|(corners, winding)| {
            let mut corners = corners.map(|i| vertex_of[i as usize]);
            if winding < 0 {
                corners.swap(1, 2);
            }
            let count = match is_oriented {
                true => winding.unsigned_abs(),
                false => winding.unsigned_abs() % 2,
            };
            let face = ComplexFace {
                corners,
                source: CAP | number as u32,
                state: FaceState::Candidate,
                group,
            };
            std::iter::repeat_n(face, count as usize)
        });
        self.faces.extend(caps);
    }

    fn tell(&mut self, open: &[Vec<u32>], turned: usize, at: impl Fn(u32) -> DVec3) {
        if let Some(end) = open.first().and_then(|chain| chain.first()) {
            self.defects.push(SectionDefect::Open {
                chains: open.len(),
                at: at(*end),
            });
        }
        if turned > 0 {
            self.defects.push(SectionDefect::Turned { pieces: turned });
        }
    }

    /// Merges vertices into the ones that replace them.
    fn merge(&mut self, moved: &BTreeMap<u32, u32>) {
        if moved.is_empty() {
            return;
        }
        let mut to: Vec<u32> = (0..self.positions.len() as u32).collect();
        for (from, into) in moved {
            to[*from as usize] = *into;
        }
        for face in &mut self.faces {
            face.corners = face.corners.map(|i| to[i as usize]);
        }
        self.faces.retain(|f| has_three(&f.corners));
    }

    /// Divides faces at points through which edges of the outline pass between their ends.
    fn pass(&mut self, paths: Vec<Vec<u32>>, vertex_of: &[u32]) {
        let mut splits = Splits::new();
        for path in paths {
            let mut path: Vec<u32> = path.into_iter().map(|i| vertex_of[i as usize]).collect();
            if path.first() > path.last() {
                path.reverse();
            }
            let [first, between @ .., last] = &path[..] else {
                continue;
            };
            let both = self.marks[*first as usize] & self.marks[*last as usize];
            for vertex in between {
                self.marks[*vertex as usize] |= both;
            }
            splits
                .entry([*first, *last])
                .or_insert_with(|| between.to_vec());
        }
        self.divide(&splits);
    }
}
