//! Engraving: tone as lines on surfaces.

use super::lengths::MIL;
use crate::scene::describe::Described;

/// Parallel lines on surfaces, wider where it is darker: where the surface meets a family of parallel planes of the scene, so that they
/// need no parametrisation and stay where they are while the camera moves. Between two scales every second line thins out.
#[derive(Clone, Copy, Debug, PartialEq, Described)]
pub struct Engraving {
    /// Approximate distance between lines on surfaces (engraved).
    #[value(range = 1.0..=1000.0, unit = MIL, example = 6.7)]
    pub spacing: f32,
    /// Direction across the lines, in the world.
    ///
    /// Of any length but 0.
    #[value(example = [1, 0.25, 0.1])]
    pub across: [f32; 3],
    /// Direction across the second set of lines, drawn in dark tones only.
    #[value(example = [0.2, 1, 0.5])]
    pub across_dark: [f32; 3],
}

impl Default for Engraving {
    fn default() -> Self {
        Self {
            spacing: 6.7,
            across: [1.0, 0.25, 0.1],
            across_dark: [0.2, 1.0, 0.5],
        }
    }
}
