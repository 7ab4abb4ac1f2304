//! Promise: with `close_holes` planar and small holes of a mesh are closed by triangles that are turned as their neighbours are, what is
//! neither stays open and is said, and a closed mesh stays what it is.

mod command_line;
mod real;
mod solids;

use crate::common::{command, data};

use command::Scratch;
use cutaway::scene::{Mesh, Topology};
use cutaway::slice::{Closing, close_holes};
use glam::DVec3;

/// The mesh with what closes it.
fn closed(mesh: &Mesh) -> (Mesh, Closing) {
    let closing = close_holes(mesh);
    let mut closed = mesh.clone();
    closed.triangles.extend(&closing.triangles);
    (closed, closing)
}

/// Each edge has two triangles, which agree which side is out.
fn is_sound(facts: &Topology) -> bool {
    facts.closed
        && facts.boundary_edges + facts.non_manifold_edges + facts.inconsistent_edges == 0
        && facts.coincident_faces == 0
}

fn mesh(positions: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> Mesh {
    Mesh {
        positions,
        triangles,
        corner_normals: None,
        vertex_paint: None,
    }
}

/// A cube of side 1 whose sides are `n` by `n` squares.
fn cube(n: u32) -> Mesh {
    let mut positions = Vec::new();
    let mut number = std::collections::BTreeMap::new();
    let mut triangles = Vec::new();
    for axis in 0..3 {
        for (side, at) in [(0, 0), (1, n)] {
            let mut corner = |i: u32, j: u32| {
                let mut key = [0; 3];
                (key[axis], key[(axis + 1) % 3], key[(axis + 2) % 3]) = (at, i, j);
                *number.entry(key).or_insert_with(|| {
                    positions.push(DVec3::from(key.map(f64::from)) / f64::from(n));
                    positions.len() as u32 - 1
                })
            };
            for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
                let [a, b, c, d] =
                    [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(k, l)| corner(i + k, j + l));
                triangles.extend(match side {
                    0 => [[a, c, b], [a, d, c]],
                    _ => [[a, b, c], [a, c, d]],
                });
            }
        }
    }
    mesh(positions, triangles)
}
