//! Deformers applied to a mesh, after targets and joints have posed it.
//!
//! Cost: each deformer once per position, and once more per corner of a triangle where the mesh has corner normals.

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use super::Deformer;
use crate::scene::Mesh;

/// Applies deformers in order. `outward` has a direction per position if any of them inflates; corner normals are transformed
/// with their surface.
pub(super) fn deform(mesh: &mut Mesh, outward: &[DVec3], deformers: &[Deformer]) {
    if deformers.is_empty() {
        return;
    }
    let start = |i: usize| {
        (
            mesh.positions[i],
            outward.get(i).copied().unwrap_or_default(),
        )
    };
    let along = |normal: Vec3, vertex: u32| {
        let mut at = start(vertex as usize);
        let mut normal = normal.as_dvec3();
        for deformer in deformers {
            normal = deformer.apply(at.0, normal).1;
            at = deformer.apply(at.0, at.1);
        }
        normal.normalize_or_zero().as_vec3()
    };
    let corner_normals = mesh.corner_normals.as_ref().map(|all| {
        all.par_iter()
            .zip(&mesh.triangles)
            .map(|(normals, triangle)| std::array::from_fn(|k| along(normals[k], triangle[k])))
            .collect()
    });
    let positions = (0..mesh.positions.len())
        .into_par_iter()
        .map(|i| {
            let moved = deformers.iter().fold(start(i), |at, d| d.apply(at.0, at.1));
            moved.0
        })
        .collect();
    mesh.corner_normals = corner_normals;
    mesh.positions = positions;
}
