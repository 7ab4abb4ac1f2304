//! The region that loops enclose, in triangles.
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
use spade::Triangulation;

use super::outline::{ConstrainedMesh, Edge, FillRegion, LoopTriangulation, is_first};

/// Rounds in which crossing edges are cut. A star of 60 edges that all pass near its middle takes 40.
const ROUNDS: usize = 64;
/// Maximum number of edge parts drawn in all rounds together; drawing that many takes a few seconds.
const MOST_DRAWN: usize = 8_000_000;

/// A filled region. Point numbers run through the given points, then through `added`.
#[derive(Debug, Default)]
pub(super) struct Filled {
    /// Crossing points of loops.
    pub(super) added: Vec<DVec2>,
    /// Triangles, counter-clockwise.
    pub(super) triangles: Vec<[u32; 3]>,
    /// Edges with the region only on their left.
    pub(super) boundary: Vec<[u32; 2]>,
    /// Loops left out of the result.
    pub(super) left_out: Vec<usize>,
}

/// Fills the faces whose winding number satisfies `holds`. Points must be finite.
pub(super) fn fill(points: &[DVec2], loops: &[Vec<u32>], holds: impl Fn(i32) -> bool) -> Filled {
    let mut outline = FillRegion::of(points, loops);
    match preclassified(&mut outline) {
        Some(drawn) => outline.filled(&drawn.mesh, holds),
        None => Filled {
            left_out: outline.left_out.into_iter().collect(),
            ..Filled::default()
        },
    }
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
    /// Selects the faces that satisfy the rule.
    fn filled(self, mesh: &LoopTriangulation, holds: impl Fn(i32) -> bool) -> Filled {
        let windings = windings(mesh);
        let is_in = |face: usize| holds(windings[face]);
        let mut filled = Filled {
            added: self.added,
            left_out: self.left_out.into_iter().collect(),
            ..Filled::default()
        };
        for face in mesh.inner_faces().filter(|f| is_in(f.fix().index())) {
            filled
                .triangles
                .push(face.vertices().map(|v| v.data().number));
            let edges = face.adjacent_edges().into_iter();
            let outline = edges.filter(|e| !is_in(e.rev().face().fix().index()));
            let numbers = outline.map(|e| e.vertices().map(|v| v.data().number));
            filled.boundary.extend(numbers);
        }
        filled
    }
}
