//! Joins vertices that a file stored separately, so that edges have two faces again.
//!
//! STL repeats every corner and glTF splits vertices at normal seams; both tear a closed solid open. A mesh that is
//! closed by its own indices is left unchanged, so two solids that only touch stay separate. Otherwise
//!
//! 1. vertices with equal coordinates become one (`-0.0` equals `0.0`): no point moves;
//! 2. if edges are still open, vertices *of open edges* within 1e-8 of the bounds' diagonal become one at the first one's
//!    position; this is kept only if fewer edges are open afterwards and no edge has become non-manifold.
//!
//! Cost: one parallel sort of the vertices, up to three of the edges.

use std::collections::HashMap;

use glam::DVec3;
use rayon::prelude::*;

use super::topology::{EdgeCount, Edges, Sets};
use crate::scene::Bounds;

/// Distance up to which vertices are joined, as a share of the diagonal. It is a fifth of an f32 step at a coordinate as large as the
/// diagonal, so vertices that f32 distinguishes there stay separate.
const NEAR_SHARE: f64 = 1e-8;

/// Map from old vertices to welded ones.
#[derive(Debug)]
pub struct Weld {
    /// Vertices after welding.
    pub positions: Vec<DVec3>,
    /// New index of every old vertex.
    pub new_from_old: Vec<u32>,
    /// Summary of the changes, for the user.
    pub note: String,
}

/// Welds a mesh with open edges; `None` if there is nothing to join. Indices must be in range, coordinates finite.
pub fn weld(positions: &[DVec3], triangles: &[[u32; 3]]) -> Option<Weld> {
    let open_before = Edges::of(triangles).count().open;
    if open_before == 0 {
        return None;
    }
    let mut new_from_old = joined_where_equal(positions);
    let mut at = places(positions, &new_from_old);
    let welded = moved(triangles, &new_from_old);
    let edges = Edges::of(&welded);
    let equal = edges.count();
    let mut note = (at.len() < positions.len()).then(|| {
        format!(
            "welded {} corners to {} vertices, {}",
            thousands(positions.len()),
            thousands(at.len()),
            closing(open_before, equal.open)
        )
    });
    if equal.open > 0
        && let Some(near) = join_near(&at, &welded, &edges, equal)
    {
        let text = format!(
            "{} pairs within 1e-8 of the size closed {} edges",
            thousands(at.len() - near.vertices),
            thousands(equal.open - near.open)
        );
        note = Some(match note {
            Some(first) => format!("{first}; {text}"),
            None => format!("welded: {text}"),
        });
        let places_before = at;
        new_from_old
            .iter_mut()
            .for_each(|i| *i = near.new_from_old[*i as usize]);
        at = places(&places_before, &near.new_from_old);
    }
    note.map(|note| Weld {
        positions: at,
        new_from_old,
        note,
    })
}

fn closing(before: usize, after: usize) -> String {
    match (before - after.min(before), after) {
        (_, 0) => "which closes it".to_owned(),
        (0, _) => "which closes no edge".to_owned(),
        (closed, left) => format!(
            "which closes {} edges and leaves {} open",
            thousands(closed),
            thousands(left)
        ),
    }
}

/// New indices in order of first appearance; equal coordinates get equal indices.
fn joined_where_equal(positions: &[DVec3]) -> Vec<u32> {
    // Adding 0.0 turns -0.0 into 0.0 and leaves every other number as it is.
    let mut order: Vec<([u64; 3], u32)> = positions
        .par_iter()
        .enumerate()
        .map(|(i, p)| (p.to_array().map(|c| (c + 0.0).to_bits()), i as u32))
        .collect();
    order.par_sort_unstable();
    let mut first = vec![0_u32; positions.len()];
    for same in order.chunk_by(|a, b| a.0 == b.0) {
        for (_, i) in same {
            first[*i as usize] = same[0].1;
        }
    }
    numbered(&first)
}

/// Consecutive new indices for set representatives; each is the smallest member of its set.
fn numbered(first: &[u32]) -> Vec<u32> {
    let mut number = Vec::with_capacity(first.len());
    let mut next = 0;
    for (i, &f) in first.iter().enumerate() {
        if f as usize == i {
            number.push(next);
            next += 1;
        } else {
            number.push(number[f as usize]);
        }
    }
    number
}

/// The position of each new vertex: that of the first old vertex merged into it.
fn places(positions: &[DVec3], new_from_old: &[u32]) -> Vec<DVec3> {
    let mut at = Vec::new();
    for (p, &i) in positions.iter().zip(new_from_old) {
        if i as usize == at.len() {
            at.push(*p);
        }
    }
    at
}

fn moved(triangles: &[[u32; 3]], new_from_old: &[u32]) -> Vec<[u32; 3]> {
    let to = |t: &[u32; 3]| t.map(|i| new_from_old[i as usize]);
    triangles.iter().map(to).filter(has_three).collect()
}

/// True if a triangle has three different vertices.
pub fn has_three(t: &[u32; 3]) -> bool {
    t[0] != t[1] && t[1] != t[2] && t[2] != t[0]
}

