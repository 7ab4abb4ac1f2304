//! Triangle meshes as used throughout the crate: f64 positions shared by index.
//!
//! Topology is in `triangles`; each position is stored once, so an edge is a pair of indices. Shading normals are
//! kept per triangle corner and never influence topology. A mesh may be open, non-manifold or inconsistently oriented;
//! it may not have NaN, infinite coordinates or indices out of range ([`Mesh::defects`] lists them).

use glam::{DVec3, Vec3};

use crate::scene::{Bounds, VertexPaint};

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
        let not_finite = self.positions.iter().enumerate().find_map(|(vertex, p)| {
            p.to_array()
                .into_iter()
                .find(|c| !c.is_finite())
                .map(|value| MeshDefect::NotFinite { vertex, value })
        });
        let vertices = self.positions.len();
        not_finite.or_else(|| {
            self.triangles.iter().enumerate().find_map(|(triangle, t)| {
                t.iter()
                    .find(|i| **i as usize >= vertices)
                    .map(|index| MeshDefect::OutOfRange {
                        triangle,
                        index: *index,
                        vertices,
                    })
            })
        })
    }

    /// The smallest box around the positions.
    pub fn bounds(&self) -> Bounds {
        Bounds::from_points(self.positions.iter().copied())
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
        let six = (0..self.triangles.len())
            .map(|t| {
                let [a, b, c] = self.corners(t).map(|p| p - origin);
                a.dot(b.cross(c))
            })
            .sum::<f64>();
        six / 6.0
    }

    /// Surface area.
    pub fn area(&self) -> f64 {
        let twice = (0..self.triangles.len())
            .map(|t| {
                let [a, b, c] = self.corners(t);
                (b - a).cross(c - a).length()
            })
            .sum::<f64>();
        twice * 0.5
    }
}
