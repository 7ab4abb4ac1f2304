//! Joins vertices that a file stored separately, so that edges have two faces again.
//!
//! STL repeats every corner and glTF splits vertices at normal seams; both tear a closed solid open. A mesh that is
//! closed by its own indices is left unchanged, so two solids that only touch stay separate. Otherwise
//!
//! 1. vertices with equal coordinates become one (`-0.0` equals `0.0`): no point moves;
//! 2. if edges are still open, vertices *of open edges* within 1e-8 of the bounds' diagonal become one at the first one's
//!    position; this is kept only if fewer edges are open afterwards and no edge has become non-manifold.
//!
//! Cost: the vertices are hashed in parallel, in buckets that fit into a cache; the edges are sorted up to three times, those of a soup once
//! less.

use std::collections::HashMap;
use std::sync::atomic::AtomicU32;

use glam::DVec3;
use rayon::prelude::*;

use super::equal_positions::{joined_where_equal, numbered};
use super::topology::{EdgeCount, Edges, Sets};
use crate::scene::Bounds;

/// Distance up to which vertices are joined, as a share of the diagonal. It is a fifth of an f32 step at a coordinate as large as the
/// diagonal, so vertices that f32 distinguishes there stay separate.
const NEAR_SHARE: f64 = 1e-8;

/// Result of welding a mesh.
#[derive(Debug)]
pub struct Welding {
    /// `None` if there is nothing to join.
    pub weld: Option<Weld>,
    /// Number of edges that are open afterwards.
    pub open: usize,
}

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

/// A welded mesh of triangles that shared no vertex.
#[derive(Debug)]
pub struct WeldedSoup {
    /// Vertices after welding.
    pub positions: Vec<DVec3>,
    /// One for each triangle of the soup; some may have a repeated corner.
    pub triangles: Vec<[u32; 3]>,
    /// Summary of the changes, for the user; `None` if there was nothing to join.
    pub note: Option<String>,
    /// Number of edges that are open afterwards.
    pub open: usize,
}

/// Welds a mesh if it has open edges. Indices must be in range, coordinates finite.
pub fn weld(positions: &[DVec3], triangles: &[[u32; 3]]) -> Welding {
    let open = match share_no_vertex(triangles) {
        true => 3 * triangles.len(),
        false => Edges::of(triangles).count().open,
    };
    if open == 0 {
        return Welding { weld: None, open };
    }
    let mut new_from_old = joined_where_equal(positions.len(), |i| positions[i]);
    let at = places(&new_from_old, |i| positions[i]);
    let welded = moved(triangles, &new_from_old);
    let joined = JoinedNear::of(at, &welded, (positions.len(), open));
    if let Some(near) = &joined.new_from_old {
        let to_near = |i: &mut u32| *i = near[*i as usize];
        new_from_old.par_iter_mut().for_each(to_near);
    }
    let weld = joined.note.map(|note| Weld {
        positions: joined.positions,
        new_from_old,
        note,
    });
    Welding {
        weld,
        open: joined.open,
    }
}

/// Welds a number of triangles that share no vertex, like [`weld`], without an array of their corners: `at` gives the position of a corner,
/// finite, by three times its triangle's index plus its index in the triangle.
pub fn weld_soup(triangles: usize, at: impl Fn(usize) -> DVec3 + Sync) -> WeldedSoup {
    let corners = 3 * triangles;
    let new_from_old = joined_where_equal(corners, &at);
    let positions = places(&new_from_old, &at);
    let mut triangles: Vec<[u32; 3]> = (new_from_old.par_chunks_exact(3))
        .map(|t| [t[0], t[1], t[2]])
        .collect();
    drop(new_from_old);
    let joined = match triangles.par_iter().all(has_three) {
        true => JoinedNear::of(positions, &triangles, (corners, corners)),
        false => {
            let three: Vec<[u32; 3]> = triangles.par_iter().copied().filter(has_three).collect();
            JoinedNear::of(positions, &three, (corners, corners))
        }
    };
    if let Some(near) = &joined.new_from_old {
        renumber(&mut triangles, near);
    }
    WeldedSoup {
        positions: joined.positions,
        triangles,
        note: joined.note,
        open: joined.open,
    }
}

/// Result of joining what is near where edges are still open after equal positions were joined.
struct JoinedNear {
    positions: Vec<DVec3>,
    /// `None` if nothing was joined.
    new_from_old: Option<Vec<u32>>,
    /// Summary of this and of the joining of equal positions.
    note: Option<String>,
    open: usize,
}

