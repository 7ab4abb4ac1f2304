//! Faces on the same three positions as another face, in whichever order: doubled triangles, and solids that touch.
//!
//! Positions are compared, not indices, so that what nobody welded counts too. Two faces on each other cancel for parity, and leave
//! a mesh closed that has no inside there.
//!
//! Cost: a parallel sort of the positions and one of the triangles.

use glam::DVec3;
use rayon::prelude::*;

use crate::scene::Mesh;

/// How many faces lie on another: both of a pair.
pub(super) fn faces(mesh: &Mesh) -> usize {
    let places = places(&mesh.positions);
    let mut faces: Vec<[u32; 3]> = (mesh.triangles.par_iter())
        .map(|t| {
            let mut corners = t.map(|i| places[i as usize]);
            corners.sort_unstable();
            corners
        })
        .collect();
    faces.par_sort_unstable();
    let groups = faces.chunk_by(|a, b| a == b).map(<[_]>::len);
    groups.filter(|count| *count > 1).sum()
}

/// A number for each position: the same where all coordinates are, and nowhere else.
fn places(positions: &[DVec3]) -> Vec<u32> {
    // Adding 0 makes 0 of -0.
    let key = |i: &u32| {
        (positions[*i as usize] + DVec3::ZERO)
            .to_array()
            .map(f64::to_bits)
    };
    let mut order: Vec<u32> = (0..positions.len() as u32).collect();
    order.par_sort_unstable_by_key(key);
    let mut places = vec![0; positions.len()];
    for (place, same) in (0..).zip(order.chunk_by(|a, b| key(a) == key(b))) {
        for i in same {
            places[*i as usize] = place;
        }
    }
    places
}
