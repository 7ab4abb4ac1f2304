//! The region that loops enclose, in triangles.
//!
//! All points go into a Delaunay triangulation, all edges of loops become constraints of it that know how often they are passed
//! and which way. An edge that would cross another is not forced in: both are cut where they meet, and everything is
//! triangulated anew, since rounding the meeting point moves the edges a little and may make them cross elsewhere. After a few
//! rounds, or too many cuts, loops that still cross are left out whole: what stays is closed, so that no count leaks.
//!
//! The number of times the loops wind around a face is known outside, and changes at a constraint by what that one is passed.
//! Coincident edges cancel by themselves.
//!
//! Cost: n log n in the points for loops that do not cross; every crossing is a point more, and a few rounds.

use std::collections::{BTreeSet, HashMap};

use glam::DVec2;
use robust::{Coord, orient2d};
use spade::handles::{DirectedEdgeHandle, FixedDirectedEdgeHandle, FixedVertexHandle};
use spade::{
    CdtEdge, ConstrainedDelaunayTriangulation, HasPosition, MIN_ALLOWED_VALUE as LEAST, Point2,
    Triangulation,
};

use super::slicer::share;
use crate::scene::Fill;

/// Times that crossing edges are cut.
const ROUNDS: usize = 12;
/// Points at which edges are cut, at most: a star of 1,400 edges that all cross each other.
const MOST_CUTS: usize = 1_000_000;

/// A filled region. Numbers of points count through the given ones, then through `added`.
#[derive(Debug, Default)]
pub(super) struct Filled {
    /// Where loops cross.
    pub(super) added: Vec<DVec2>,
    /// Counter-clockwise.
    pub(super) triangles: Vec<[u32; 3]>,
    /// Edges with the region on their left only.
    pub(super) boundary: Vec<[u32; 2]>,
    /// Loops that are not part of it.
    pub(super) left_out: Vec<usize>,
}

/// A point that knows its number.
struct Vertex {
    at: DVec2,
    number: u32,
}

impl HasPosition for Vertex {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        Point2::new(self.at.x, self.at.y)
    }
}

/// How often an edge is passed: in the direction of its first handle, less those in the other.
#[derive(Default)]
struct Passed {
    net: i32,
}

type Edge<'a> = DirectedEdgeHandle<'a, Vertex, (), CdtEdge<Passed>, ()>;
type Mesh = ConstrainedDelaunayTriangulation<Vertex, (), Passed, ()>;

/// An edge of a loop, or a part of one.
#[derive(Clone, Copy)]
struct Part {
    from: u32,
    to: u32,
    of_loop: usize,
}

/// Fills what loops enclose by a rule. Points must be finite.
pub(super) fn fill(points: &[DVec2], loops: &[Vec<u32>], rule: Fill) -> Filled {
    let mut outline = Outline::of(points, loops);
    let mut round = 0;
    while !outline.parts.is_empty() {
        let Some(drawn) = outline.draw() else {
            // Unreachable, for coordinates are in range. Without a triangulation nothing is filled.
            let all: Vec<usize> = (0..outline.parts.len()).collect();
            outline.leave_out(&all);
            break;
        };
        if drawn.failed.is_empty() {
            return outline.filled(&drawn.mesh, rule);
        }
        round += 1;
        if round > ROUNDS || !outline.cut(&drawn) {
            outline.leave_out(&drawn.failed);
        }
    }
    Filled {
        left_out: outline.left_out.into_iter().collect(),
        ..Filled::default()
    }
}

/// What is to be filled, scaled into the range of the triangulation by a power of two.
struct Outline {
    /// Units of the input per unit in here.
    unit: f64,
    /// Where vertices are, no two equal, and what their points are called.
    vertices: Vec<(DVec2, u32)>,
    vertex_at: HashMap<[u64; 2], u32>,
    parts: Vec<Part>,
    /// How many points were given.
    given: usize,
    /// Points at which parts were cut, in units of the input.
    added: Vec<DVec2>,
    left_out: BTreeSet<usize>,
}

/// A triangulation with the parts that could be made edges of it.
struct Drawn {
    mesh: Mesh,
    /// Per part that could, its edges in order.
    covered: Vec<(usize, FixedDirectedEdgeHandle)>,
    /// Parts that could not.
    failed: Vec<usize>,
}

impl Outline {
    fn of(points: &[DVec2], loops: &[Vec<u32>]) -> Self {
        let used = || loops.iter().flatten().map(|i| points[*i as usize]);
        let largest = used().fold(0.0_f64, |m, p| m.max(p.abs().max_element()));
        let exponent = if largest > 0.0 { largest.log2() } else { 0.0 };
        let unit = exponent.ceil().clamp(-1000.0, 1000.0).exp2();
        let mut outline = Self {
            unit,
            vertices: Vec::with_capacity(points.len()),
            vertex_at: HashMap::with_capacity(points.len()),
            parts: Vec::with_capacity(points.len()),
            given: points.len(),
            added: Vec::new(),
            left_out: BTreeSet::new(),
        };
        for (of_loop, one) in loops.iter().enumerate() {
            let vertices: Vec<u32> = one
                .iter()
                .map(|i| outline.vertex(points[*i as usize] / unit, Some(*i)))
                .collect();
            let next = vertices.iter().cycle().skip(1);
            for (from, to) in vertices.iter().zip(next) {
                outline.add(*from, *to, of_loop);
            }
        }
        outline
    }

