//! Triangle meshes as used throughout the crate: f64 positions shared by index.
//!
//! Topology is in `triangles`; each position is stored once, so an edge is a pair of indices. Shading normals are
//! kept per triangle corner and never influence topology. A mesh may be open, non-manifold or inconsistently oriented;
//! it may not have NaN, infinite coordinates or indices out of range ([`Mesh::defects`] lists them).

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use crate::scene::{Bounds, VertexPaint};

/// Number of vertices or triangles that a thread takes at once.
const SHARE: usize = 1 << 14;

/// An indexed triangle mesh in part space.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Vertex positions.
    pub positions: Vec<DVec3>,
    /// Counter-clockwise seen from outside, indices into `positions`.
    pub triangles: Vec<[u32; 3]>,
    /// Shading normals at the corners of `triangles`, if the file has them.
    pub corner_normals: Option<Vec<[Vec3; 3]>>,
    /// Colours that vary over the surface, one entry per triangle.
    pub vertex_paint: Option<VertexPaint>,
}

/// The first of many items for which this holds, with its index.
fn first<T: Copy + Send + Sync>(of: &[T], holds: impl Fn(&T) -> bool + Sync) -> Option<(usize, T)> {
    let shares = of.par_chunks(SHARE).enumerate();
    shares.find_map_first(|(share, some)| {
        let place = some.iter().position(&holds)?;
        Some((share * SHARE + place, some[place]))
    })
}

/// Reason why a mesh is refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MeshDefect {
    /// No triangles.
    #[error("it has no triangles")]
    Empty,
    /// A coordinate that is NaN or infinite.
    #[error("vertex {vertex} has the coordinate {value}")]
    NotFinite {
        /// Index of the vertex, from 0.
        vertex: usize,
        /// The coordinate.
        value: f64,
    },
    /// A triangle corner that refers to a missing vertex.
    #[error("triangle {triangle} refers to vertex {index}, but there are only {vertices}")]
    OutOfRange {
        /// Index of the triangle, from 0.
        triangle: usize,
        /// The invalid vertex index.
        index: u32,
        /// Number of vertices.
        vertices: usize,
    },
}

impl Mesh {
    /// The first defect for which the mesh is refused, if any.
    pub fn defect(&self) -> Option<MeshDefect> {
        if self.triangles.is_empty() {
            return Some(MeshDefect::Empty);
        }
        let not_finite = first(&self.positions, |p| !p.is_finite());
        if let Some((vertex, p)) = not_finite {
            let mut values = p.to_array().into_iter().filter(|c| !c.is_finite());
            let value = values.next().unwrap_or(f64::NAN);
            return Some(MeshDefect::NotFinite { vertex, value });
        }
        let vertices = self.positions.len();
        let is_outside = |i: &&u32| **i as usize >= vertices;
        let (triangle, t) = first(&self.triangles, |t| t.iter().any(|i| is_outside(&i)))?;
        t.iter()
            .find(is_outside)
            .map(|index| MeshDefect::OutOfRange {
                triangle,
                index: *index,
                vertices,
            })
    }

    /// The smallest box around the positions.
    pub fn bounds(&self) -> Bounds {
        let shares = self.positions.par_chunks(SHARE);
        shares
            .map(|some| Bounds::from_points(some.iter().copied()))
            .reduce(|| Bounds::EMPTY, Bounds::union)
    }

    /// The corners of a triangle.
    pub fn corners(&self, triangle: usize) -> [DVec3; 3] {
        self.triangles[triangle].map(|i| self.positions[i as usize])
    }

    /// The given triangles as a separate mesh, and the original index of each of its vertices, in order.
    #[doc(hidden)]
    pub fn picked(&self, triangles: &[u32]) -> (Self, Vec<u32>) {
        let corners = triangles.iter().map(|t| self.triangles[*t as usize]);
        let mut vertices: Vec<u32> = corners.clone().flatten().collect();
        vertices.sort_unstable();
        vertices.dedup();
        let number = |i: u32| vertices.partition_point(|v| *v < i) as u32;
        let of_triangles = |n: &Vec<_>| triangles.iter().map(|t| n[*t as usize]).collect();
        let picked = Self {
            positions: (vertices.iter())
                .map(|v| self.positions[*v as usize])
                .collect(),
            triangles: corners.map(|t| t.map(number)).collect(),
            corner_normals: self.corner_normals.as_ref().map(of_triangles),
            vertex_paint: self
                .vertex_paint
                .as_ref()
                .map(|vertex_paint| vertex_paint.picked(triangles)),
        };
        (picked, vertices)
    }

    /// Signed volume by the divergence theorem: exact up to rounding for closed, consistently oriented meshes.
    pub fn volume(&self) -> f64 {
        let origin = self.bounds().centre();
        let six = self.sum_of_triangles(|corners| {
            let [a, b, c] = corners;
            (a - origin).dot((b - origin).cross(c - origin))
        });
        six / 6.0
    }

    /// Surface area.
    pub fn area(&self) -> f64 {
        0.5 * self.sum_of_triangles(|[a, b, c]| (b - a).cross(c - a).length())
    }

    /// Sums a quantity of the corners of each triangle. Rounding does not depend on the number of threads.
    pub(crate) fn sum_of_triangles(&self, of: impl Fn([DVec3; 3]) -> f64 + Sync) -> f64 {
        let at = |i: u32| self.positions[i as usize];
        let of_share = |some: &[[u32; 3]]| {
            // Without `map` on arrays, which is not inlined here and takes twice the time.
            some.iter()
                .map(|&[a, b, c]| of([at(a), at(b), at(c)]))
                .sum()
        };
        let shares = self.triangles.par_chunks(SHARE).map(of_share);
        shares.collect::<Vec<f64>>().into_iter().sum()
    }
}
