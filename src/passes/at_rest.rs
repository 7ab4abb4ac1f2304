//! What of a scene its hatches hang on, held from the first frame that asks: who touches whom, how thick parts are, and how large the
//! picture is in the scene. A hatch that followed the camera or a motion would swim.

use std::sync::{Arc, OnceLock};

use glam::DAffine3;

use crate::scene::{Bounds, Mesh, Scene, View, classes, contacts};

/// Cells of the grid in which parts meet, along the diagonal of the scene.
const CELLS: f64 = 150.0;

/// The parts of a scene as they were placed when it was packed.
#[derive(Debug, Default)]
pub(crate) struct AtRest {
    parts: Vec<(Arc<Mesh>, DAffine3)>,
    bounds: Option<Bounds>,
    classes: OnceLock<Vec<u16>>,
    picture_height: OnceLock<f64>,
}

impl AtRest {
    /// Of a scene; what was held before stays, if it has as many parts.
    pub(super) fn of(scene: &Scene, bounds: Bounds, before: Option<&Arc<Self>>) -> Arc<Self> {
        if let Some(before) = before.filter(|b| b.parts.len() == scene.parts.len()) {
            return before.clone();
        }
        let parts = scene.parts.iter();
        Arc::new(Self {
            parts: parts.map(|p| (p.mesh.clone(), p.world_from_part)).collect(),
            bounds: Some(bounds),
            ..Self::default()
        })
    }

    /// A class for each part, by its index in the scene: parts that touch have unlike ones.
    pub(crate) fn classes(&self) -> &[u16] {
        self.classes.get_or_init(|| {
            let bounds = self.bounds.unwrap_or(Bounds::EMPTY);
            let cell = bounds.size().length() / CELLS;
            if self.parts.len() < 2 || !(cell > 0.0 && cell.is_finite()) {
                return vec![0; self.parts.len()];
            }
            let parts: Vec<_> = (self.parts.iter())
                .map(|(mesh, at)| (&**mesh, *at))
                .collect();
            classes(&contacts(&parts, &bounds, cell))
        })
    }

    /// Mean thickness of a part in world units: twice its volume over its area.
    pub(crate) fn thickness(&self, part: usize) -> f64 {
        let (mesh, placed) = &self.parts[part];
        let stretched = placed.matrix3.determinant().abs().cbrt();
        2.0 * mesh.volume().abs() / mesh.area() * stretched
    }

    /// Height of the picture in scene units at the depth of the middle of the scene.
    pub(crate) fn picture_height(&self, view: &View, middle: glam::DVec3) -> f64 {
        *self.picture_height.get_or_init(|| {
            let depth = (middle - view.eye).dot(view.forward).max(view.near);
            let rows = f64::from(view.band[1]);
            view.plane_per_px() * rows * if view.orthographic { 1.0 } else { depth }
        })
    }
}
