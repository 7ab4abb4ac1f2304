//! Meshes placed in the world, with their faces outward.

use glam::{DAffine3, DVec3};
use rayon::prelude::*;

use crate::scene::Mesh;

/// A mesh as placed in the world; if the placement mirrors, triangles are reversed, so that outside stays outside.
pub(super) fn in_world(mesh: &Mesh, placed: &DAffine3) -> Mesh {
    let is_mirrored = placed.matrix3.determinant() < 0.0;
    let positions: Vec<DVec3> = (mesh.positions.par_iter())
        .map(|p| placed.transform_point3(*p))
        .collect();
    let turned = |[a, b, c]: [u32; 3]| if is_mirrored { [a, c, b] } else { [a, b, c] };
    Mesh {
        positions,
        triangles: mesh.triangles.iter().map(|t| turned(*t)).collect(),
        ..Mesh::default()
    }
}
