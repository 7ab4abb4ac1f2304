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
//! less. Memory: five bytes for each vertex before welding, and the welded mesh. Limit: coordinates that were made to have the same hash take
//! a time that grows with the square of their number.

use std::collections::HashMap;
use std::sync::atomic::{AtomicU32, Ordering};

use glam::DVec3;
use hashbrown::HashTable;
use rayon::prelude::*;

use super::buckets::{Buckets, bits_for};
use super::topology::{EdgeCount, Edges, Sets};
use crate::scene::Bounds;

/// Distance up to which vertices are joined, as a share of the diagonal. It is a fifth of an f32 step at a coordinate as large as the
/// diagonal, so vertices that f32 distinguishes there stay separate.
const NEAR_SHARE: f64 = 1e-8;

/// Number of positions that a thread takes at once.
const SHARE: usize = 1 << 20;

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
        let to_near = |t: &mut [u32; 3]| *t = t.map(|i| near[i as usize]);
        triangles.par_iter_mut().for_each(to_near);
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

/// New indices in order of first appearance; equal coordinates get equal indices.
fn joined_where_equal(count: usize, at: impl Fn(usize) -> DVec3 + Sync) -> Vec<u32> {
    let first = joined_with_recent(count, &at);
    let bits = bits_for(count);
    let buckets = Buckets::of(&first, 1 << bits, |i, first| {
        // The table of a bucket uses the low and the highest bits: the ones between them number the bucket.
        let bucket = || (hash(at(i)) >> 32) as usize & ((1 << bits) - 1);
        let is_first = first.load(Ordering::Relaxed) as usize == i;
        is_first.then(|| (bucket(), i as u32))
    });
    buckets.par_iter().for_each(|items| {
        let mut firsts: HashTable<(u32, u64)> = HashTable::new();
        for i in items {
            let p = at(i as usize);
            let hash = hash(p);
            let is_same = |(j, _): &(u32, u64)| at(*j as usize) == p;
            let of_place = firsts.entry(hash, is_same, |(_, hash)| *hash);
            let (j, _) = *of_place.or_insert((i, hash)).get();
            first[i as usize].store(j, Ordering::Relaxed);
        }
    });
    drop(buckets);
    numbered(first)
}

/// For each position, the index of an equal one before it, or its own. Only positions that appeared recently are found, but these are most:
/// files list triangles next to each other.
fn joined_with_recent(count: usize, at: impl Fn(usize) -> DVec3 + Sync) -> Vec<AtomicU32> {
    const RECENT: usize = 1 << 16;
    let first: Vec<AtomicU32> = (0..count)
        .into_par_iter()
        .map(|i| AtomicU32::new(i as u32))
        .collect();
    first
        .par_chunks(SHARE)
        .enumerate()
        .for_each(|(share, some)| {
            let places = some.len().next_power_of_two().min(RECENT);
            let mut recent = vec![(u32::MAX, DVec3::NAN); places];
            for (i, first) in (share * SHARE..).zip(some) {
                let p = at(i);
                let last = &mut recent[hash(p) as usize % places];
                if last.1 == p {
                    first.store(last.0, Ordering::Relaxed);
                } else {
                    *last = (i as u32, p);
                }
            }
        });
    first
}

/// A hash of coordinates. It is the same for `-0.0` and `0.0`.
fn hash(p: DVec3) -> u64 {
    // Multiples of the golden ratio's bits; the upper half of a product depends on all bits of the factors.
    const ODD: u64 = 0x9e37_79b9_7f4a_7c15;
    let mix = |hash: u64, c: f64| {
        let product = u128::from(hash ^ (c + 0.0).to_bits()) * u128::from(ODD);
        (product >> 64) as u64 ^ product as u64
    };
    p.to_array().into_iter().fold(ODD, mix)
}

/// Consecutive new indices of sets. `first` gives, for each member, an earlier one, which gives the first; the first gives itself.
fn numbered(first: Vec<AtomicU32>) -> Vec<u32> {
    let is_first = |i: usize| first[i].load(Ordering::Relaxed) as usize == i;
    let is_first: Vec<bool> = (0..first.len()).into_par_iter().map(is_first).collect();
    // The first of a set gives the set's number from here on, and each other member the first.
    let resolve = |(first_of, is_first): (&AtomicU32, &bool)| {
        if !is_first {
            let before = first_of.load(Ordering::Relaxed);
            let first = first[before as usize].load(Ordering::Relaxed);
            first_of.store(first, Ordering::Relaxed);
        }
    };
    first.par_iter().zip(&is_first).for_each(resolve);
    let shares = is_first.par_chunks(SHARE);
    let counts: Vec<u32> = (shares.clone())
        .map(|some| some.iter().map(|is_first| u32::from(*is_first)).sum())
        .collect();
    let shares = shares.zip(first.par_chunks(SHARE)).enumerate();
    shares.for_each(|(share, (is_first, first))| {
        let firsts = first
            .iter()
            .zip(is_first)
            .filter(|(_, is_first)| **is_first);
        let before = counts[..share].iter().sum::<u32>();
        for (number, (first, _)) in (before..).zip(firsts) {
            first.store(number, Ordering::Relaxed);
        }
    });
    let number = |(first_of, is_first): (&AtomicU32, &bool)| {
        if !is_first {
            let first_of_set = first_of.load(Ordering::Relaxed);
            let number = first[first_of_set as usize].load(Ordering::Relaxed);
            first_of.store(number, Ordering::Relaxed);
        }
    };
    first.par_iter().zip(&is_first).for_each(number);
    first.into_iter().map(AtomicU32::into_inner).collect()
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

    /// Corners on a small grid, in an order that repeats places at once and after very many others, with both zeros.
    fn scattered(count: usize) -> Vec<DVec3> {
        let mut state = 1_u64;
        let mut next = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            ((state >> 40) % 41) as f64 - 20.0
        };
        let mut all = Vec::new();
        while all.len() < count {
            let p = DVec3::new(next(), next(), next());
            all.extend([p, -p, p]);
        }
        all.truncate(count);
        all
    }

    #[test]
    fn equal_corners_are_joined_whatever_their_number_and_order() {
        // More than a share, and many buckets.
        let corners = scattered(3 * 360_000);
        assert!(bits_for(corners.len()) > 3 && corners.len() > SHARE);
        let joined = joined_where_equal(corners.len(), |i| corners[i]);
        let mut known: HashMap<[u64; 3], u32> = HashMap::new();
        for (p, joined) in corners.iter().zip(&joined) {
            let number = known.len() as u32;
            let bits = (*p + DVec3::ZERO).to_array().map(f64::to_bits);
            assert_eq!(*known.entry(bits).or_insert(number), *joined, "{p}");
        }
        assert!(known.len() < corners.len() / 10);
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
