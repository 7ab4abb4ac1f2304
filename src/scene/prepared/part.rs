//! A part in scene space: posed, placed, rounded to f32 once, and split for shading.
//!
//! Large data is shared, so copies are cheap. A part that a device places has only its bounds and its triangles here.

use std::sync::Arc;

use glam::{DMat3, Vec3};
use rayon::prelude::*;

use super::SceneSpace;
use crate::scene::{
    Bounds, DEFAULT_CREASE_DEG, Faces, Fill, Material, Part, ShadingMesh, plane_tolerance,
};

/// A part in scene space.
#[derive(Clone, Debug)]
pub struct PreparedPart {
    /// Index in [`Scene::parts`](crate::Scene::parts).
    pub part: usize,
    /// Name of the part.
    pub name: String,
    /// Vertices in scene space, rounded to f32; empty if the device places them.
    pub positions: Arc<Vec<Vec3>>,
    /// Counter-clockwise from outside, indices of positions.
    pub triangles: Arc<Vec<[u32; 3]>>,
    /// Unit normals at the corners of `triangles`, in scene space, if the mesh has them.
    pub corner_normals: Option<Arc<Vec<[Vec3; 3]>>>,
    /// Vertices for drawing: `positions` split where the surface has a crease, each with a normal.
    pub shading: Arc<ShadingMesh>,
    /// True if its pose moves its vertices relative to each other.
    pub is_posed: bool,
    /// True if a pass of the frame computes the vertices from the part's pose and placement; they are absent here.
    pub is_on_device: bool,
    /// True if it is [whole](crate::scene::Role::Whole) and cuts remove it entirely: it has no triangles here.
    pub is_hidden: bool,
    /// True if some cut removes the whole part.
    pub is_removed: bool,
    /// Bounds of `positions`, or a box that contains the vertices that the device computes.
    pub bounds: Bounds,
    /// Maximum distance from a plane, in scene units, at which a face's vertices count as on it; 0 for posed parts.
    pub(crate) plane_tolerance: f64,
    /// Volume of the placed mesh in its rest pose, in world units; used to rank overlapping solids.
    pub volume_at_rest: f64,
    /// Look.
    pub material: Material,
    /// Fill rule of the mesh.
    pub fill: Fill,
    /// Indices into [`Prepared::cuts`](super::Prepared::cuts) of the cuts that apply.
    pub cuts: Vec<usize>,
}

impl PreparedPart {
    /// Moves a part, in its pose, to scene space. If the placement mirrors, triangle corners are reversed so that faces still
    /// point outward.
    pub(crate) fn place(index: usize, part: &Part, space: &SceneSpace, cuts: Vec<usize>) -> Self {
        let m = part.world_from_part;
        let mirrored = m.matrix3.determinant() < 0.0;
        let normal_from_part = normal_matrix(m.matrix3);
        let turned = |n: Vec3| {
            let turned = normal_from_part * n.as_dvec3();
            turned.normalize_or_zero().as_vec3()
        };
        let mesh = part.posed_mesh();
        let positions: Vec<Vec3> = (mesh.positions.par_iter())
            .map(|p| space.vertex(m.transform_point3(*p)))
            .collect();
        let triangles = mesh.triangles.par_iter();
        let mut placed = Self {
            bounds: Bounds::from_points(positions.iter().map(|p| p.as_dvec3())),
            positions: Arc::new(positions),
            triangles: Arc::new(triangles.map(|t| facing_out(*t, mirrored)).collect()),
            corner_normals: mesh.corner_normals.as_ref().map(|all| {
                let turned = all.iter().map(|n| facing_out(n.map(turned), mirrored));
                Arc::new(turned.collect())
            }),
            is_on_device: false,
            plane_tolerance: tolerance_of(part, &part.mesh.bounds(), space),
            ..Self::outline(index, part, Bounds::EMPTY, part.mesh.volume(), cuts)
        };
        placed.shading = Arc::new(ShadingMesh::new(placed.faces(), DEFAULT_CREASE_DEG));
        placed
    }

    /// Its triangles, as input to the split for shading.
    pub(crate) fn faces(&self) -> Faces<'_> {
        Faces {
            positions: &self.positions,
            triangles: &self.triangles,
            corner_normals: self.corner_normals.as_ref().map(|n| n.as_slice()),
        }
    }

    /// A part that the device places within `bounds`, from a mesh with the given volume in part space.
    pub(crate) fn outline(
        index: usize,
        part: &Part,
        bounds: Bounds,
        volume: f64,
        cuts: Vec<usize>,
    ) -> Self {
        Self {
            part: index,
            name: part.name.clone(),
            positions: Arc::default(),
            triangles: Arc::default(),
            corner_normals: None,
            shading: Arc::default(),
            is_on_device: true,
            is_hidden: false,
            is_removed: false,
            is_posed: !part.pose.is_rest(),
            bounds,
            plane_tolerance: 0.0,
            volume_at_rest: part.placed_volume(volume),
            material: part.material.clone(),
            fill: part.fill,
            cuts,
        }
    }
}

/// [`PreparedPart::plane_tolerance`] of a part whose mesh has the bounds `in_part`.
pub(crate) fn tolerance_of(part: &Part, in_part: &Bounds, space: &SceneSpace) -> f64 {
    match part.pose.is_rest() {
        true => plane_tolerance(in_part, &part.world_from_part, space),
        false => 0.0,
    }
}

/// The corners of a triangle, in reversed order if its placement mirrors.
pub(crate) fn facing_out<T>([a, b, c]: [T; 3], mirrored: bool) -> [T; 3] {
    if mirrored { [a, c, b] } else { [a, b, c] }
}

fn normal_matrix(m: DMat3) -> DMat3 {
    if m.determinant() == 0.0 {
        m
    } else {
        m.inverse().transpose()
    }
}
