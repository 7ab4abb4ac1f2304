//! Promise: with `split` each connected body is a part, named, coloured, hatched and moved as parts are, and nothing is lost or torn.

mod command_line;
mod files;
mod hatches;
mod order;
mod real;

use crate::common::{command, data, session};

use command::Scratch;
use cutaway::scene::{Mesh, Part};
use glam::DVec3;

/// Two cubes beside each other, the second with a cavity, and a larger one behind, as OBJ: three bodies.
fn three_bodies() -> String {
    [
        cube(DVec3::ZERO, 1.0, false),
        cube(DVec3::X * 3.0, 1.0, false),
        cube(DVec3::Y * 3.0, 1.5, false),
        cube(DVec3::Y * 3.0, 0.5, true),
    ]
    .iter()
    .enumerate()
    .map(|(i, mesh)| obj(mesh, 8 * i as u32))
    .collect()
}

fn cube(centre: DVec3, size: f64, faces_in: bool) -> Mesh {
    let corner = |i: u32| DVec3::new(f64::from(i & 1), f64::from((i >> 1) & 1), f64::from(i >> 2));
    let quads = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let triangles = quads
        .iter()
        .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
    Mesh {
        positions: (0..8).map(|i| centre + (corner(i) - 0.5) * size).collect(),
        triangles: triangles
            .map(|[a, b, c]| if faces_in { [a, c, b] } else { [a, b, c] })
            .collect(),
        corner_normals: None,
        vertex_paint: None,
    }
}

fn obj(mesh: &Mesh, before: u32) -> String {
    let vertices = mesh.positions.iter();
    let mut text: String = vertices
        .map(|p| format!("v {} {} {}\n", p.x, p.y, p.z))
        .collect();
    for t in &mesh.triangles {
        let [a, b, c] = t.map(|i| i + before + 1);
        text.push_str(&format!("f {a} {b} {c}\n"));
    }
    text
}

/// The triangles of posed and placed parts as a set: corners to the bit, each from its least on.
fn triangles_of(parts: &[Part]) -> Vec<[[u64; 3]; 3]> {
    let mut all = Vec::new();
    for part in parts {
        let mesh = part.posed_mesh();
        all.extend((0..mesh.triangles.len()).map(|t| {
            let at = |p: DVec3| part.world_from_part.transform_point3(p);
            let mut corners = mesh.corners(t).map(|p| at(p).to_array().map(f64::to_bits));
            let least = (0..3).min_by_key(|i| corners[*i]).unwrap_or(0);
            corners.rotate_left(least);
            corners
        }));
    }
    all.sort_unstable();
    all
}

fn names(parts: &[Part]) -> Vec<&str> {
    parts.iter().map(|p| p.name.as_str()).collect()
}
