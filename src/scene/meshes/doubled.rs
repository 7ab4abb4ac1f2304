//! Faces with the same three positions as another face, in any order: sheets without thickness, and solids that touch.
//!
//! Positions are compared, not indices, so vertices that were not welded count too. Of two coincident faces, the one that faces the eye is
//! shown; rasterisers compute the same depth for both, so they need the list of these faces.
//!
//! Cost: one hash per position and a parallel sort of one hash per triangle, by ranges of hashes; faces are compared
//! only if their hashes are equal.

use glam::DVec3;
use rayon::prelude::*;

use super::buckets::{Buckets, bits_for};
use super::equal_positions::hash;
use crate::scene::Mesh;

/// The triangles that coincide with another one, in order; both of a pair are listed.
pub(crate) fn doubled_faces(mesh: &Mesh) -> Vec<u32> {
    let hashes: Vec<u64> = (mesh.positions.par_iter().with_min_len(1 << 13))
        .map(|p| hash(*p))
        .collect();
    let bits = bits_for(mesh.triangles.len());
    let buckets = Buckets::of(&mesh.triangles, 1 << bits, |index, t| {
        // Independent of the order of the corners.
        let [a, b, c] = t.map(|i| hashes[i as usize]);
        let sum = a.wrapping_add(b).wrapping_add(c);
        let bucket = sum.rotate_left(bits) as usize & ((1 << bits) - 1);
        [(bucket, (sum, index as u32))]
    });
    let corners = |index: u32| {
        let mut corners = mesh
            .corners(index as usize)
            .map(|p| (p + DVec3::ZERO).to_array());
        corners.sort_by(|a, b| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal));
        corners
    };
    let doubled_in = |order: &[(u64, u32)]| -> Vec<u32> {
        (order.chunk_by(|a, b| a.0 == b.0))
            .filter(|alike| alike.len() > 1)
            .flat_map(|alike| {
                let is_on_another = |(_, t): &&(u64, u32)| {
                    let mut others = alike.iter().filter(|(_, other)| other != t);
                    others.any(|(_, other)| corners(*other) == corners(*t))
                };
                alike.iter().filter(is_on_another).map(|(_, t)| *t)
            })
            .collect()
    };
    let doubled = buckets.par_map_sorted(doubled_in).flatten_iter();
    let mut doubled: Vec<u32> = doubled.collect();
    doubled.sort_unstable();
    doubled
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::shapes;

    #[test]
    fn faces_on_each_other_are_found_whatever_their_lists_begin_with() {
        let mut mesh = (*shapes::shape("cube").unwrap_or_else(|e| panic!("{e}"))[0].mesh).clone();
        assert!(
            doubled_faces(&mesh).is_empty(),
            "no face of a cube lies on another"
        );
        let count = mesh.triangles.len() as u32;
        let [a, b, c] = mesh.triangles[3];
        for (i, again) in [[a, b, c], [c, b, a], [b, a, c]].into_iter().enumerate() {
            // The added face has its own vertices.
            let first = mesh.positions.len() as u32;
            let own = again.map(|i| mesh.positions[i as usize]);
            mesh.positions.extend(own);
            mesh.triangles.push([first, first + 1, first + 2]);
            let wanted: Vec<u32> = [3].into_iter().chain(count..=count + i as u32).collect();
            assert_eq!(doubled_faces(&mesh), wanted);
        }
    }
}
