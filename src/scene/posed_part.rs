//! Moving parts: evaluated at a time in their file's clips, placed, deformed, and posed on the CPU.
//!
//! The motion of vertices is in [`motion`](super::motion); this module applies it to parts.

use std::borrow::Cow;
use std::sync::Arc;

use glam::DAffine3;

use super::memo::{ById, Memo};
use super::motion::{Moment, Reach, posed};
use super::{Bounds, Clip, Deformer, Mesh, Motion, Part};

impl Part {
    /// The animations that the part's file has.
    pub fn clips(&self) -> &[Clip] {
        self.driver.as_ref().map_or(&[], |d| d.clips())
    }

    /// The part placed and posed by a clip of [`Part::clips`] at a time; its deformers are kept. Before a clip starts the first key
    /// applies, after its end the last. A clip that the file lacks, or that does not move the part, leaves it in its rest pose. If the part
    /// comes from a file, changes to the mesh or to `world_from_part` that were not made by [`Part::place`] are lost.
    #[must_use]
    pub fn at_time(&self, clip: usize, time_s: f64) -> Self {
        let mut part = self.clone();
        if let Some(driver) = &self.driver {
            let driven = driver.at(Moment { clip, time_s });
            (part.mesh, part.world_from_part) = (driven.mesh, driven.world_from_part);
            part.motion = driven.motion;
            (part.pose.weights, part.pose.joints) = (driven.weights, driven.joints);
        }
        part
    }

    /// Places the part as a whole, in all poses and at all times.
    pub fn place(&mut self, placed: DAffine3) {
        self.world_from_part = placed * self.world_from_part;
        if let Some(driver) = &mut self.driver {
            Arc::make_mut(driver).place(placed);
        }
    }

    /// The mesh in the part's pose, in part space. Corner normals are transformed by joints and deformers, but not by morph targets:
    /// they only affect shading.
    pub fn posed_mesh(&self) -> Cow<'_, Mesh> {
        if self.pose.is_rest() {
            return Cow::Borrowed(&self.mesh);
        }
        let still = Motion::default();
        let motion = self.motion.as_deref().unwrap_or(&still);
        Cow::Owned(posed(&self.mesh, motion, &self.pose))
    }

    /// Bounds of the posed mesh in part space: they contain every posed position, and may be a little larger than needed.
    /// Cheap for parts from files, whose meshes are measured once; other meshes are measured on every call.
    pub fn posed_bounds(&self) -> Bounds {
        let measured = self
            .driver
            .as_ref()
            .and_then(|d| d.reach_of(&self.mesh, self.motion.as_ref()));
        let posed = match measured {
            _ if !self.pose.deformers.is_empty() => None,
            Some(reach) => reach.posed(&self.pose),
            None if self.pose.is_rest() => Some(self.mesh.bounds()),
            None => Reach::of(&self.mesh, self.motion.as_deref()).posed(&self.pose),
        };
        posed.unwrap_or_else(|| self.posed_mesh().bounds())
    }

    /// Returns true if the pose inflates the mesh and its outward directions are not computed yet.
    fn lacks_outward(&self) -> bool {
        let known = self.motion.as_ref().map_or(0, |m| m.outward.len());
        let deformers = self.pose.deformers.iter();
        known != self.mesh.positions.len()
            && deformers
                .into_iter()
                .any(|d| matches!(d, Deformer::Inflate { .. }))
    }

    /// Deforms the part in this pose, and computes the mesh data that the deformers need.
    pub fn deform(&mut self, deformers: Vec<Deformer>) {
        self.pose.deformers = deformers;
        if self.lacks_outward() {
            let outward = self.mesh.outward();
            Arc::make_mut(self.motion.get_or_insert_default()).outward = outward;
        }
    }
}

/// Cache of motions with outward directions: each is created once, so that the same mesh has the same [`Motion`] at all
/// times.
#[derive(Debug, Default)]
pub struct Outwards(Memo<MeshAndMotion, Arc<Motion>>);

type MeshAndMotion = (ById<Mesh>, Option<ById<Motion>>);

impl Outwards {
    /// Gives a part the outward directions that its pose needs.
    pub fn complete(&self, part: &mut Part) {
        if !part.lacks_outward() {
            return;
        }
        let key = (ById(part.mesh.clone()), ById::of(part.motion.as_ref()));
        let whole = self.0.get_or_make(key, |_| {
            let mut whole = part.motion.as_deref().cloned().unwrap_or_default();
            whole.outward = part.mesh.outward();
            Arc::new(whole)
        });
        part.motion = Some(whole);
    }
}
