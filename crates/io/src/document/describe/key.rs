//! `[[key]]`.

use cutaway::scene::describe::Described;

use super::ByHand;

/// Interpolation between two values of a key.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Described)]
pub enum Interpolation {
    /// Linear interpolation.
    #[default]
    Linear,
    /// Keeps the earlier value until the later time.
    Step,
    /// Cubic interpolation with zero slope at both ends.
    Smooth,
}

/// An animation key as stored in a file.
#[derive(Clone, Debug, Default, PartialEq, Described)]
pub(crate) struct KeyDesc {
    /// Path of the animated value.
    #[value(example = "camera.azimuth_deg")]
    pub(crate) target: Option<String>,
    /// Times, ascending.
    #[value(unit = "s", fixed, example = [0, 2])]
    pub(crate) times_s: ByHand,
    /// Value at each time.
    #[value(fixed, example = [0, 360])]
    pub(crate) values: ByHand,
    /// Interpolation between times.
    #[value(example = "smooth")]
    pub(crate) interpolation: Option<Interpolation>,
}