    fn add(&mut self, from: u32, to: u32, of_loop: usize) {
        if from != to {
            self.parts.push(Part { from, to, of_loop });
        }
    }

    /// The vertex at a place; a new one is called by the point's number, or becomes a point.
    fn vertex(&mut self, at: DVec2, number: Option<u32>) -> u32 {
        // What is too little for the triangulation is zero, and there is only one zero.
        let at = DVec2::from(at.to_array().map(|c| if c.abs() < LEAST { 0.0 } else { c }));
        let next = self.vertices.len() as u32;
        let key = at.to_array().map(f64::to_bits);
        let vertex = *self.vertex_at.entry(key).or_insert(next);
        if vertex == next {
            let number = number.unwrap_or_else(|| {
                self.added.push(at * self.unit);
                (self.given + self.added.len() - 1) as u32
            });
            self.vertices.push((at, number));
        }
        vertex
    }

    /// Triangulates the vertices and makes edges of the parts.
    fn draw(&self) -> Option<Drawn> {
        let vertices = self.vertices.iter();
        let vertices = vertices.map(|(at, number)| Vertex {
            at: *at,
            number: *number,
        });
        // This way of loading keeps the order.
        let mut mesh = Mesh::bulk_load_cdt(vertices.collect(), Vec::new()).ok()?;
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
        Some(Drawn {
            mesh,
            covered,
            failed,
        })
    }

    /// Cuts the parts that could not be drawn, and what is in their way, where they meet. False if there is nothing to cut or
    /// too much.
    fn cut(&mut self, drawn: &Drawn) -> bool {
        let mesh = &drawn.mesh;
        let mut meetings = Vec::new();
        for failed in &drawn.failed {
            let part = self.parts[*failed];
            let ends = [part.from, part.to];
            let [from, to] = ends.map(|v| FixedVertexHandle::from_index(v as usize));
            let line = ends.map(|v| self.vertices[v as usize].0);
            for edge in mesh.get_conflicting_edges_between_vertices(from, to) {
                let other = edge.positions().map(|p| DVec2::new(p.x, p.y));
                let edge = edge.fix().as_undirected().index();
                meetings.push((*failed, edge, meeting(line, other)));
            }
            if self.added.len() + meetings.len() > MOST_CUTS {
                return false;
            }
        }
        if meetings.is_empty() {
            return false;
        }
        let mut on_parts = Vec::with_capacity(meetings.len());
        let mut on_edges = Vec::with_capacity(meetings.len());
        for (part, edge, at) in meetings {
            let vertex = self.vertex(at, None);
            on_parts.push((part, vertex));
            on_edges.push((edge, vertex));
        }
        on_parts.sort_unstable();
        on_edges.sort_unstable();
        let before = std::mem::take(&mut self.parts);
        for (i, edge) in &drawn.covered {
            let ends = mesh.directed_edge(*edge).vertices();
            let ends = ends.map(|v| v.fix().index() as u32);
            let cuts = of(&on_edges, edge.as_undirected().index());
            self.add_cut(ends, cuts, before[*i].of_loop);
        }
        for i in &drawn.failed {
            let part = before[*i];
            self.add_cut([part.from, part.to], of(&on_parts, *i), part.of_loop);
        }
        true
    }

    /// Adds what lies between cuts.
    fn add_cut(&mut self, ends: [u32; 2], cuts: &[(usize, u32)], of_loop: usize) {
        let at = |v: u32| self.vertices[v as usize].0;
        let [start, end] = ends.map(at);
        let mut along: Vec<u32> = cuts.iter().map(|(_, v)| *v).collect();
        let distance = |v: &u32| (at(*v) - start).dot(end - start);
        along.sort_by(|a, b| distance(a).total_cmp(&distance(b)));
        let mut from = ends[0];
        for to in along.into_iter().chain([ends[1]]) {
            self.add(from, to, of_loop);
            from = to;
        }
    }

    /// Takes out the loops that some parts belong to.
    fn leave_out(&mut self, parts: &[usize]) {
        self.left_out
            .extend(parts.iter().map(|i| self.parts[*i].of_loop));
        let left_out = &self.left_out;
        self.parts.retain(|p| !left_out.contains(&p.of_loop));
    }

    /// Counts from outside to every face, and takes those that the rule takes.
    fn filled(self, mesh: &Mesh, rule: Fill) -> Filled {
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
        let is_in = |face: usize| windings[face].is_some_and(|w| rule.holds(w));
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

/// Whether an edge runs in the direction that its count is for.
fn is_first(edge: FixedDirectedEdgeHandle) -> bool {
    edge.as_undirected().as_directed() == edge
}

/// What a sorted list has for a key.
fn of(sorted: &[(usize, u32)], key: usize) -> &[(usize, u32)] {
    let first = sorted.partition_point(|(k, _)| *k < key);
    let rest = &sorted[first..];
    &rest[..rest.partition_point(|(k, _)| *k == key)]
}

/// Where a line crosses an edge whose ends lie on both sides of it: on the edge, however flat they meet.
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
