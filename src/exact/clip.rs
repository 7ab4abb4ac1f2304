//! Where a ray crosses a clip-surface.
//!
//! `F(P) = (P - O).N + f(T(P)).Sz` is the kept height: removed iff `F < 0`. A plane, or a relief whose texels are all
//! equal, has one root in closed form. For any other relief see [`super::relief`].
//!
//! Crossings alternate by construction: the side at the start of a range plus the number of crossings in it gives the
//! side at its end.

use glam::{DVec2, DVec3};

use super::outline::{NEAR_PX, change_per_px};
use super::relief::Relief;
use crate::scene::{PreparedSurface, View};

/// The ray of a sample.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ray {
    pub(super) origin: DVec3,
    pub(super) direction: DVec3,
}

impl Ray {
    /// The ray through a point of the picture.
    pub(super) fn through(view: &View, at_px: DVec2) -> Self {
        let (origin, direction) = view.ray(at_px);
        Self { origin, direction }
    }
}

/// A crossing of a ray with a clip-surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Root {
    /// Number of the surface.
    pub(super) surface: u16,
    /// Where.
    pub(super) depth: f64,
    /// The ray passes from the removed to the kept side.
    pub(super) to_kept: bool,
    /// Gradient of `F` in scene space.
    pub(super) gradient: DVec3,
    /// Coefficient of the square of the depth in `F` along the ray; 0 for a plane.
    pub(super) bend: f64,
}

impl Root {
    /// How much its depth may change when the sample moves by [`NEAR_PX`].
    pub(super) fn depth_change(&self, view: &View, ray: &Ray) -> f64 {
        let change = change_per_px(view, self.gradient, self.depth) * NEAR_PX;
        let slope = self.gradient.dot(ray.direction).abs();
        // Near a tangent point the square takes over from the slope.
        (change / slope).min((change / self.bend.abs()).sqrt())
    }
}

/// A place where a ray all but touches a clip-surface, or just crosses it twice: an extremum of `F` along the ray that
/// moving the sample by [`NEAR_PX`] may push to the other side of 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct Graze {
    /// Number of the surface.
    pub(super) surface: u16,
    /// Where the extremum is.
    pub(super) depth: f64,
    /// The surface is crossed just before and just behind.
    pub(super) crossed: bool,
}

/// A clip-surface ready for rays.
pub(super) struct Clip {
    number: u16,
    origin: DVec3,
    normal: DVec3,
    /// Height of a flat surface over its plane.
    offset: f64,
    relief: Option<Relief>,
}

impl Clip {
    /// Prepares a surface for rays within a ball around the origin of scene space.
    pub(super) fn of(number: u16, surface: &PreparedSurface, radius: f64) -> Self {
        let flat = surface
            .relief
            .as_ref()
            .map(|map| map.range())
            .filter(|[lo, hi]| lo == hi);
        Self {
            number,
            origin: surface.origin,
            normal: surface.frame.normal,
            offset: flat.map_or(0.0, |[lo, _]| f64::from(lo) * surface.height_scale),
            relief: match (&surface.relief, flat) {
                (Some(map), None) => Some(Relief::of(surface, map.clone(), radius)),
                _ => None,
            },
        }
    }

    /// Whether a triangle lies in the surface: only asked of flat ones, and only exact zeros count.
    pub(super) fn holds(&self, points: [DVec3; 3]) -> bool {
        self.relief.is_none()
            && points
                .iter()
                .all(|p| (*p - self.origin).dot(self.normal) + self.offset == 0.0)
    }

    /// Appends the crossings in `range` in order, and returns whether the ray is on the removed side at its start.
    pub(super) fn meet(
        &self,
        view: &View,
        ray: &Ray,
        range: [f64; 2],
        roots: &mut Vec<Root>,
        grazes: &mut Vec<Graze>,
    ) -> bool {
        let base = (ray.origin - self.origin).dot(self.normal) + self.offset;
        let slope = ray.direction.dot(self.normal);
        if let Some(relief) = &self.relief {
            let line = super::relief::PlaneLine { base, slope };
            return relief.meet(view, (self.number, line), ray, range, roots, grazes);
        }
        if slope == 0.0 {
            return base < 0.0;
        }
        let depth = -base / slope;
        if depth <= range[0] {
            return slope < 0.0;
        }
        if depth < range[1] {
            roots.push(Root {
                surface: self.number,
                depth,
                to_kept: slope > 0.0,
                gradient: self.normal,
                bend: 0.0,
            });
        }
        slope > 0.0
    }
}
