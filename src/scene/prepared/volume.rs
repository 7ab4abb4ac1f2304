//! A cutter in scene space: placed and rounded to f32 once, like parts.
//!
//! Large data is shared. Orientation is not kept: parity decides what is inside, and normals are those of the triangle or of its
//! smooth patch, turned towards the viewer.

use std::sync::Arc;

use glam::{DAffine3, Vec3};

use super::SceneSpace;
use crate::scene::{Bounds, Cutter, DEFAULT_CREASE_DEG, Faces, Mesh, ShadingMesh};

/// A closed mesh in scene space, whose inside is the removed side of a clip-surface.
#[derive(Clone, Debug)]
pub struct PreparedVolume {
    /// Name of the cutter.
    pub name: String,
    /// Vertices in scene space, rounded to f32.
    pub positions: Arc<Vec<Vec3>>,
    /// The original mesh, whose triangles are indices into `positions`.
    pub mesh: Arc<Mesh>,
    /// Vertices for shading its caps, if it is smooth: `positions` split at creases, each with a normal.
    pub shading: Option<Arc<ShadingMesh>>,
    /// Bounds of `positions`.
    pub bounds: Bounds,
    /// True if the outside is the removed side.
    pub keeps_inside: bool,
    placement: DAffine3,
    space: SceneSpace,
}

impl PreparedVolume {
    /// Moves a cutter to scene space; reuses data of the previous placement that is still valid.
    pub(crate) fn place(cutter: &Cutter, space: &SceneSpace, before: Option<&Self>) -> Self {
        let placement = cutter.world_from_cutter;
        let known = before.filter(|b| {
            Arc::ptr_eq(&b.mesh, cutter.mesh()) && b.placement == placement && b.space == *space
        });
        let positions = known.map_or_else(
            || {
                let all = cutter.mesh().positions.iter();
                let placed = all.map(|p| space.point(placement.transform_point3(*p)).as_vec3());
                Arc::new(placed.collect::<Vec<_>>())
            },
            |k| k.positions.clone(),
        );
        let shading = cutter.is_smooth.then(|| {
            let still = known.and_then(|k| k.shading.clone());
            still.unwrap_or_else(|| {
                let faces = Faces {
                    positions: &positions,
                    triangles: &cutter.mesh().triangles,
                    corner_normals: None,
                };
                Arc::new(ShadingMesh::new(faces, DEFAULT_CREASE_DEG))
            })
        });
        Self {
            name: cutter.name().to_owned(),
            bounds: known.map_or_else(
                || Bounds::from_points(positions.iter().map(|p| p.as_dvec3())),
                |k| k.bounds,
            ),
            positions,
            shading,
            mesh: cutter.mesh().clone(),
            keeps_inside: cutter.keeps_inside,
            placement,
            space: *space,
        }
    }

    /// Corners of the triangles, as vertex indices.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.mesh.triangles
    }
}
