//! Bodies that are capped separately: if two overlap, each gets the cap that it would get alone, and halves are as manifold as the mesh.
//!
//! Bodies that share vertices are capped together, because a change to a vertex affects all its faces; so are all open bodies,
//! because their outlines may close each other.
//!
//! Cost: a pass over the triangles, plus that of [`Bodies`] if they are not all connected.

use crate::scene::meshes::topology::Sets;
use crate::scene::{Bodies, Mesh};

/// The group of each of the given triangles of a mesh.
pub(super) fn groups(mesh: &Mesh, triangles: &[[u32; 3]]) -> Vec<u32> {
    let mut sets = Sets::new(mesh.positions.len());
    for [a, b, c] in triangles {
        sets.join(*a, *b);
        sets.join(*b, *c);
    }
    let group = |sets: &mut Sets, t: &[u32; 3]| sets.find(t[0]);
    let first = triangles.first().map_or(0, |t| group(&mut sets, t));
    if triangles.iter().all(|t| group(&mut sets, t) == first) {
        return vec![0; triangles.len()];
    }
    let bodies = Bodies::of(&Mesh {
        positions: mesh.positions.clone(),
        triangles: triangles.to_vec(),
        ..Mesh::default()
    });
    let mut vertex_of: Vec<Option<u32>> = vec![None; bodies.count()];
    let mut open = None;
    for (triangle, body) in triangles.iter().zip(bodies.of_triangles()) {
        let body = *body as usize;
        let known = match bodies.closed()[body] {
            true => &mut vertex_of[body],
            false => &mut open,
        };
        match known {
            Some(known) => sets.join(*known, triangle[0]),
            None => *known = Some(triangle[0]),
        }
    }
    triangles.iter().map(|t| group(&mut sets, t)).collect()
}
