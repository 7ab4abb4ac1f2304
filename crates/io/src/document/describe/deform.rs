//! Entries of `deform`.

use cutaway::scene::Amount;
use cutaway::scene::describe::{Described, OrWord};
use glam::DVec3;

use super::regions::AXIS_NAMES;

/// Kind of a deformer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Described)]
pub(crate) enum DeformKind {
    #[default]
    Twist,
    Bend,
    Wave,
    Inflate,
}

/// A deformer as stored in a file.
#[derive(Clone, Debug, Default, PartialEq, Described)]
pub(crate) struct DeformDesc {
    /// Kind of deformation.
    #[value(example = "twist")]
    pub(crate) kind: Option<DeformKind>,
    /// Axis of the deformation.
    #[value(words = AXIS_NAMES, example = [0, 1, 0])]
    pub(crate) axis: Option<OrWord<DVec3>>,
    /// Point on the axis.
    #[value(unit = "units", example = [0, 0, 0])]
    pub(crate) centre: Option<DVec3>,
    /// Direction to bend or wave towards.
    #[value(words = AXIS_NAMES, example = [1, 0, 0])]
    pub(crate) across: Option<OrWord<DVec3>>,
    /// Angle from one end to the other (twist, bend).
    #[value(unit = "degrees", example = 90)]
    pub(crate) turn_deg: Option<f64>,
    /// Amplitude of the wave.
    #[value(unit = "units", example = "2%")]
    pub(crate) amplitude: Option<Amount>,
    /// Wavelength.
    #[value(unit = "units", example = "25%")]
    pub(crate) period: Option<Amount>,
    /// Phase of the wave.
    #[value(unit = "degrees", example = 90)]
    pub(crate) phase_deg: f64,
    /// Displacement along the normal (inflate).
    #[value(unit = "units", example = "2%")]
    pub(crate) by: Option<Amount>,
}
