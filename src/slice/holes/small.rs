//! Small holes: the filling with the least total area of triangles.
//!
//! The least area between two rim vertices is that of the triangle on the edge between them plus the least areas on its other two sides,
//! minimised over the triangle's third vertex (dynamic programming).
//!
//! Cost: cubic in the edges in time, quadratic in memory.

use super::{MOST_EDGES, SMALL_EDGES, SMALL_SHARE, perimeter, points_of};
use crate::scene::Mesh;

/// Returns true if this module closes a hole.
pub(super) fn is_small(mesh: &Mesh, rim: &[u32], diagonal: f64) -> bool {
    let is_short = || perimeter(&points_of(mesh, rim)) <= SMALL_SHARE * diagonal;
    rim.len() <= SMALL_EDGES || (rim.len() <= MOST_EDGES && is_short())
}

/// The triangles within a rim that need no edge that is already taken; `None` if there are none.
pub(super) fn triangles(
    mesh: &Mesh,
    rim: &[u32],
    is_taken: impl Fn([u32; 2]) -> bool,
) -> Option<Vec<[u32; 3]>> {
    let count = rim.len();
    let points = points_of(mesh, rim);
    // Least area between two vertices, and the third vertex of the triangle on the edge between them.
    let mut least = vec![(f64::INFINITY, 0); count * count];
    for from in 0..count - 1 {
        least[from * count + from + 1].0 = 0.0;
    }
    for span in 2..count {
        for from in 0..count - span {
            let to = from + span;
            let is_rim = span == count - 1;
            if !is_rim && is_taken([rim[from], rim[to]]) {
                continue;
            }
            let mut best = (f64::INFINITY, 0);
            for between in from + 1..to {
                let sides = least[from * count + between].0 + least[between * count + to].0;
                if sides >= best.0 {
                    continue;
                }
                let [a, b, c] = [from, between, to].map(|i| points[i]);
                let area = sides + 0.5 * (b - a).cross(c - a).length();
                if area < best.0 {
                    best = (area, between);
                }
            }
            least[from * count + to] = best;
        }
    }
    if least[count - 1].0.is_infinite() {
        return None;
    }
    let mut triangles = Vec::with_capacity(count - 2);
    let mut left = vec![[0, count - 1]];
    while let Some([from, to]) = left.pop() {
        if to - from < 2 {
            continue;
        }
        let between = least[from * count + to].1;
        triangles.push([from, between, to].map(|i| rim[i]));
        left.extend([[from, between], [between, to]]);
    }
    Some(triangles)
}