struct VertexWeld {
    new_from_old: Vec<u32>,
    vertices: usize,
    open: usize,
}

fn join_near(
    at: &[DVec3],
    triangles: &[[u32; 3]],
    edges: &Edges,
    now: EdgeCount,
) -> Option<VertexWeld> {
    let near = NEAR_SHARE * Bounds::from_points(at.iter().copied()).size().length();
    if near <= 0.0 {
        return None;
    }
    let mut rim: Vec<u32> = edges.open().flatten().collect();
    rim.sort_unstable();
    rim.dedup();

    let cell = |p: DVec3| (p / near).floor().to_array().map(|c| c as i64);
    let mut in_cell: HashMap<[i64; 3], Vec<u32>> = HashMap::new();
    let mut sets = Sets::new(at.len());
    for &i in &rim {
        let [x, y, z] = cell(at[i as usize]);
        for n in 0..27 {
            let beside = [x + n % 3 - 1, y + n / 3 % 3 - 1, z + n / 9 - 1];
            for &j in in_cell.get(&beside).into_iter().flatten() {
                if at[i as usize].distance_squared(at[j as usize]) <= near * near {
                    sets.join(i, j);
                }
            }
        }
        in_cell.entry([x, y, z]).or_default().push(i);
    }
    let first: Vec<u32> = (0..at.len() as u32).map(|i| sets.find(i)).collect();
    let new_from_old = numbered(&first);
    let vertices = new_from_old.iter().max().map_or(0, |m| *m as usize + 1);
    if vertices == at.len() {
        return None;
    }
    let then = Edges::of(&moved(triangles, &new_from_old)).count();
    (then.open < now.open && then.non_manifold <= now.non_manifold).then_some(VertexWeld {
        new_from_old,
        vertices,
        open: then.open,
    })
}

/// A number with commas as thousands separators.
pub fn thousands(n: usize) -> String {
    let digits = n.to_string();
    let mut text = String::with_capacity(digits.len() + digits.len() / 3);
    for (i, d) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(d);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A tetrahedron as STL stores it: twelve corners.
    fn soup() -> (Vec<DVec3>, Vec<[u32; 3]>) {
        let p = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
        let corners = [0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2].map(|i: usize| p[i]);
        let triangles = (0..4).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
        (corners.to_vec(), triangles)
    }

    fn count_after(positions: &[DVec3], triangles: &[[u32; 3]]) -> (usize, EdgeCount) {
        let weld = weld(positions, triangles).unwrap();
        let welded = moved(triangles, &weld.new_from_old);
        (weld.positions.len(), Edges::of(&welded).count())
    }

    #[test]
    fn a_soup_closes() {
        let (mut positions, triangles) = soup();
        positions[0].x = -0.0;
        let (vertices, edges) = count_after(&positions, &triangles);
        assert_eq!((vertices, edges.edges, edges.open), (4, 6, 0));
        let note = weld(&positions, &triangles).unwrap().note;
        assert_eq!(note, "welded 12 corners to 4 vertices, which closes it");
    }

    #[test]
    fn almost_equal_corners_close_too_but_only_almost_equal_ones() {
        let (mut positions, triangles) = soup();
        positions[1].y += 0.5e-8;
        let (vertices, edges) = count_after(&positions, &triangles);
        assert_eq!((vertices, edges.open), (4, 0));
        positions[1].y += 1e-6;
        let (vertices, edges) = count_after(&positions, &triangles);
        assert_eq!((vertices, edges.open), (5, 4), "a gap of 1e-6 is a gap");
    }

    #[test]
    fn a_closed_mesh_is_left_alone() {
        // Two tetrahedra that touch in the edge from the origin to X: welding would make that edge non-manifold.
        let (corners, soup_triangles) = soup();
        let one = weld(&corners, &soup_triangles).unwrap();
        let triangles = moved(&soup_triangles, &one.new_from_old);
        let mirror = DVec3::new(1.0, -1.0, -1.0);
        let positions: Vec<DVec3> = [
            one.positions.clone(),
            one.positions.iter().map(|p| *p * mirror).collect(),
        ]
        .concat();
        let second = triangles.iter().map(|t| t.map(|i| i + 4));
        let both: Vec<_> = triangles.iter().copied().chain(second).collect();
        assert!(weld(&positions, &both).is_none());
    }

    #[test]
    fn near_welding_that_would_make_an_edge_non_manifold_is_dropped() {
        // Three fins along one edge, a tiny distance apart: joining any would leave an edge with three uses.
        let far = [DVec3::Y, DVec3::Z, -DVec3::Y];
        let mut positions = Vec::new();
        for (k, tip) in far.iter().enumerate() {
            let hair = DVec3::new(0.0, 1e-10 * k as f64, 0.0);
            positions.extend([hair, DVec3::X + hair, *tip]);
        }
        let triangles: Vec<[u32; 3]> = (0..3).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
        assert!(weld(&positions, &triangles).is_none());
    }

    #[test]
    fn thousands_are_grouped() {
        assert_eq!(thousands(7), "7");
        assert_eq!(thousands(10_428), "10,428");
        assert_eq!(thousands(1_000_000), "1,000,000");
    }
}
