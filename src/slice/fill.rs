//! The region that curves enclose, in triangles.
//!
//! The loops are drawn into a triangulation as edges that record how often, and in which direction, they are passed; crossing edges are cut
//! until none cross (see [`super::outline`]). After many rounds, or too many cuts, loops that still cross are left out
//! whole: the rest is closed, so that the winding numbers stay consistent.
//!
//! The winding number is known outside, and changes across an edge by the number of times that the edge is passed.
//! Coincident edges cancel automatically.
//!
//! Cost: n log n in the points for loops that do not cross; every crossing adds a point, and crossings add a few rounds.

use glam::DVec2;
use rayon::prelude::*;
use spade::Triangulation;

use super::outline::{ConstrainedMesh, Edge, FillRegion, LoopTriangulation, is_first};

/// Rounds in which crossing edges are cut. A star of 60 edges that all pass near its middle takes 40.
const ROUNDS: usize = 64;
/// Maximum number of edge parts drawn in all rounds together; drawing that many takes a few seconds.
const MOST_DRAWN: usize = 8_000_000;

/// Rounds in which flat faces follow their neighbours.
const FLAT_ROUNDS: usize = 8;

/// A filled region. Point numbers run through the given points, then through `added`.
#[derive(Debug, Default)]
pub(super) struct Filled {
    /// Crossing points of loops.
    pub(super) added: Vec<DVec2>,
    /// Triangles, counter-clockwise.
    pub(super) triangles: Vec<[u32; 3]>,
    /// Edges with the region only on their left.
    pub(super) boundary: Vec<[u32; 2]>,
    /// Edges of `boundary` that are on no curve.
    pub(super) bridges: Vec<[u32; 2]>,
    /// Curves left out of the result; open ones are counted after the closed.
    pub(super) left_out: Vec<usize>,
}

/// Fills the faces whose winding number satisfies `holds`. Points must be finite.
pub(super) fn fill(points: &[DVec2], loops: &[Vec<u32>], holds: impl Fn(i32) -> bool) -> Filled {
    let mut outline = FillRegion::of(points, loops, &[]);
    let Some(drawn) = preclassified(&mut outline) else {
        return outline.unfilled();
    };
    let windings = windings(&drawn.mesh);
    outline.filled(&drawn.mesh, |face| holds(windings[face]))
}

/// Fills the faces that lie inside by their centroids, in a triangulation of closed and of open curves. Points must be finite.
///
/// Where curves end, the region is bounded by edges of the triangulation, the *bridges*; it does not leave the convex hull of the curves.
/// A face that is no higher than `least`, the distance over which `is_inside` is uncertain, is inside or not so that bridges are short.
pub(super) fn fill_between(
    points: &[DVec2],
    loops: &[Vec<u32>],
    open: &[Vec<u32>],
    least: f64,
    is_inside: impl Fn(DVec2) -> bool + Sync,
) -> Filled {
    let mut outline = FillRegion::of(points, loops, open);
    let Some(drawn) = preclassified(&mut outline) else {
        return outline.unfilled();
    };
    let mut centroids = vec![None; drawn.mesh.num_all_faces()];
    let mut flat = Vec::new();
    for face in drawn.mesh.inner_faces() {
        let corners = face.positions().map(|p| DVec2::new(p.x, p.y));
        match height(corners) * outline.unit > least {
            true => {
                let sum: DVec2 = corners.iter().sum();
                centroids[face.fix().index()] = Some(outline.unit * sum / 3.0);
            }
            false => flat.push(face),
        }
    }
    let centroids = centroids.into_par_iter();
    let mut inside: Vec<bool> = centroids.map(|at| at.is_some_and(&is_inside)).collect();
    for _ in 0..FLAT_ROUNDS {
        let before = inside.clone();
        for face in &flat {
            let mut length_if = [0.0; 2];
            let edges = face.adjacent_edges().into_iter();
            for edge in edges.filter(|e| !e.is_constraint_edge()) {
                let neighbour = inside[edge.rev().face().fix().index()];
                length_if[usize::from(!neighbour)] += edge.length_2().sqrt();
            }
            inside[face.fix().index()] = length_if[1] < length_if[0];
        }
        if inside == before {
            break;
        }
    }
    outline.filled(&drawn.mesh, |face| inside[face])
}

/// The least height of a triangle.
fn height([a, b, c]: [DVec2; 3]) -> f64 {
    let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
    (b - a).perp_dot(c - a).abs() / longest
}

/// Draws an outline, whose edges are cut until none cross; loops that still cross are left out. None if nothing is left.
pub(super) fn preclassified(outline: &mut FillRegion) -> Option<ConstrainedMesh> {
    let (mut round, mut parts_drawn) = (0, 0);
    while !outline.parts.is_empty() {
        let Some(drawn) = outline.draw() else {
            // Unreachable, because coordinates are in range. Without a triangulation nothing is filled.
            let all: Vec<usize> = (0..outline.parts.len()).collect();
            outline.leave_out(&all);
            return None;
        };
        if drawn.failed.is_empty() {
            return Some(drawn);
        }
        round += 1;
        parts_drawn += outline.parts.len();
        let is_enough = round > ROUNDS || parts_drawn > MOST_DRAWN;
        if is_enough || !outline.cut(&drawn) {
            outline.leave_out(&drawn.failed);
        }
    }
    None
}

/// Winding number of the loops around each face of a triangulation.
pub(super) fn windings(mesh: &LoopTriangulation) -> Vec<i32> {
    let mut windings: Vec<Option<i32>> = vec![None; mesh.num_all_faces()];
    let outer = mesh.outer_face().fix().index();
    windings[outer] = Some(0);
    let passed = |edge: &Edge<'_>| {
        let net = edge.as_undirected().data().data().net;
        if is_first(edge.fix()) { net } else { -net }
    };
    let mut reached: Vec<(Edge<'_>, i32)> = (mesh.convex_hull())
        .map(|hull| (hull.rev(), passed(&hull.rev())))
        .collect();
    while let Some((edge, winding)) = reached.pop() {
        let face = &mut windings[edge.face().fix().index()];
        if face.is_some() {
            continue;
        }
        *face = Some(winding);
        reached.extend([edge.next(), edge.prev()].map(|e| {
            let across = e.rev();
            (across, winding + passed(&across))
        }));
    }
    windings
        .into_iter()
        .map(Option::unwrap_or_default)
        .collect()
}

impl FillRegion {
    /// The region without a triangulation.
    fn unfilled(self) -> Filled {
        Filled {
            added: self.added,
            left_out: self.left_out.into_iter().collect(),
            ..Filled::default()
        }
    }

    /// Selects faces by their indices.
    fn filled(self, mesh: &LoopTriangulation, is_in: impl Fn(usize) -> bool) -> Filled {
        let mut filled = self.unfilled();
        for face in mesh.inner_faces().filter(|f| is_in(f.fix().index())) {
            let numbers = face.vertices().map(|v| v.data().number);
            filled.triangles.push(numbers);
            for edge in face.adjacent_edges() {
                if is_in(edge.rev().face().fix().index()) {
                    continue;
                }
                let numbers = edge.vertices().map(|v| v.data().number);
                filled.boundary.push(numbers);
                if !edge.is_constraint_edge() {
                    filled.bridges.push(numbers);
                }
            }
        }
        filled
    }
}
