//! Boundary chain of a mesh, and the triangles that close it.
//!
//! Directed edges are sorted and cancelled; what remains enters and leaves each vertex equally often, so that walking along it returns: a
//! walk is cut into simple loops wherever it meets a vertex again. A loop is filled by triangles between the ends and the middle of
//! ranges of its vertices, halved down to single edges, so that triangles are as large as their range.
//!
//! Cost: a parallel sort of three keys per triangle; linear in the chain after that. The fill is any one: it need not be flat, and may cross
//! the mesh and itself. Limit: 2^31 vertices.

use std::collections::HashMap;

use crate::scene::{Edges, Fill};

/// The triangles that close a mesh.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Closing {
    /// Triangles by vertex index of the mesh; with those of the mesh, each directed edge is used as often as its reverse.
    pub triangles: Vec<[u32; 3]>,
    /// Number of directed edges in the boundary chain.
    pub chain_edges: usize,
    /// Number of loops of the chain.
    pub loops: usize,
    /// Number of edges, whatever their direction, at which an odd number of faces meet.
    pub odd_edges: usize,
}

impl Closing {
    /// Closes a mesh; without triangles if the mesh needs none.
    pub fn of(triangles: &[[u32; 3]]) -> Self {
        let (chain, odd_edges) = chain(triangles);
        let mut closing = Self {
            chain_edges: chain.len(),
            odd_edges,
            ..Self::default()
        };
        for_each_loop(&chain, |corners| {
            closing.loops += 1;
            closing.fill(corners);
        });
        closing
    }

    /// Returns true if the mesh is closed and consistently oriented without any.
    pub fn is_empty(&self) -> bool {
        self.triangles.is_empty()
    }

    /// Returns true if a mesh with this fill rule is open. For the even-odd rule, it is closed if an even number of faces meet at each edge,
    /// however they are oriented: then all rays from a point cross it equally often, modulo 2.
    pub fn is_needed(&self, fill: Fill) -> bool {
        match fill {
            Fill::EvenOdd => self.odd_edges > 0,
            Fill::Nonzero => !self.is_empty(),
        }
    }

    /// Fills a loop, against its direction.
    fn fill(&mut self, corners: &[u32]) {
        // Ranges of corners whose chord is the edge of a triangle that is already there.
        let mut ranges = vec![(0, corners.len() - 1)];
        while let Some((first, last)) = ranges.pop() {
            if last - first < 2 {
                continue;
            }
            let middle = usize::midpoint(first, last);
            let [a, b, c] = [first, middle, last].map(|i| corners[i]);
            self.triangles.push([a, c, b]);
            ranges.extend([(first, middle), (middle, last)]);
        }
    }
}

/// The directed edges that remain when opposite ones cancel, sorted, each as often as it remains; and the number of edges used an odd number
/// of times.
fn chain(triangles: &[[u32; 3]]) -> (Vec<[u32; 2]>, usize) {
    let edges = Edges::of(triangles);
    let mut chain = edges.left_over().to_vec();
    chain.sort_unstable();
    let odd_edges = edges.open().filter(|[a, b]| a != b).count();
    (chain, odd_edges)
}

/// Calls `found` with the vertices of each simple loop of a chain, in which as many edges enter a vertex as leave it.
fn for_each_loop(chain: &[[u32; 2]], mut found: impl FnMut(&[u32])) {
    // Of each vertex, the next of its edges to be walked.
    let mut next: HashMap<u32, usize> = HashMap::new();
    for (index, edge) in chain.iter().enumerate().rev() {
        next.insert(edge[0], index);
    }
    let mut step = |from: u32| {
        let place = next.get_mut(&from)?;
        let edge = chain.get(*place).filter(|edge| edge[0] == from)?;
        *place += 1;
        Some(edge[1])
    };
    let mut path: Vec<u32> = Vec::new();
    let mut place_of: HashMap<u32, usize> = HashMap::new();
    for [start, _] in chain {
        path.push(*start);
        place_of.insert(*start, 0);
        while let Some(to) = path.last().and_then(|last| step(*last)) {
            match place_of.get(&to) {
                None => {
                    place_of.insert(to, path.len());
                    path.push(to);
                }
                Some(first) => {
                    let first = *first;
                    found(&path[first..]);
                    for vertex in path.drain(first + 1..) {
                        place_of.remove(&vertex);
                    }
                }
            }
        }
        path.clear();
        place_of.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::shapes::shape;

    /// Uses of each directed edge, minus those of its reverse.
    fn left_over(triangles: impl Iterator<Item = [u32; 3]>) -> usize {
        let all: Vec<[u32; 3]> = triangles.collect();
        chain(&all).0.len()
    }

    fn closed(triangles: &[[u32; 3]]) -> Closing {
        let closing = Closing::of(triangles);
        let all = triangles.iter().chain(&closing.triangles).copied();
        assert_eq!(left_over(all), 0, "{closing:?}");
        closing
    }

    #[test]
    fn closed_meshes_need_no_triangles() {
        for spec in ["cube", "torus", "crank"] {
            for part in shape(spec).unwrap() {
                assert_eq!(closed(&part.mesh.triangles), Closing::default(), "{spec}");
            }
        }
    }

    #[test]
    fn holes_flipped_faces_doubled_faces_and_soups_are_closed() {
        let sphere = shape("sphere?subdivisions=3").unwrap().remove(0).mesh;
        let all = sphere.triangles.clone();
        let hole = closed(&all[..all.len() - 1]);
        assert_eq!((hole.chain_edges, hole.loops, hole.odd_edges), (3, 1, 3));
        assert!(hole.is_needed(Fill::EvenOdd) && hole.is_needed(Fill::Nonzero));
        let mut flipped = all.clone();
        flipped[7].swap(0, 1);
        // Each edge of the flipped face is used twice in one direction.
        let of_flipped = closed(&flipped);
        assert_eq!((of_flipped.chain_edges, of_flipped.odd_edges), (6, 0));
        assert!(!of_flipped.is_needed(Fill::EvenOdd) && of_flipped.is_needed(Fill::Nonzero));
        let doubled = [all.as_slice(), &all[..1]].concat();
        assert_eq!(closed(&doubled).chain_edges, 3);
        let every_other: Vec<_> = all.iter().step_by(2).copied().collect();
        assert!(closed(&every_other).loops > 1);
        let soup: Vec<[u32; 3]> = (0..50).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        let closing = closed(&soup);
        assert_eq!((closing.chain_edges, closing.loops), (150, 50));
        assert_eq!(closing.triangles.len(), 50);
        // Three faces at one edge, and a face with a repeated corner.
        closed(&[[0, 1, 2], [0, 1, 3], [0, 1, 4], [5, 5, 6]]);
    }

    #[test]
    fn a_chain_with_an_edge_left_out_does_not_close() {
        let sphere = shape("sphere?subdivisions=2").unwrap().remove(0).mesh;
        let open = &sphere.triangles[3..];
        let closing = Closing::of(open);
        let short = &closing.triangles[1..];
        assert!(left_over(open.iter().chain(short).copied()) > 0);
    }
}
