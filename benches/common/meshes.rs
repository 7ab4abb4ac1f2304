//! The mesh that benches work on: a torus whose tube is ribbed along and around, closed, without a symmetry that a sort or a
//! tree could profit from.

use std::f64::consts::TAU;

use cutaway::scene::Mesh;
use glam::DVec3;

/// A ribbed torus of `2 * around * along` triangles.
pub(crate) fn ribbed_torus(around: u32, along: u32) -> Mesh {
    let at = |i: u32, j: u32| {
        let a = TAU * f64::from(i) / f64::from(around);
        let b = TAU * f64::from(j) / f64::from(along);
        let tube = 0.3 + 0.02 * (40.0 * a).sin() * (20.0 * b).cos();
        let radius = 1.0 + tube * b.cos();
        DVec3::new(radius * a.cos(), radius * a.sin(), tube * b.sin())
    };
    let cells = || (0..around).flat_map(|i| (0..along).map(move |j| (i, j)));
    let corner = |i: u32, j: u32| (i % around) * along + j % along;
    let triangles = cells().flat_map(|(i, j)| {
        let quad = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
        let [a, b, c, d] = quad.map(|(i, j)| corner(i, j));
        [[a, b, c], [a, c, d]]
    });
    Mesh {
        positions: cells().map(|(i, j)| at(i, j)).collect(),
        triangles: triangles.collect(),
        corner_normals: None,
        vertex_paint: None,
    }
}
