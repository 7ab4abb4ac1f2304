//! The axis that points up, and directions by azimuth and elevation about it.

use glam::DVec3;

use crate::scene::describe::Described;

/// Up axis of the world.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Described)]
pub enum Up {
    /// The convention in graphics.
    #[default]
    #[value(name = "+Y")]
    PlusY,
    /// The convention in CAD and 3D printing.
    #[value(name = "+Z")]
    PlusZ,
}

impl Up {
    /// The other up axis.
    #[must_use]
    pub fn other(self) -> Self {
        match self {
            Self::PlusY => Self::PlusZ,
            Self::PlusZ => Self::PlusY,
        }
    }

    /// Unit vector of the axis.
    pub fn axis(self) -> DVec3 {
        match self {
            Self::PlusY => DVec3::Y,
            Self::PlusZ => DVec3::Z,
        }
    }

    /// The unit vector from the target to an eye at some azimuth and elevation.
    pub fn direction(self, [azimuth_deg, elevation_deg]: [f64; 2]) -> DVec3 {
        let (sin_a, cos_a) = azimuth_deg.to_radians().sin_cos();
        let (sin_e, cos_e) = elevation_deg.to_radians().sin_cos();
        match self {
            Self::PlusY => DVec3::new(sin_a * cos_e, sin_e, cos_a * cos_e),
            Self::PlusZ => DVec3::new(sin_a * cos_e, -cos_a * cos_e, sin_e),
        }
    }

    /// Azimuth and elevation of an eye in a direction, in degrees: the inverse of [`Up::direction`].
    pub fn angles(self, direction: DVec3) -> [f64; 2] {
        let d = direction.normalize_or(DVec3::Z);
        let [azimuth, height] = match self {
            Self::PlusY => [d.x.atan2(d.z), d.y],
            Self::PlusZ => [d.x.atan2(-d.y), d.z],
        };
        [
            azimuth.to_degrees(),
            height.clamp(-1.0, 1.0).asin().to_degrees(),
        ]
    }
}
