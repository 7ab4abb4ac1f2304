//! The uses of edges, counted by sorting, and sets of vertices.
//!
//! Edges are distributed by ranges of their smaller index, and each range is sorted by one thread.

use rayon::prelude::*;

use crate::scene::meshes::buckets::{Buckets, bits_for};

/// What the uses of the edges of a mesh come to.
#[derive(Debug, Default)]
pub struct Edges {
    count: EdgeCount,
    open: Vec<[u32; 2]>,
    left_over: Vec<[u32; 2]>,
}

/// Number of edges of each kind.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EdgeCount {
    pub(crate) edges: usize,
    /// Edges with one use.
    pub(crate) boundary: usize,
    /// Edges with an odd number of uses.
    pub open: usize,
    /// Edges with more than two uses.
    pub(crate) non_manifold: usize,
    /// Edges with two uses in the same direction.
    pub(crate) inconsistent: usize,
}

impl Edges {
    pub fn of(triangles: &[[u32; 3]]) -> Self {
        let ranges = in_ranges(triangles, |key, _| key);
        let ranges: Vec<Self> = ranges.par_map_sorted(Self::of_range).collect();
        let mut all = Self::default();
        for range in ranges {
            all.count = all.count.and(range.count);
            all.open.extend(range.open);
            all.left_over.extend(range.left_over);
        }
        all
    }

    fn of_range(keys: &[u64]) -> Self {
        let mut edges = Self::default();
        for run in keys.chunk_by(|a, b| a >> 1 == b >> 1) {
            edges.count = edges.count.and(EdgeCount::of_edge(run));
            let ends = vertices_of(run[0]);
            if run.len() % 2 == 1 {
                edges.open.push(ends);
            }
            let [low, high] = ends;
            let down = run.iter().filter(|key| *key & 1 == 1).count();
            let up = run.len() - down;
            if low != high && up != down {
                let edge = if up > down { [low, high] } else { [high, low] };
                let times = up.abs_diff(down);
                edges.left_over.extend(std::iter::repeat_n(edge, times));
            }
        }
        edges
    }

    pub fn count(&self) -> EdgeCount {
        self.count
    }

    /// Edges with an odd number of uses, as pairs of vertices, the smaller index first, sorted.
    pub fn open(&self) -> impl Iterator<Item = [u32; 2]> {
        self.open.iter().copied()
    }

    /// The directed edges that remain when opposite ones cancel, each as often as it remains.
    pub(crate) fn left_over(&self) -> &[[u32; 2]] {
        &self.left_over
    }
}

impl EdgeCount {
    /// The edge with these uses.
    fn of_edge(uses: &[u64]) -> Self {
        Self {
            edges: 1,
            boundary: usize::from(uses.len() == 1),
            open: uses.len() % 2,
            non_manifold: usize::from(uses.len() > 2),
            inconsistent: usize::from(uses.len() == 2 && uses[0] == uses[1]),
        }
    }

    fn and(self, other: Self) -> Self {
        Self {
            edges: self.edges + other.edges,
            boundary: self.boundary + other.boundary,
            open: self.open + other.open,
            non_manifold: self.non_manifold + other.non_manifold,
            inconsistent: self.inconsistent + other.inconsistent,
        }
    }
}

/// Distributes items of all edges of triangles to ranges of the smaller index: `item` is given an edge's key and the triangle's index. The
/// uses of an edge are in the same range.
fn in_ranges<T: Copy + Send + Sync>(
    triangles: &[[u32; 3]],
    item: impl Fn(u64, u32) -> T + Sync,
) -> Buckets<T> {
    let greatest = triangles.par_iter().flatten_iter().max();
    let bits_of_index = greatest.map_or(0, |i| u32::BITS - i.leading_zeros());
    let bits = bits_for(3 * triangles.len()).min(bits_of_index);
    let shift = u32::BITS + bits_of_index - bits;
    // The shift is 64 if an index takes 32 bits and there is one range.
    let range_of = |key: u64| key.checked_shr(shift).unwrap_or(0) as usize;
    Buckets::of(triangles, 1 << bits, |index, t| {
        keys_of(t).map(|key| (range_of(key), item(key, index as u32)))
    })
}

/// The keys of a triangle's edges: smaller index, larger index, then whether the edge runs from the larger to the smaller.
fn keys_of([a, b, c]: &[u32; 3]) -> [u64; 3] {
    [[*a, *b], [*b, *c], [*c, *a]].map(|[from, to]| {
        let (low, high) = (from.min(to), from.max(to));
        (u64::from(low) << 32) | (u64::from(high) << 1) | u64::from(from > to)
    })
}

