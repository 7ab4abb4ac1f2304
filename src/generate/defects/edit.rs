//! A mesh being edited: faces can be added and removed, vertices can only be added.

use glam::{DVec3, Vec3};

use crate::scene::{Bounds, Mesh};

/// A face with its shading normals.
#[derive(Clone, Copy, Debug)]
pub(super) struct ShadedFace {
    pub(super) corners: [u32; 3],
    /// Shading normals at the corners, if the mesh has any.
    normals: Option<[Vec3; 3]>,
}

impl ShadedFace {
    /// The face with reversed orientation.
    pub(super) fn turned(self) -> Self {
        let [a, b, c] = self.corners;
        Self {
            corners: [a, c, b],
            normals: self.normals.map(|[a, b, c]| [-a, -c, -b]),
        }
    }

    /// The same face with its corner indices replaced, in order.
    pub(super) fn with_corners(self, corners: [u32; 3]) -> Self {
        Self { corners, ..self }
    }

    /// The face split in two through `vertex`, which lies on edge `edge` (from corner `edge` to the next corner).
    pub(super) fn halves(self, edge: usize, vertex: u32) -> [Self; 2] {
        let next = (edge + 1) % 3;
        let [mut first, mut second] = [self; 2];
        (first.corners[next], second.corners[edge]) = (vertex, vertex);
        if let (Some(one), Some(two)) = (&mut first.normals, &mut second.normals) {
            let between = (one[edge] + one[next]).normalize_or_zero();
            (one[next], two[edge]) = (between, between);
        }
        [first, second]
    }
}

/// A mesh while it is edited.
pub(super) struct Edit {
    /// The remaining faces; may be empty.
    pub(super) faces: Vec<ShadedFace>,
    positions: Vec<DVec3>,
    /// Per vertex, the vertex of the mesh it comes from.
    origins: Vec<u32>,
    has_normals: bool,
    /// The mesh's bounding box, which no vertex may leave.
    pub(super) bounds: Bounds,
}

impl Edit {
    /// Starts editing an unchanged mesh.
    pub(super) fn of(mesh: &Mesh) -> Self {
        let normals = |t: usize| mesh.corner_normals.as_ref().map(|n| n[t]);
        let faces = mesh.triangles.iter().enumerate();
        Self {
            faces: faces
                .map(|(t, corners)| ShadedFace {
                    corners: *corners,
                    normals: normals(t),
                })
                .collect(),
            positions: mesh.positions.clone(),
            origins: (0..mesh.positions.len() as u32).collect(),
            has_normals: mesh.corner_normals.is_some(),
            bounds: mesh.bounds(),
        }
    }

    /// Position of a vertex.
    pub(super) fn at(&self, vertex: u32) -> DVec3 {
        self.positions[vertex as usize]
    }

    /// Positions of the corners of a face.
    pub(super) fn points(&self, face: &ShadedFace) -> [DVec3; 3] {
        face.corners.map(|v| self.at(v))
    }

    /// Adds a vertex derived from another one.
    pub(super) fn add(&mut self, at: DVec3, from: u32) -> u32 {
        self.origins.push(self.origins[from as usize]);
        self.positions.push(at);
        self.positions.len() as u32 - 1
    }

    /// The edited mesh, and per vertex the original vertex it comes from.
    pub(super) fn finish(self) -> (Mesh, Vec<u32>) {
        let normals = || self.faces.iter().filter_map(|f| f.normals).collect();
        let mesh = Mesh {
            corner_normals: self.has_normals.then(normals),
            // Deliberately broken meshes are shown without vertex paint.
            vertex_paint: None,
            triangles: self.faces.iter().map(|f| f.corners).collect(),
            positions: self.positions,
        };
        (mesh, self.origins)
    }
}
