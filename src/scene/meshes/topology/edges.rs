//! The uses of edges, counted by sorting, and sets of vertices.

use rayon::prelude::*;

/// The uses of all edges, sorted by smaller index, larger index, then direction.
pub struct Edges {
    keys: Vec<u64>,
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
        let mut keys: Vec<u64> = triangles.par_iter().flat_map_iter(keys_of).collect();
        keys.par_sort_unstable();
        Self { keys }
    }

    fn runs(&self) -> impl Iterator<Item = &[u64]> {
        self.keys.chunk_by(|a, b| a >> 1 == b >> 1)
    }

    pub fn count(&self) -> EdgeCount {
        let mut count = EdgeCount::default();
        for run in self.runs() {
            count.edges += 1;
            count.boundary += usize::from(run.len() == 1);
            count.open += run.len() % 2;
            count.non_manifold += usize::from(run.len() > 2);
            count.inconsistent += usize::from(run.len() == 2 && run[0] == run[1]);
        }
        count
    }

    /// Edges with an odd number of uses, as pairs of vertices.
    pub fn open(&self) -> impl Iterator<Item = [u32; 2]> {
        self.runs()
            .filter(|run| run.len() % 2 == 1)
            .map(|run| vertices_of(run[0]))
    }
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

/// The uses of all edges with their triangles, sorted like [`Edges`], then by triangle.
pub(crate) struct EdgeUses(Vec<(u64, u32)>);

impl EdgeUses {
    pub(crate) fn of(triangles: &[[u32; 3]]) -> Self {
        let mut uses: Vec<(u64, u32)> = (triangles.par_iter().enumerate())
            .flat_map_iter(|(index, t)| keys_of(t).map(|key| (key, index as u32)))
            .collect();
        uses.par_sort_unstable();
        Self(uses)
    }

    /// The vertices of each edge, the smaller index first, and its uses.
    pub(crate) fn runs(&self) -> impl Iterator<Item = ([u32; 2], impl Iterator<Item = EdgeUse>)> {
        let runs = self.0.chunk_by(|a, b| a.0 >> 1 == b.0 >> 1);
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
