//! Holes of open meshes, closed by triangles between existing vertices: planar holes of any size, and small holes.
//!
//! A hole is a closed path along edges that belong to only one triangle. It is
//! - *planar* if all its vertices are within [`PLANAR`] of the hole's size from a plane. Its triangles are those of the constrained
//!   Delaunay triangulation, as for caps; coplanar holes are filled together, so that the end of a pipe becomes a ring. If edges
//!   cross, or pass through vertices, nothing is filled.
//! - *small* if it has at most [`SMALL_EDGES`] edges, or if its perimeter is at most [`SMALL_SHARE`] of the diagonal of the mesh's box and
//!   it has at most [`MOST_EDGES`] edges. Its triangles are those of least total area (Barequet & Sharir, *Filling gaps in the boundary of
//!   a polyhedron*, 1995).
//!
//! Other holes stay open. No triangle is added that folds back onto its neighbour, as would happen when closing a sheet, or that
//! adds a second edge between two vertices, where three or four triangles would meet. So each open edge of a closed hole then
//! has two triangles with consistent orientation, as do all new edges. Vertices and existing triangles are unchanged.
//!
//! Cost: a sort of the edges; for planar holes n log n in their edges, for small ones their cube, about ten milliseconds for 256 edges.
//! Limits: edges between triangles with inconsistent orientation, and edges of three triangles, belong to no hole. Whether the filling
//! of a small hole meets other triangles farther away is not checked. Isolated triangles within a hole that is not planar stay isolated.

mod parts;
mod planar;
mod rims;
mod small;

use std::collections::{BTreeMap, BTreeSet};

use glam::DVec3;

use crate::scene::meshes::topology::EdgeUses;
use crate::scene::{Bounds, Mesh};
pub use parts::close_holes_of;
use planar::Plane;

/// Tolerance of a planar hole: distance of its vertices from a plane, as a share of the diagonal of its box. It covers the f32 rounding
/// error of a small hole far from the origin.
const PLANAR: f64 = 1e-4;

/// Maximum edges of a small hole, whatever its perimeter.
const SMALL_EDGES: usize = 12;

/// Maximum perimeter of a small hole, as a share of the diagonal of the mesh's box.
const SMALL_SHARE: f64 = 0.5;

/// Maximum edges of a hole that is closed because its perimeter is small.
const MOST_EDGES: usize = 256;

/// Cosine of the angle between neighbours' normals beyond which one is folded back onto the other: 179 degrees.
const FOLDED: f64 = -0.999_85;

/// A closed path along open edges.
#[derive(Clone, Debug, PartialEq)]
pub struct Hole {
    /// Its vertices in order, so that triangles inside are oriented like their neighbours.
    pub vertices: Vec<u32>,
    /// Why it stays open, if it does.
    pub defect: Option<HoleDefect>,
}

/// Why a hole is not closed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum HoleDefect {
    /// It is neither planar nor small.
    #[error("neither planar nor small")]
    Large,
    /// The filling would lie on its neighbours, as for the rim of a sheet.
    #[error("the filling would lie on the mesh itself")]
    Folded,
    /// It is planar, but its edges cross, or pass through vertices.
    #[error("its edges cross or touch")]
    Crossing,
    /// Every way to close it needs an edge that already exists.
    #[error("the filling would share an edge with other triangles")]
    Taken,
}

/// Triangles that close a mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Closing {
    /// Triangles to add.
    pub triangles: Vec<[u32; 3]>,
    /// All holes, ordered by their least vertices.
    pub holes: Vec<Hole>,
    /// Number of open edges that belong to no hole.
    pub loose_edges: usize,
}

