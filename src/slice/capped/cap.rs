//! The cap that closes what a plane leaves open.
//!
//! The outline is what the directed edges in the plane, of all faces above it, do not cancel among themselves. Its curves are those of a
//! [`Section`](crate::slice::Section), and the cap covers what they wind around, each point as often as they do: the winding number
//! of the mesh at each point stays what it was on the kept side and becomes 0 on the other. So any fill rule finds in what is left
//! the solid that it found in the mesh, and halves add up to the whole, also where shells overlap. Bodies that overlap are capped one by
//! one ([`groups`](super::groups)).
//!
//! Where faces do not agree which side is out there is no winding number, but for a closed mesh its parity: the cap is then where curves
//! wind an odd number of times, once.
//!
//! Cost: n log n in the points of the outline; with a look at all faces where loops cross or vertices coincide.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3};

use super::super::SectionDefect;
use super::super::cover::{Cover, cover};
use super::super::loops::{self, Curves, join};
use super::complex::{CAP, Complex, ComplexFace, MarkedPlane, Splits, State};
use crate::scene::meshes::weld::has_three;

/// A use of an edge in a plane by a candidate.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct PlaneUse {
    /// Group of the candidate.
    group: u32,
    /// The lesser first.
    ends: [u32; 2],
    /// From the greater to the lesser.
    is_down: bool,
    /// By a face above the plane.
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
pub(super) struct Piece {
    /// Group of the adjacent faces.
    pub(super) group: u32,
    ends: [u32; 2],
    /// True if the adjacent faces agree on the outward side.
    is_oriented: bool,
}

/// Edges that the faces above a plane do not cancel, group by group.
pub(super) fn pieces(mut uses: Vec<PlaneUse>) -> Vec<Piece> {
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
        let piece = Piece {
            group,
            ends,
            is_oriented,
        };
        pieces.extend(std::iter::repeat_n(piece, count));
    }
    pieces
}

impl Complex<'_> {
    /// Closes the candidates of a group at a plane, below which they are, along their outline.
    pub(super) fn cap(&mut self, number: usize, pieces: &[Piece]) {
        let Some(group) = pieces.first().map(|piece| piece.group) else {
            return;
        };
        let MarkedPlane { plane, mark } = self.planes[number];
        let plane = plane.seen_from(self.middle);
        let halves: Vec<loops::Piece> = (pieces.iter())
            .map(|p| {
                let [from, to] = p.ends.map(|v| [v, v]);
                loops::Piece { from, to }
            })
            .collect();
        // Adding zero leaves only one zero.
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
        // Of vertices in one place the first stands for all.
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
                state: State::Candidate,
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

    /// Puts vertices in the places of others.
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

    /// Divides faces where edges of the outline pass other points than their ends.
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
