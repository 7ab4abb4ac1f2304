//! Outward directions of positions: what inflating goes along.
//!
//! The direction at a position is the mean of the normals of the triangles around it, each weighted by its angle there, so
//! that it does not depend on how flat faces are cut into triangles (Thürmer and Wüthrich 1998). It is of the rest mesh.
//! Cost: once per mesh, in proportion to its triangles; 24 bytes a position. A mesh whose triangles are turned inside out
//! gets inward directions; a position that only flat triangles use, or none, gets zero.

use std::sync::{Arc, Mutex, PoisonError};

use glam::DVec3;

use super::{Deformer, Motion, is_same_motion};
use crate::scene::{Mesh, Part};

impl Mesh {
    /// The unit vectors out of the mesh at its positions; zero where there is none.
    pub fn outward(&self) -> Vec<DVec3> {
        let mut sums = vec![DVec3::ZERO; self.positions.len()];
        for (index, triangle) in self.triangles.iter().enumerate() {
            let corners = self.corners(index);
            let [a, b, c] = corners;
            let normal = (b - a).cross(c - a).normalize_or_zero();
            for i in 0..3 {
                let at = corners[i];
                let [to, from] = [corners[(i + 1) % 3] - at, corners[(i + 2) % 3] - at];
                let angle = to.cross(from).length().atan2(to.dot(from));
                sums[triangle[i] as usize] += normal * angle;
            }
        }
        sums.into_iter().map(DVec3::normalize_or_zero).collect()
    }
}

impl Part {
    /// Whether the pose inflates the mesh, but nobody has said yet where outward is.
    fn lacks_outward(&self) -> bool {
        let known = self.motion.as_ref().map_or(0, |m| m.outward.len());
        let deformers = self.pose.deformers.iter();
        known != self.mesh.positions.len()
            && deformers
                .into_iter()
                .any(|d| matches!(d, Deformer::Inflate { .. }))
    }

    /// Deforms the part in this pose, and finds what the deformers need to know of the mesh.
    pub fn deform(&mut self, deformers: Vec<Deformer>) {
        self.pose.deformers = deformers;
        if self.lacks_outward() {
            let outward = self.mesh.outward();
            Arc::make_mut(self.motion.get_or_insert_default()).outward = outward;
        }
    }
}

/// The motions that were given outward directions: each is made once, so that the same mesh has the same [`Motion`] at all
/// times.
#[derive(Debug, Default)]
pub struct Outwards(Mutex<Vec<Known>>);

/// Of which mesh and motion, and the motion with its directions.
type Known = (Arc<Mesh>, Option<Arc<Motion>>, Arc<Motion>);

impl Outwards {
    /// Gives a part the directions that its pose asks for.
    pub fn complete(&self, part: &mut Part) {
        if !part.lacks_outward() {
            return;
        }
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let found = known.iter().find(|(mesh, motion, _)| {
            Arc::ptr_eq(mesh, &part.mesh) && is_same_motion(motion.as_ref(), part.motion.as_ref())
        });
        let whole = match found {
            Some((.., whole)) => Arc::clone(whole),
            None => {
                let mut whole = part.motion.as_deref().cloned().unwrap_or_default();
                whole.outward = part.mesh.outward();
                let whole = Arc::new(whole);
                known.push((
                    Arc::clone(&part.mesh),
                    part.motion.clone(),
                    Arc::clone(&whole),
                ));
                whole
            }
        };
        part.motion = Some(whole);
    }
}