/// Closes the planar and small holes of a mesh. Indices must be in range ([`Mesh::defect`]).
///
/// ```
/// use cutaway::generate::shapes::shape;
/// use cutaway::slice::close_holes;
///
/// let cube = shape("cube")?.remove(0);
/// let mut mesh = (*cube.mesh).clone();
/// assert_eq!(close_holes(&mesh).triangles.len(), 0);
/// mesh.triangles.truncate(10);
/// let closing = close_holes(&mesh);
/// mesh.triangles.extend(closing.triangles);
/// assert!(mesh.open_edges().is_empty() && (mesh.volume() - cube.mesh.volume()).abs() < 1e-12);
/// # Ok::<(), cutaway::Error>(())
/// ```
pub fn close_holes(mesh: &Mesh) -> Closing {
    let rims = rims::rims(&mesh.triangles);
    if rims.loops.is_empty() {
        return Closing {
            loose_edges: rims.loose,
            ..Closing::default()
        };
    }
    let mut surface = SurroundingSurface::around(mesh, &rims);
    let planes: Vec<Option<Plane>> = (rims.loops.iter())
        .map(|rim| Plane::of(mesh, rim))
        .collect();
    let mut closing = Closing {
        holes: (rims.loops.into_iter())
            .map(|vertices| Hole {
                vertices,
                defect: Some(HoleDefect::Large),
            })
            .collect(),
        loose_edges: rims.loose,
        ..Closing::default()
    };
    let diagonal = mesh.bounds().size().length();
    for group in planar::groups(&planes, diagonal) {
        for hole in surface.close_together(&mut closing, group, &planes) {
            let closed = surface.close(&mut closing, &[hole], &planes);
            closing.holes[hole].defect = closed.err();
        }
    }
    for hole in 0..closing.holes.len() {
        let may_be_small = matches!(
            closing.holes[hole].defect,
            Some(HoleDefect::Large | HoleDefect::Taken)
        );
        let rim = &closing.holes[hole].vertices;
        if !may_be_small || !small::is_small(mesh, rim, diagonal) {
            continue;
        }
        let found = small::triangles(mesh, rim, |ends| surface.has(ends));
        let closed = match found {
            Some(triangles) => (surface.checked(&closing.holes, &[hole], triangles))
                .map(|filling| surface.add(&mut closing.triangles, filling)),
            None => Err(HoleDefect::Taken),
        };
        closing.holes[hole].defect = closed.err();
    }
    closing
}

/// The surface around the holes.
struct SurroundingSurface<'a> {
    mesh: &'a Mesh,
    /// The normals of triangles at open edges, keyed by the edges in the direction of the holes.
    normals: BTreeMap<[u32; 2], DVec3>,
    /// Edges between vertices of holes, lesser vertex first.
    edges: BTreeSet<[u32; 2]>,
}

impl<'a> SurroundingSurface<'a> {
    fn around(mesh: &'a Mesh, rims: &rims::Rims) -> Self {
        let mut is_rim = vec![false; mesh.positions.len()];
        for vertex in rims.loops.iter().flatten() {
            is_rim[*vertex as usize] = true;
        }
        let mut surface = Self {
            mesh,
            normals: BTreeMap::new(),
            edges: BTreeSet::new(),
        };
        for ([low, high], uses) in EdgeUses::of(&mesh.triangles).runs() {
            if !(is_rim[low as usize] && is_rim[high as usize]) {
                continue;
            }
            surface.edges.insert([low, high]);
            let mut uses = uses;
            if let (Some(only), None) = (uses.next(), uses.next()) {
                let edge = if only.is_down {
                    [low, high]
                } else {
                    [high, low]
                };
                let corners = mesh.corners(only.triangle as usize);
                surface.normals.insert(edge, normal(corners));
            }
        }
        surface
    }

    fn has(&self, ends: [u32; 2]) -> bool {
        self.edges.contains(&sorted(ends))
    }

    /// Closes those holes in one plane that can be closed together, and returns the others.
    fn close_together(
        &mut self,
        closing: &mut Closing,
        group: Vec<usize>,
        planes: &[Option<Plane>],
    ) -> Vec<usize> {
        if group.len() < 2 {
            return group;
        }
        if self.close(closing, &group, planes).is_ok() {
            return Vec::new();
        }
        // A hole that cannot be closed alone must not keep others from being closed together. All are tried together first: closed alone,
        // the two rims at the end of a pipe would become two disks.
        let can_alone = |hole: &usize| self.filling(&closing.holes, &[*hole], planes).is_ok();
        let (able, unable): (Vec<usize>, Vec<usize>) = group.iter().partition(|h| can_alone(h));
        let is_subset = able.len() > 1 && !unable.is_empty();
        match is_subset && self.close(closing, &able, planes).is_ok() {
            true => unable,
            false => group,
        }
    }

