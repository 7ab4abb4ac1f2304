//! Planes through vertices, in the middle of symmetric shapes for instance: no triangle without length is left, and a program that joins
//! vertices in one place, as all do that read STL, finds the halves as closed as the shape.

use super::*;
use crate::common::meshes::{SHAPES, parts};

/// Vertices nearer than this are one to programs that read meshes, in units of the file.
const ONE: f64 = 1e-8;

/// Whether each edge has two triangles where coordinates are those of f32 and vertices in one place are one. No triangle is left out.
fn is_watertight_elsewhere(mesh: &Mesh) -> bool {
    let place = |p: &DVec3| {
        let at = p.as_vec3().as_dvec3() / ONE;
        at.to_array().map(|c| c.round() as i64)
    };
    let places: Vec<[i64; 3]> = mesh.positions.iter().map(place).collect();
    let edges = |[a, b, c]: &[u32; 3]| {
        [[*a, *b], [*b, *c], [*c, *a]].map(|edge| {
            let mut ends = edge.map(|end| places[end as usize]);
            ends.sort_unstable();
            ends
        })
    };
    let mut edges: Vec<_> = mesh.triangles.iter().flat_map(edges).collect();
    edges.sort_unstable();
    edges.chunk_by(|a, b| a == b).all(|uses| uses.len() == 2)
}

/// The shortest edge, as a share of the diagonal.
fn shortest(mesh: &Mesh) -> f64 {
    let size = mesh.bounds().size().length();
    let edges = (0..mesh.triangles.len()).flat_map(|t| {
        let [a, b, c] = mesh.corners(t);
        [a.distance(b), b.distance(c), c.distance(a)]
    });
    edges.fold(f64::INFINITY, f64::min) / size
}

#[test]
fn halves_of_all_shapes_are_as_closed_as_they_are_in_other_programs() {
    let mut halved = 0;
    for name in SHAPES.into_iter().chain(["crank", "gears", "column"]) {
        for part in parts(name) {
            let mesh = &part.mesh;
            if !is_watertight_elsewhere(mesh) || shortest(mesh) < 1e-6 {
                continue;
            }
            for normal in [DVec3::X, DVec3::Y, DVec3::Z, DVec3::new(1.0, 2.0, 3.0)] {
                let what = format!("{name}, {}: middle, {normal}", part.name);
                let regions = [vec![plane(mesh.bounds().centre(), normal)]];
                let halves = checked(&what, mesh, &regions);
                for half in [&halves.kept.mesh, &halves.removed.mesh] {
                    assert!(is_watertight_elsewhere(half), "{what}");
                    assert!(shortest(half) > 1e-8, "{what}: {}", shortest(half));
                }
                halved += 1;
            }
        }
    }
    assert!(halved > 40, "{halved} cuts were looked at");
}

#[test]
fn a_plane_through_vertices_leaves_no_triangle_without_area() {
    let cube = crate::common::meshes::block(DVec3::ZERO, DVec3::ONE);
    for normal in [
        [0.3, 0.5, 0.8],
        [1.0, 2.0, 3.0],
        [1.0, 1.0, 0.0],
        [-1.0, 1.0, 2.0],
    ] {
        let what = format!("{normal:?}");
        let regions = [vec![plane(DVec3::splat(0.5), DVec3::from(normal))]];
        let halves = checked(&what, &cube, &regions);
        for half in [&halves.kept.mesh, &halves.removed.mesh] {
            for t in 0..half.triangles.len() {
                let [a, b, c] = half.corners(t);
                let area = 0.5 * (b - a).cross(c - a).length();
                assert!(area > 1e-12, "{what}: triangle {t} has the area {area:e}");
            }
            assert!((half.volume() - 0.5).abs() < 1e-12, "{what}");
        }
    }
}

#[test]
fn small_edges_of_the_mesh_itself_stay() {
    // A ball of a billionth of the size of all beside a cube, with the plane through both.
    let cube = crate::common::meshes::block(DVec3::ZERO, DVec3::ONE);
    let small = ball(DVec3::new(0.5, 0.5, 3.0), 1e-9, 1);
    let both = crate::common::meshes::joined(&[cube, small.clone()]);
    let halves = checked("small", &both, &[vec![plane(DVec3::splat(0.2), DVec3::X)]]);
    let (whole, kept) = (both.triangles.len(), &halves.kept.mesh);
    let of_small = (0..kept.triangles.len()).filter(|t| kept.corners(*t)[0].z > 2.0);
    assert_eq!(of_small.count(), small.triangles.len(), "of {whole}");
}

#[test]
fn a_sliver_is_noticed() {
    let mut cube = crate::common::meshes::block(DVec3::ZERO, DVec3::ONE);
    assert!(is_watertight_elsewhere(&cube));
    // An edge between two vertices in one place, on an edge of two triangles.
    let [a, b, c] = cube.triangles[0];
    let beside = cube.positions[a as usize] + DVec3::splat(1e-12);
    let new = cube.positions.len() as u32;
    cube.positions.push(beside);
    cube.triangles[0] = [new, b, c];
    cube.triangles.extend([[a, b, new], [a, new, c]]);
    assert!(!is_watertight_elsewhere(&cube));
    assert!(shortest(&cube) < 1e-8);
}
