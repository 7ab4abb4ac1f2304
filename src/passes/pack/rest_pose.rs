//! Rest-pose inputs of hatching, captured when the scene is first packed: contacts between parts, part thicknesses, and the picture's size
//! in the world. A hatch that followed the camera or a motion would swim.
//!
//! Kept by all [updates](super::model::Model::updated) of a model that have the same number of parts, however these change. Thicknesses and
//! contacts are computed on first request.

use std::sync::{Arc, OnceLock};

use glam::{DAffine3, DMat3, DQuat, DVec3};
use rayon::prelude::*;

use crate::scene::{Mesh, Prepared, Scene, classes, contacts};

/// Cells along the scene's diagonal, in the grid that finds contacts between parts.
const CELLS: f64 = 150.0;
/// Size of the picture from which the scene's size is derived; the aspect ratio matters little.
const FRAMED_PX: [u32; 2] = [1024, 768];

/// Motion of a part as a whole, in scene space.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Moved {
    pub(crate) turned: DQuat,
    /// Earlier position of its middle.
    pub(crate) start: DVec3,
    /// Current position of its middle.
    pub(crate) end: DVec3,
}

/// The parts of a scene as they were placed when first packed.
#[derive(Debug)]
pub(crate) struct RestPose {
    parts: Vec<(Arc<Mesh>, DAffine3)>,
    diagonal: f64,
    picture_height: f64,
    classes: OnceLock<Vec<u16>>,
    thicknesses: OnceLock<Vec<f64>>,
}

impl RestPose {
    /// Rest pose of a scene; the previous one is kept if it has the same number of parts.
    pub(crate) fn of(scene: &Scene, prepared: &Prepared, before: Option<&Arc<Self>>) -> Arc<Self> {
        if let Some(before) = before.filter(|b| b.parts.len() == scene.parts.len()) {
            return before.clone();
        }
        Arc::new(Self::new(scene, prepared))
    }

    fn new(scene: &Scene, prepared: &Prepared) -> Self {
        let parts = scene.parts.iter();
        Self {
            parts: parts.map(|p| (p.mesh.clone(), p.world_from_part)).collect(),
            diagonal: prepared.bounds.size().length() / prepared.scale,
            picture_height: picture_height(prepared),
            classes: OnceLock::new(),
            thicknesses: OnceLock::new(),
        }
    }

    /// Rest pose of a scene as if seen for the first time. Results for unchanged parts are not computed again.
    pub(crate) fn anew(&self, scene: &Scene, prepared: &Prepared) -> Self {
        let new = Self::new(scene, prepared);
        let is_same = |((mesh, at), (was, was_at)): (&(Arc<Mesh>, DAffine3), &(_, _))| {
            Arc::ptr_eq(mesh, was) && at == was_at
        };
        let pairs = || new.parts.iter().zip(&self.parts);
        match new.parts.len() == self.parts.len() && pairs().all(is_same) {
            true => Self {
                classes: self.classes.clone(),
                thicknesses: self.thicknesses.clone(),
                ..new
            },
            false => new,
        }
    }

    /// A class for each part, indexed as in the scene: touching parts have different classes.
    pub(crate) fn classes(&self) -> &[u16] {
        self.classes.get_or_init(|| {
            let cell = self.diagonal / CELLS;
            if self.parts.len() < 2 || !(cell > 0.0 && cell.is_finite()) {
                return vec![0; self.parts.len()];
            }
            let parts: Vec<_> = (self.parts.iter())
                .map(|(mesh, at)| (&**mesh, *at))
                .collect();
            classes(&contacts(&parts, cell))
        })
    }

    /// Mean thickness of each part in world units (twice its volume over its area), indexed as in the scene.
    pub(crate) fn thicknesses(&self) -> &[f64] {
        self.thicknesses.get_or_init(|| {
            let parts = self.parts.par_iter();
            let thickness = |(mesh, placed): &(Arc<Mesh>, DAffine3)| {
                let stretched = placed.matrix3.determinant().abs().cbrt();
                2.0 * mesh.volume().abs() / mesh.area() * stretched
            };
            parts.map(thickness).collect()
        })
    }

    /// Motion of each part since the rest pose, indexed as in the scene; `None` if the part stands still, bends or is stretched.
    pub(crate) fn moved(&self, scene: &Scene, prepared: &Prepared) -> Vec<Option<Moved>> {
        let to_scene = |p: DVec3| (p - prepared.centre_in_world) * prepared.scale;
        let parts = scene.parts.iter().zip(&self.parts);
        let moved = parts.map(|(part, (mesh, before))| {
            let is_posed = !(part.pose.joints.is_empty() && part.pose.deformers.is_empty());
            if part.world_from_part == *before || is_posed {
                return None;
            }
            let now_from_before = part.world_from_part * before.inverse();
            let turned = rotation_of(&now_from_before.matrix3)?;
            let middle = before.transform_point3(mesh.bounds().centre());
            Some(Moved {
                turned,
                start: to_scene(middle),
                end: to_scene(now_from_before.transform_point3(middle)),
            })
        });
        moved.collect()
    }

    /// Height of the picture in world units at the depth of the scene's middle, for the scene's camera in the rest pose.
    pub(crate) fn picture_height(&self) -> f64 {
        self.picture_height
    }
}

/// The map as a rotation, if it is one.
fn rotation_of(map: &DMat3) -> Option<DQuat> {
    let stretch = map.transpose() * *map - DMat3::IDENTITY;
    let is_rigid = stretch.to_cols_array().iter().all(|x| x.abs() < 1e-6);
    (is_rigid && map.determinant() > 0.0).then(|| DQuat::from_mat3(map))
}

fn picture_height(prepared: &Prepared) -> f64 {
    let view = prepared.view(FRAMED_PX);
    let middle = (prepared.bounds.min + prepared.bounds.max) / 2.0;
    // An eye within the scene has no meaningful depth.
    let radius = prepared.bounds.size().length() / 2.0;
    let depth = view.depth_of(middle).max(radius);
    2.0 * view.half_height * if view.orthographic { 1.0 } else { depth } / prepared.scale
}
