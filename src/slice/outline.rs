//! Loops drawn into a constrained Delaunay triangulation, and cut where they cross.
//!
//! All points are vertices, all edges of loops become constraints. An edge that would cross another is not forced in: both are
//! cut where they meet, and the outline is triangulated again. Cutting moves edges by a rounding error, which may make new crossings;
//! so it happens on a lattice (snap rounding, Hobby 1999), where near coincidences become coincidences instead of ever smaller
//! ones. Triangles may then flip by as much as one lattice step.

use std::collections::{BTreeSet, HashMap};

use glam::DVec2;
use robust::{Coord, orient2d};
use spade::handles::{DirectedEdgeHandle, FixedDirectedEdgeHandle, FixedVertexHandle};
use spade::{
    CdtEdge, ConstrainedDelaunayTriangulation, HasPosition, MIN_ALLOWED_VALUE as LEAST, Point2,
    Triangulation,
};

use super::section::power_of_two_near;
use super::slicer::share;

/// Lattice step for vertices once edges are cut, relative to the outline's size: a few ulps.
const STEP: f64 = 1.0 / (1_u64 << 47) as f64;
/// Once edges are cut, an edge this near to a vertex passes through it. Must be less than half the diagonal of a lattice cell: otherwise
/// each of two crossing diagonals would be drawn to the other's ends for ever.
const NEAR: f64 = 0.7 * STEP;
/// Maximum points at which edges are cut: a star of 700 edges that all cross each other.
const MOST_CUTS: usize = 250_000;

/// A vertex position with its index.
pub(super) struct OutlineVertex {
    at: DVec2,
    pub(super) number: u32,
}

impl HasPosition for OutlineVertex {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        Point2::new(self.at.x, self.at.y)
    }
}

/// Net passes along an edge: those in the direction of its first handle minus those in the other direction.
#[derive(Default)]
pub(super) struct Passed {
    pub(super) net: i32,
}

pub(super) type Edge<'a> = DirectedEdgeHandle<'a, OutlineVertex, (), CdtEdge<Passed>, ()>;
pub(super) type LoopTriangulation = ConstrainedDelaunayTriangulation<OutlineVertex, (), Passed, ()>;

/// An edge of a loop, or a part of one.
#[derive(Clone, Copy)]
pub(super) struct EdgeSegment {
    from: u32,
    to: u32,
    of_loop: usize,
    /// Index of the input edge that contains it, counted across all loops.
    pub(super) edge: u32,
}

/// Region to fill, scaled into the range of the triangulation by a power of two.
pub(super) struct FillRegion {
    /// Input units per internal unit.
    pub(super) unit: f64,
    /// Vertex positions, no two equal, each with its point index.
    vertices: Vec<(DVec2, u32)>,
    vertex_at: HashMap<[u64; 2], u32>,
    /// The vertex of each point that a loop uses.
    vertex_of: Vec<Option<u32>>,
    /// Vertices by lattice cell, once something is to be cut.
    vertex_in: HashMap<[i64; 2], u32>,
    pub(super) parts: Vec<EdgeSegment>,
    /// Number of input points.
    given: usize,
    /// Points at which parts were cut, in units of the input.
    pub(super) added: Vec<DVec2>,
    pub(super) left_out: BTreeSet<usize>,
}

/// A triangulation with the parts that could be inserted as its edges.
pub(super) struct ConstrainedMesh {
    pub(super) mesh: LoopTriangulation,
    /// Edges of the inserted parts, each with the index of its part, in order along the part.
    pub(super) covered: Vec<(usize, FixedDirectedEdgeHandle)>,
    /// Parts that could not be inserted.
    pub(super) failed: Vec<usize>,
}

impl FillRegion {
    /// The region of closed curves, and of open ones, which are counted after the closed.
    pub(super) fn of(points: &[DVec2], loops: &[Vec<u32>], open: &[Vec<u32>]) -> Self {
        let curves = || loops.iter().chain(open);
        let used = || curves().flatten().map(|i| points[*i as usize]);
        let largest = used().fold(0.0_f64, |m, p| m.max(p.abs().max_element()));
        let unit = power_of_two_near(largest);
        let mut outline = Self {
            unit,
            vertices: Vec::with_capacity(points.len()),
            vertex_at: HashMap::with_capacity(points.len()),
            vertex_of: vec![None; points.len()],
            vertex_in: HashMap::new(),
            parts: Vec::with_capacity(points.len()),
            given: points.len(),
            added: Vec::new(),
            left_out: BTreeSet::new(),
        };
        let mut edges = 0..;
        for (of_loop, one) in curves().enumerate() {
            let places = one.iter().map(|i| (points[*i as usize] / unit, *i));
            let vertices: Vec<u32> = places.map(|(at, i)| outline.vertex(at, i)).collect();
            for (i, vertex) in one.iter().zip(&vertices) {
                outline.vertex_of[*i as usize] = Some(*vertex);
            }
            let is_open = of_loop >= loops.len();
            let next = vertices.iter().cycle().skip(1);
            let steps = vertices.iter().zip(next);
            let steps = steps.take(vertices.len() - usize::from(is_open));
            for ((from, to), edge) in steps.zip(&mut edges) {
                outline.add(EdgeSegment {
                    from: *from,
                    to: *to,
                    of_loop,
                    edge,
                });
            }
        }
        outline
    }