impl JoinedNear {
    /// `positions` are those after equal ones were joined, and there were so many `(vertices, open edges)` before.
    fn of(positions: Vec<DVec3>, triangles: &[[u32; 3]], (vertices, open): (usize, usize)) -> Self {
        let edges = Edges::of(triangles);
        let equal = edges.count();
        let note = (positions.len() < vertices).then(|| {
            format!(
                "welded {} corners to {} vertices, {}",
                thousands(vertices),
                thousands(positions.len()),
                closing(open, equal.open)
            )
        });
        let joined = (equal.open > 0)
            .then(|| join_near(&positions, triangles, &edges, equal))
            .flatten();
        let Some(near) = joined else {
            return Self {
                positions,
                new_from_old: None,
                note,
                open: equal.open,
            };
        };
        let text = format!(
            "{} pairs within 1e-8 of the size closed {} edges",
            thousands(positions.len() - near.vertices),
            thousands(equal.open - near.open)
        );
        Self {
            positions: places(&near.new_from_old, |i| positions[i]),
            new_from_old: Some(near.new_from_old),
            note: Some(match note {
                Some(first) => format!("{first}; {text}"),
                None => format!("welded: {text}"),
            }),
            open: near.open,
        }
    }
}

/// Returns true if each triangle has its own vertices, in order, as STL stores them.
fn share_no_vertex(triangles: &[[u32; 3]]) -> bool {
    let has_own = |(k, t): (usize, &[u32; 3])| {
        let first = 3 * k;
        t.map(|i| i as usize) == [first, first + 1, first + 2]
    };
    triangles.par_iter().enumerate().all(has_own)
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

/// The position of each new vertex: that of the first old vertex merged into it.
fn places(new_from_old: &[u32], at: impl Fn(usize) -> DVec3) -> Vec<DVec3> {
    let mut places = Vec::new();
    for (i, new) in new_from_old.iter().enumerate() {
        if *new as usize == places.len() {
            places.push(at(i));
        }
    }
    places
}

/// Replaces the vertices of triangles by their new indices.
pub fn renumber(triangles: &mut [[u32; 3]], new_from_old: &[u32]) {
    let to_new = |t: &mut [u32; 3]| *t = t.map(|i| new_from_old[i as usize]);
    triangles.par_iter_mut().for_each(to_new);
}

fn moved(triangles: &[[u32; 3]], new_from_old: &[u32]) -> Vec<[u32; 3]> {
    let to = |t: &[u32; 3]| t.map(|i| new_from_old[i as usize]);
    triangles.par_iter().map(to).filter(has_three).collect()
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
    let first = (0..at.len() as u32).map(|i| AtomicU32::new(sets.find(i)));
    let new_from_old = numbered(first.collect());
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
    use crate::scene::meshes::equal_positions::tests::scattered;

    /// A tetrahedron as STL stores it: twelve corners.
    fn soup() -> (Vec<DVec3>, Vec<[u32; 3]>) {
        let p = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
        let corners = [0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2].map(|i: usize| p[i]);
        let triangles = (0..4).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
        (corners.to_vec(), triangles)
    }

    fn count_after(positions: &[DVec3], triangles: &[[u32; 3]]) -> (usize, EdgeCount) {
        let weld = weld(positions, triangles).weld.unwrap();
        let welded = moved(triangles, &weld.new_from_old);
        (weld.positions.len(), Edges::of(&welded).count())
    }

    #[test]
    fn a_soup_closes() {
        let (mut positions, triangles) = soup();
        positions[0].x = -0.0;
        let (vertices, edges) = count_after(&positions, &triangles);
        assert_eq!((vertices, edges.edges, edges.open), (4, 6, 0));
        let note = weld(&positions, &triangles).weld.unwrap().note;
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
        let one = weld(&corners, &soup_triangles).weld.unwrap();
        let triangles = moved(&soup_triangles, &one.new_from_old);
        let mirror = DVec3::new(1.0, -1.0, -1.0);
        let positions: Vec<DVec3> = [
            one.positions.clone(),
            one.positions.iter().map(|p| *p * mirror).collect(),
        ]
        .concat();
        let second = triangles.iter().map(|t| t.map(|i| i + 4));
        let both: Vec<_> = triangles.iter().copied().chain(second).collect();
        assert!(weld(&positions, &both).weld.is_none());
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
        assert!(weld(&positions, &triangles).weld.is_none());
    }

    #[test]
    fn a_soup_is_welded_as_its_mesh_is() {
        let (mut few, _) = soup();
        few[1].y += 0.5e-8;
        let flat = vec![DVec3::ZERO, DVec3::ZERO, DVec3::X];
        for corners in [few.clone(), [few, flat].concat(), scattered(30_000)] {
            let count = corners.len() / 3;
            let triangles: Vec<_> = (0..count as u32)
                .map(|t| [3 * t, 3 * t + 1, 3 * t + 2])
                .collect();
            let expected = weld(&corners, &triangles);
            let welded = weld_soup(count, |i| corners[i]);
            let map = expected.weld.unwrap();
            assert_eq!(welded.open, expected.open);
            assert_eq!(welded.note, Some(map.note));
            assert_eq!(welded.positions, map.positions);
            let to_new = |t: &[u32; 3]| t.map(|i| map.new_from_old[i as usize]);
            let moved: Vec<_> = triangles.iter().map(to_new).collect();
            assert_eq!(welded.triangles, moved);
        }
    }

    #[test]
    fn thousands_are_grouped() {
        assert_eq!(thousands(7), "7");
        assert_eq!(thousands(10_428), "10,428");
        assert_eq!(thousands(1_000_000), "1,000,000");
    }
}
