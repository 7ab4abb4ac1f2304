//! Engraving: tone shown by lines on surfaces.

use super::lengths::MIL;
use crate::scene::describe::Described;

/// Parallel lines on surfaces, wider in darker areas. They are the intersections with a family of parallel planes fixed in the scene, so
/// they need no parametrisation and stay in place while the camera moves. Between two scales every second line thins out.
#[derive(Clone, Copy, Debug, PartialEq, Described)]
pub struct Engraving {
    /// Approximate distance between lines on surfaces (engraved).
    #[value(range = 1.0..=1000.0, unit = MIL, example = 6.7)]
    pub spacing: f32,
    /// Direction across the lines, in world space.
    ///
    /// May have any length except 0.
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
