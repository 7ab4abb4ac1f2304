//! Reassembles triangles that were divided unnecessarily.
//!
//! Planes extend beyond the regions that they bound, and divide whatever they meet there. If all parts of a mesh triangle end up in
//! the same state, the triangle is reassembled. On its sides it keeps the vertices that are also used by faces that are not reassembled;
//! its neighbours across a side apply the same test to the same vertices, so that no edge opens.
//!
//! Cost: a sort of the parts of divided triangles, and a pass over all faces.

use std::collections::BTreeMap;

use super::complex::{Complex, ComplexFace, divided};
use crate::scene::meshes::weld::has_three;

/// A mesh triangle that can be reassembled: the vertices on its sides, and one of its faces.
struct Whole {
    face: ComplexFace,
    corners: [u32; 3],
    sides: [Vec<u32>; 3],
}

impl Complex<'_> {
    /// Reassembles triangles that need not be divided.
    pub(super) fn restore(&mut self) {
        let mut parts_of = vec![0_u32; self.mesh.triangles.len()];
        let of_mesh = |f: &&ComplexFace| f.plane().is_none();
        for face in self.faces.iter().filter(of_mesh) {
            parts_of[face.source as usize] += 1;
        }
        let mut parts: Vec<ComplexFace> = (self.faces.iter().filter(of_mesh))
            .filter(|f| parts_of[f.source as usize] > 1)
            .copied()
            .collect();
        parts.sort_by_key(|f| f.source);
        let wholes: Vec<Whole> = (parts.chunk_by(|a, b| a.source == b.source))
            .filter(|run| run.iter().all(|f| f.state == run[0].state))
            .filter_map(|run| {
                let corners = self.mesh.triangles[run[0].source as usize];
                Some(Whole {
                    face: run[0],
                    corners,
                    sides: sides(run, corners)?,
                })
            })
            .collect();
        if wholes.is_empty() {
            return;
        }
        let mut is_whole = vec![false; self.mesh.triangles.len()];
        for whole in &wholes {
            is_whole[whole.face.source as usize] = true;
        }
        self.faces
            .retain(|f| f.plane().is_some() || !is_whole[f.source as usize]);
        // Vertices of the mesh stay: a triangle without area may have been left out because its side passed through one.
        let mut is_needed = vec![true; self.mesh.positions.len()];
        is_needed.resize(self.positions.len(), false);
        for i in self.faces.iter().flat_map(|f| f.corners) {
            is_needed[i as usize] = true;
        }
        let mut triangles = Vec::new();
        for Whole {
            face,
            corners,
            mut sides,
        } in wholes
        {
            for side in &mut sides {
                side.retain(|i| is_needed[*i as usize]);
            }
            triangles.clear();
            divided(&self.positions, corners, sides, &mut triangles);
            let faces = triangles
                .iter()
                .filter(|t| has_three(t))
                .map(|corners| ComplexFace {
                    corners: *corners,
                    ..face
                });
            self.faces.extend(faces);
        }
    }
}

/// The vertices on the sides of a triangle, from each corner to the next, if the boundary of its parts is one loop through the corners.
fn sides(parts: &[ComplexFace], corners: [u32; 3]) -> Option<[Vec<u32>; 3]> {
    let edges = |f: &ComplexFace| {
        let [a, b, c] = f.corners;
        [[a, b], [b, c], [c, a]]
    };
    let all: Vec<[u32; 2]> = parts.iter().flat_map(edges).collect();
    let mut next = BTreeMap::new();
    for [from, to] in all.iter().filter(|[from, to]| !all.contains(&[*to, *from])) {
        if next.insert(*from, *to).is_some() {
            return None;
        }
    }
    let mut passed = 0;
    let mut way = |from: u32, to: u32| {
        let mut side = Vec::new();
        let mut at = from;
        while passed < next.len() {
            passed += 1;
            at = *next.get(&at)?;
            if at == to {
                return Some(side);
            }
            side.push(at);
        }
        None
    };
    let [a, b, c] = corners;
    let sides = [way(a, b)?, way(b, c)?, way(c, a)?];
    let is_all = passed == next.len();
    let has_corner = sides.iter().flatten().any(|i| corners.contains(i));
    (is_all && !has_corner).then_some(sides)
}

#[cfg(test)]
mod tests {
    use super::super::complex::FaceState;
    use super::*;

    fn parts(triangles: &[[u32; 3]]) -> Vec<ComplexFace> {
        let part = |corners: &[u32; 3]| ComplexFace {
            corners: *corners,
            source: 0,
            state: FaceState::Kept,
            group: 0,
        };
        triangles.iter().map(part).collect()
    }

    #[test]
    fn the_sides_of_a_divided_triangle_are_found_again() {
        // Corners 0, 1, 2; 3 and 4 on the first side, 5 inside.
        let whole = [[0, 3, 5], [3, 4, 5], [4, 1, 5], [1, 2, 5], [2, 0, 5]];
        let found = sides(&parts(&whole), [0, 1, 2]);
        assert_eq!(found, Some([vec![3, 4], vec![], vec![]]));
        assert_eq!(
            sides(&parts(&[whole[0], whole[2], whole[4]]), [0, 1, 2]),
            None,
            "parts meet in a vertex alone"
        );
        assert_eq!(
            sides(&parts(&whole), [0, 2, 1]),
            None,
            "it faces the other way"
        );
        assert_eq!(
            sides(&parts(&whole), [0, 1, 7]),
            None,
            "a corner became another vertex"
        );
    }
}