/// A triangle at an edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct EdgeUse {
    pub(crate) triangle: u32,
    /// True if the triangle uses the edge from the larger index to the smaller.
    pub(crate) is_down: bool,
}

/// The uses of all edges with their triangles, sorted by smaller index, larger index, direction, then triangle.
/// They are in consecutive ranges.
pub(crate) struct EdgeUses(Vec<Vec<(u64, u32)>>);

impl EdgeUses {
    pub(crate) fn of(triangles: &[[u32; 3]]) -> Self {
        let ranges = in_ranges(triangles, |key, triangle| (key, triangle));
        Self(ranges.par_map_sorted(<[_]>::to_vec).collect())
    }

    /// The vertices of each edge, the smaller index first, and its uses.
    pub(crate) fn runs(&self) -> impl Iterator<Item = ([u32; 2], impl Iterator<Item = EdgeUse>)> {
        let ranges = self.0.iter();
        let runs = ranges.flat_map(|range| range.chunk_by(|a, b| a.0 >> 1 == b.0 >> 1));
        runs.map(|run| {
            let of_run = run.iter().map(|(key, triangle)| EdgeUse {
                triangle: *triangle,
                is_down: key & 1 == 1,
            });
            (vertices_of(run[0].0), of_run)
        })
    }
}

fn vertices_of(key: u64) -> [u32; 2] {
    [(key >> 32) as u32, ((key & 0xffff_ffff) >> 1) as u32]
}

/// Representatives of a partition of `0..n`; the least member represents its set.
pub struct Sets(Vec<u32>);

impl Sets {
    pub fn new(n: usize) -> Self {
        Self((0..n as u32).collect())
    }

    pub fn find(&mut self, mut i: u32) -> u32 {
        while self.0[i as usize] != i {
            let up = self.0[self.0[i as usize] as usize];
            self.0[i as usize] = up;
            i = up;
        }
        i
    }

    pub fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.find(a), self.find(b));
        self.0[a.max(b) as usize] = a.min(b);
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;

    /// Triangles between few vertices, so that edges have up to a dozen uses in both directions; some have a repeated corner.
    fn tangled(count: usize, vertices: u32) -> Vec<[u32; 3]> {
        let mut state = 7_u64;
        let mut next = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            (state >> 33) as u32
        };
        let corners = |first: u32, next: &mut dyn FnMut() -> u32| {
            [0, 1, 2].map(|_| (first + next() % 6) % vertices)
        };
        (0..count)
            .map(|_| {
                let first = next() % vertices;
                corners(first, &mut next)
            })
            .collect()
    }

    #[test]
    fn ranges_of_edges_come_to_what_all_edges_come_to() {
        // One range, and many; the last with an index of the greatest number of bits.
        for (count, vertices) in [(2_000, 700), (200_000, 70_000), (60_000, 1 << 31)] {
            let triangles = tangled(count, vertices);
            let mut uses: BTreeMap<[u32; 2], [usize; 2]> = BTreeMap::new();
            for &[a, b, c] in &triangles {
                for [from, to] in [[a, b], [b, c], [c, a]] {
                    let key = [from.min(to), from.max(to)];
                    uses.entry(key).or_default()[usize::from(from > to)] += 1;
                }
            }
            let edges = Edges::of(&triangles);
            let of = |holds: &dyn Fn(usize, usize) -> bool| {
                uses.values().filter(|[up, down]| holds(*up, *down)).count()
            };
            let expected = EdgeCount {
                edges: uses.len(),
                boundary: of(&|up, down| up + down == 1),
                open: of(&|up, down| (up + down) % 2 == 1),
                non_manifold: of(&|up, down| up + down > 2),
                inconsistent: of(&|up, down| up + down == 2 && up != down),
            };
            assert_eq!(edges.count(), expected);
            let is_open = |(_, [up, down]): &(&[u32; 2], &[usize; 2])| (up + down) % 2 == 1;
            let open = uses.iter().filter(is_open).map(|(edge, _)| *edge);
            assert!(edges.open().eq(open), "in order");
            let left_over = uses.iter().filter(|([low, high], _)| low != high);
            let left_over = left_over.flat_map(|([low, high], [up, down])| {
                let edge = match up > down {
                    true => [*low, *high],
                    false => [*high, *low],
                };
                std::iter::repeat_n(edge, up.abs_diff(*down))
            });
            assert!(edges.left_over().iter().copied().eq(left_over));
            let of_each = EdgeUses::of(&triangles);
            let counts = of_each.runs().map(|(edge, uses)| (edge, uses.count()));
            assert!(counts.eq(uses.iter().map(|(edge, [up, down])| (*edge, up + down))));
        }
    }
}
