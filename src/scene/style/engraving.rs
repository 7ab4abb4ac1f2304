//! Engraving: tone as lines on surfaces.

/// Parallel lines on surfaces, wider where it is darker: where the surface meets a family of parallel planes of the scene, so that they
/// need no parametrisation and stay where they are while the camera moves. Between two scales every second line thins out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Engraving {
    /// About the distance from line to line, in thousandths of the picture's height.
    pub spacing: f32,
    /// Across the lines, in coordinates of the world. Of any length but 0.
    pub across: [f32; 3],
    /// Across those of the second family, which dark tones have too.
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