    fn add(&mut self, part: EdgeSegment) {
        if part.from != part.to {
            self.parts.push(part);
        }
    }

    /// For each given point, the point whose vertex it uses: its own, unless points have been merged.
    pub(super) fn stand_ins(&self) -> Vec<u32> {
        let number = |vertex: u32| self.vertices[vertex as usize].1;
        (0..)
            .zip(&self.vertex_of)
            .map(|(point, vertex)| vertex.map_or(point, number))
            .collect()
    }

    /// The vertex at a position; a new one gets the index of its point.
    fn vertex(&mut self, at: DVec2, number: u32) -> u32 {
        // Values too small for the triangulation become zero, and -0 becomes +0.
        let at = DVec2::from(at.to_array().map(|c| if c.abs() < LEAST { 0.0 } else { c }));
        let next = self.vertices.len() as u32;
        let key = at.to_array().map(f64::to_bits);
        let vertex = *self.vertex_at.entry(key).or_insert(next);
        if vertex == next {
            self.vertices.push((at, number));
        }
        vertex
    }

    /// Moves every vertex to its lattice point, where several may become one.
    fn snap(&mut self) {
        let mut merged = Vec::with_capacity(self.vertices.len());
        for (at, number) in std::mem::take(&mut self.vertices) {
            let next = self.vertices.len() as u32;
            let cell = cell_of(at);
            let vertex = *self.vertex_in.entry(cell).or_insert(next);
            if vertex == next {
                self.vertices.push((middle_of(cell), number));
            }
            merged.push(vertex);
        }
        for part in &mut self.parts {
            part.from = merged[part.from as usize];
            part.to = merged[part.to as usize];
        }
        for vertex in self.vertex_of.iter_mut().flatten() {
            *vertex = merged[*vertex as usize];
        }
        self.parts.retain(|p| p.from != p.to);
    }

    /// The vertex of the lattice cell that contains a position; a new vertex adds a point.
    fn meeting_vertex(&mut self, at: DVec2) -> u32 {
        let cell = cell_of(at);
        let next = self.vertices.len() as u32;
        let vertex = *self.vertex_in.entry(cell).or_insert(next);
        if vertex == next {
            let number = self.given + self.added.len();
            self.vertices.push((middle_of(cell), number as u32));
            self.added.push(middle_of(cell) * self.unit);
        }
        vertex
    }

    /// Triangulates the vertices and inserts the parts as edges.
    pub(super) fn draw(&self) -> Option<ConstrainedMesh> {
        let vertices = self.vertices.iter();
        let vertices = vertices.map(|(at, number)| OutlineVertex {
            at: *at,
            number: *number,
        });
        // This way of loading preserves the order.
        let mut mesh = LoopTriangulation::bulk_load_cdt(vertices.collect(), Vec::new()).ok()?;
        if mesh.num_vertices() != self.vertices.len() {
            return None;
        }
        let mut covered = Vec::with_capacity(self.parts.len());
        let mut failed = Vec::new();
        for (i, part) in self.parts.iter().enumerate() {
            let [from, to] =
                [part.from, part.to].map(|v| FixedVertexHandle::from_index(v as usize));
            let edges = mesh.try_add_constraint(from, to);
            let mut reached = from;
            let is_path = edges.iter().all(|edge| {
                let edge = mesh.directed_edge(*edge);
                edge.from().fix() == std::mem::replace(&mut reached, edge.to().fix())
            });
            if !is_path || reached != to {
                failed.push(i);
                continue;
            }
            for edge in edges {
                let way = if is_first(edge) { 1 } else { -1 };
                let passed = mesh.undirected_edge_data_mut(edge.as_undirected());
                passed.data_mut().net += way;
                covered.push((i, edge));
            }
        }
        Some(ConstrainedMesh {
            mesh,
            covered,
            failed,
        })
    }

