//! Scene space: its position in the world, and conversions to it.

use glam::{DAffine3, DMat3, DVec3, Vec3};

use crate::scene::{Bounds, FlatSurface};

/// Transform from world to scene space: `scene = (world - centre) * scale`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SceneSpace {
    /// Centre of scene space in world space.
    pub centre_in_world: DVec3,
    /// Scene units per world unit, a power of two.
    pub scale: f64,
}

impl SceneSpace {
    /// The identity, for data that is already in scene space.
    pub(crate) const ITSELF: Self = Self {
        centre_in_world: DVec3::ZERO,
        scale: 1.0,
    };

    /// The space in which a box has a radius between 1/2 and 1.
    pub fn new(world: &Bounds) -> Self {
        let radius = world.radius();
        let scale = if radius > 0.0 && radius.is_finite() {
            (-radius.log2().ceil()).exp2()
        } else {
            1.0
        };
        // 2^-10 of the radius: few enough bits that the offset is exact for coordinates that have few bits themselves.
        let grid = 1.0 / (scale * 1024.0);
        Self {
            centre_in_world: (world.centre() / grid).round() * grid,
            scale,
        }
    }

    /// Converts a point from world space.
    pub fn point(&self, world: DVec3) -> DVec3 {
        (world - self.centre_in_world) * self.scale
    }

    /// Converts a point from world space and rounds it to `f32`, as for vertices.
    pub(crate) fn vertex(&self, world: DVec3) -> Vec3 {
        self.point(world).as_vec3()
    }

    /// Converts a flat clip-surface from world space, to the form of [`PreparedSurface::flat`].
    pub(crate) fn flat(&self, world: &FlatSurface) -> FlatSurface {
        FlatSurface {
            origin: rounded_near(self.point(world.origin)),
            normal: world.normal,
            lift: world.lift * self.scale,
        }
    }

    /// The transform from world space.
    pub fn from_world(&self) -> DAffine3 {
        DAffine3::from_mat3_translation(
            DMat3::from_diagonal(DVec3::splat(self.scale)),
            -self.centre_in_world * self.scale,
        )
    }
}

/// Coordinates up to this are rounded like those of vertices; the model's coordinates reach up to 1.
pub(super) const NEAR_MODEL: f64 = 4.0;

/// The origin of a clip-surface, rounded like vertices if it is near the model.
pub(super) fn rounded_near(origin: DVec3) -> DVec3 {
    DVec3::from_array((origin.to_array()).map(|c| match c.abs() <= NEAR_MODEL {
        true => f64::from(c as f32),
        false => c,
    }))
}