    /// Closes holes in one plane.
    fn close(
        &mut self,
        closing: &mut Closing,
        holes: &[usize],
        planes: &[Option<Plane>],
    ) -> Result<(), HoleDefect> {
        let filling = self.filling(&closing.holes, holes, planes)?;
        self.add(&mut closing.triangles, filling);
        for hole in holes {
            closing.holes[*hole].defect = None;
        }
        Ok(())
    }

    /// Triangles that close the given coplanar holes.
    fn filling(
        &self,
        holes: &[Hole],
        numbers: &[usize],
        planes: &[Option<Plane>],
    ) -> Result<Filling, HoleDefect> {
        let plane = planes[numbers[0]].as_ref().ok_or(HoleDefect::Large)?;
        let rims: Vec<&[u32]> = (numbers.iter())
            .map(|hole| holes[*hole].vertices.as_slice())
            .collect();
        let triangles = plane.triangles(self.mesh, &rims)?;
        self.checked(holes, numbers, triangles)
    }

    /// Triangles that close exactly the given holes and agree with the surface.
    fn checked(
        &self,
        holes: &[Hole],
        numbers: &[usize],
        triangles: Vec<[u32; 3]>,
    ) -> Result<Filling, HoleDefect> {
        let mut open: BTreeSet<[u32; 2]> = BTreeSet::new();
        for number in numbers {
            open.extend(edges_of(&holes[*number].vertices));
        }
        let mut inner: BTreeMap<[u32; 2], i32> = BTreeMap::new();
        for t in &triangles {
            for [a, b] in edges_of(t) {
                if open.remove(&[a, b]) {
                    let folded = self.normals[&[a, b]].dot(normal(t.map(|i| self.at(i))));
                    if folded < FOLDED {
                        return Err(HoleDefect::Folded);
                    }
                } else {
                    *inner.entry(sorted([a, b])).or_default() += if a < b { 1 } else { -1 };
                }
            }
        }
        let is_whole = open.is_empty() && inner.values().all(|net| *net == 0);
        if !is_whole || inner.keys().any(|ends| self.edges.contains(ends)) {
            return Err(HoleDefect::Taken);
        }
        Ok(Filling {
            triangles,
            edges: inner.into_keys().collect(),
        })
    }

    fn add(&mut self, all: &mut Vec<[u32; 3]>, filling: Filling) {
        self.edges.extend(filling.edges);
        all.extend(filling.triangles);
    }

    fn at(&self, vertex: u32) -> DVec3 {
        self.mesh.positions[vertex as usize]
    }
}

/// Triangles that close holes.
struct Filling {
    triangles: Vec<[u32; 3]>,
    /// Edges of the filling that belong to no hole, lesser vertex first.
    edges: Vec<[u32; 2]>,
}

/// The edges of a closed path.
fn edges_of(rim: &[u32]) -> impl Iterator<Item = [u32; 2]> {
    let next = rim.iter().cycle().skip(1);
    rim.iter().zip(next).map(|(a, b)| [*a, *b])
}

fn sorted([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

/// The unit normal of a triangle, or zero if it has none.
fn normal([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a).normalize_or_zero()
}

/// Total length of the edges of a closed path.
fn perimeter(points: &[DVec3]) -> f64 {
    let next = points.iter().cycle().skip(1);
    points.iter().zip(next).map(|(a, b)| a.distance(*b)).sum()
}

fn points_of(mesh: &Mesh, rim: &[u32]) -> Vec<DVec3> {
    rim.iter().map(|i| mesh.positions[*i as usize]).collect()
}

fn box_of(points: &[DVec3]) -> Bounds {
    Bounds::from_points(points.iter().copied())
}