    /// Cuts the parts that could not be drawn, and the edges that block them, where they meet. Returns false if there is nothing to cut
    /// or too much.
    ///
    /// All vertices first move to a lattice, and an edge that passes within half a cell of a vertex is cut there: then edges that run
    /// side by side become one, and edges that nearly meet in a point do meet. This is snap rounding (Hobby 1999), one crossing
    /// after the other.
    pub(super) fn cut(&mut self, drawn: &ConstrainedMesh) -> bool {
        if self.vertex_in.is_empty() {
            self.snap();
            return true;
        }
        let mesh = &drawn.mesh;
        let mut meetings = Vec::new();
        let (mut on_parts, mut on_edges) = (Vec::new(), Vec::new());
        for failed in &drawn.failed {
            let part = self.parts[*failed];
            let ends = [part.from, part.to];
            let [from, to] = ends.map(|v| FixedVertexHandle::from_index(v as usize));
            let at = |v: u32| self.vertices[v as usize].0;
            let line = ends.map(at);
            for edge in mesh.get_conflicting_edges_between_vertices(from, to) {
                let others = edge.vertices().map(|v| v.fix().index() as u32);
                let edge = edge.fix().as_undirected().index();
                let other = others.map(at);
                let before = on_parts.len() + on_edges.len();
                let near = others.into_iter().filter(|v| is_near(at(*v), line));
                on_parts.extend(near.map(|v| (*failed, v)));
                let near = ends.into_iter().filter(|v| is_near(at(*v), other));
                on_edges.extend(near.map(|v| (edge, v)));
                if on_parts.len() + on_edges.len() == before {
                    meetings.push((*failed, edge, meeting(line, other)));
                }
            }
            if self.added.len() + meetings.len() > MOST_CUTS {
                return false;
            }
        }
        for (part, edge, at) in meetings {
            let vertex = self.meeting_vertex(at);
            on_parts.push((part, vertex));
            on_edges.push((edge, vertex));
        }
        if on_parts.is_empty() && on_edges.is_empty() {
            return false;
        }
        on_parts.sort_unstable();
        on_edges.sort_unstable();
        let before = std::mem::take(&mut self.parts);
        for (i, edge) in &drawn.covered {
            let ends = mesh.directed_edge(*edge).vertices();
            let ends = ends.map(|v| v.fix().index() as u32);
            let cuts = of(&on_edges, edge.as_undirected().index());
            let [from, to] = ends;
            self.add_cut(
                EdgeSegment {
                    from,
                    to,
                    ..before[*i]
                },
                cuts,
            );
        }
        for i in &drawn.failed {
            self.add_cut(before[*i], of(&on_parts, *i));
        }
        true
    }

    /// Adds the parts between cuts.
    fn add_cut(&mut self, part: EdgeSegment, cuts: &[(usize, u32)]) {
        let at = |v: u32| self.vertices[v as usize].0;
        let [start, end] = [part.from, part.to].map(at);
        let mut along: Vec<u32> = cuts.iter().map(|(_, v)| *v).collect();
        let distance = |v: &u32| (at(*v) - start).dot(end - start);
        along.sort_by(|a, b| distance(a).total_cmp(&distance(b)));
        let mut from = part.from;
        for to in along.into_iter().chain([part.to]) {
            self.add(EdgeSegment { from, to, ..part });
            from = to;
        }
    }

    /// Removes the loops to which the given parts belong.
    pub(super) fn leave_out(&mut self, parts: &[usize]) {
        self.left_out
            .extend(parts.iter().map(|i| self.parts[*i].of_loop));
        let left_out = &self.left_out;
        self.parts.retain(|p| !left_out.contains(&p.of_loop));
    }
}

/// The lattice cell of a position: the cell whose centre is nearest.
fn cell_of(at: DVec2) -> [i64; 2] {
    at.to_array().map(|c| (c / STEP).round() as i64)
}

fn middle_of(cell: [i64; 2]) -> DVec2 {
    DVec2::from(cell.map(|c| c as f64)) * STEP
}

/// Returns true if an edge passes a vertex so closely that it must pass through it.
fn is_near(at: DVec2, [from, to]: [DVec2; 2]) -> bool {
    let way = to - from;
    let along = ((at - from).dot(way) / way.length_squared()).clamp(0.0, 1.0);
    at.distance_squared(from + way * along) < NEAR * NEAR
}

/// Returns true if an edge runs in the direction in which its passes are counted.
pub(super) fn is_first(edge: FixedDirectedEdgeHandle) -> bool {
    edge.as_undirected().as_directed() == edge
}

/// The entries of a sorted list that have the given key.
fn of(sorted: &[(usize, u32)], key: usize) -> &[(usize, u32)] {
    let first = sorted.partition_point(|(k, _)| *k < key);
    let rest = &sorted[first..];
    &rest[..rest.partition_point(|(k, _)| *k == key)]
}

/// Intersection of a line and an edge whose ends lie on opposite sides of it: always on the edge, however small the angle between them.
fn meeting(line: [DVec2; 2], edge: [DVec2; 2]) -> DVec2 {
    let [a, b] = line.map(|p| Coord { x: p.x, y: p.y });
    let [near, far] = edge.map(|p| orient2d(a, b, Coord { x: p.x, y: p.y }).abs());
    let [from, to] = edge;
    let at = if near <= far {
        from + (to - from) * share(near, far)
    } else {
        to + (from - to) * share(far, near)
    };
    at.clamp(from.min(to), from.max(to))
}
