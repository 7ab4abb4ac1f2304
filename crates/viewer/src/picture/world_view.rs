//! Projection of world-space points into a picture.

use cutaway::scene::View;
use glam::{DVec2, DVec3};

use crate::picture::shown::Shown;

/// A view, and where its scene lies in the world.
#[derive(Clone, Copy, Debug)]
pub struct WorldView {
    view: View,
    /// World-space position of the origin of scene space.
    centre: DVec3,
    /// Scene units per world unit.
    scale: f64,
}

impl WorldView {
    /// Creates the view of a scene for a picture with a size in pixels.
    pub fn of(shown: &Shown, size_px: [u32; 2]) -> Self {
        let prepared = &shown.at.model.prepared;
        Self {
            view: shown.view(size_px),
            centre: prepared.centre_in_world,
            scale: prepared.scale,
        }
    }

    /// Creates the view of a scene whose scene space is equal to world space.
    pub fn plain(view: View) -> Self {
        Self {
            view,
            centre: DVec3::ZERO,
            scale: 1.0,
        }
    }

    /// Projects a point; the result is in pixels from the upper left corner, `None` behind the near plane.
    pub fn project(&self, point: DVec3) -> Option<DVec2> {
        let (at, depth) = self.view.project((point - self.centre) * self.scale);
        (self.view.orthographic || depth > self.view.near).then_some(at)
    }
}
