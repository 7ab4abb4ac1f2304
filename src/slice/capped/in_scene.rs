//! Faces of a part that lie in a plane, decided exactly as when the scene is drawn.
//!
//! Cost: for each plane a pass over all vertices.

use rayon::prelude::*;

use super::super::SlicePlane;
use super::complex::{Complex, MarkedPlane};
use crate::scene::{Candidates, FacesInPlane, Mesh, Part, SceneSpace, tolerance_of};

/// Space in which faces are tested, and the tolerance for their vertices there.
pub(super) struct InScene {
    space: SceneSpace,
    tolerance: f64,
}

impl InScene {
    /// The space and tolerance for a part of a scene.
    pub(super) fn of(part: &Part, space: &SceneSpace) -> Self {
        Self {
            space: *space,
            tolerance: tolerance_of(part, &part.mesh.bounds(), space),
        }
    }

    /// The faces of a world-space mesh that lie in a plane.
    fn faces_in(&self, mesh: &Mesh, plane: &SlicePlane, is_inside_out: bool) -> FacesInPlane {
        let flat = self.space.flat(&plane.flat());
        let position = |i: u32| self.space.vertex(mesh.positions[i as usize]).as_dvec3();
        let is_near: Vec<bool> = (0..mesh.positions.len() as u32)
            .into_par_iter()
            .with_min_len(1 << 12)
            .map(|i| flat.height(position(i)).abs() <= self.tolerance)
            .collect();
        let near = (mesh.triangles.par_iter().enumerate().with_min_len(1 << 12))
            .filter(|(_, t)| t.iter().all(|i| is_near.get(*i as usize) == Some(&true)));
        flat.faces_in(Candidates {
            triangles: &mesh.triangles,
            position,
            near: near.map(|(t, _)| t as u32).collect(),
            tolerance: self.tolerance,
            is_inside_out: &|| is_inside_out,
        })
    }
}

impl Complex<'_> {
    /// Marks the faces that were decided to lie in planes, and marks their vertices as lying on those planes.
    pub(super) fn take_in(&mut self, decided: &InScene) {
        for MarkedPlane { plane, mark } in self.planes.clone() {
            let faces = decided.faces_in(self.mesh, &plane, self.is_inside_out);
            if !faces.is_empty() {
                let vertices = self.positions.par_iter().zip(&mut self.marks);
                vertices.with_min_len(1 << 12).for_each(|(at, marks)| {
                    if faces.holds(decided.space.vertex(*at).as_dvec3()) {
                        *marks |= mark;
                    }
                });
            }
            self.in_planes.push(faces);
        }
    }
}
