//! Hatch: lines on caps.

use glam::Vec3;

use super::lengths::{MIL, WIDEST};
use crate::scene::describe::Described;

/// Parallel lines on caps, fixed in scene units, so they stay in place while the camera moves. Touching parts have different hatches.
/// Lengths are in thousandths of the picture's height in the first view of the scene.
#[derive(Clone, Copy, Debug, PartialEq, Described)]
pub struct Hatch {
    /// Width of hatch lines on caps; 0 for none.
    #[value(range = 0.0..=WIDEST, unit = MIL, example = 1)]
    pub width: f32,
    /// Opacity of hatch lines.
    #[value(range = 0.0..=1.0, example = 0.6)]
    pub alpha: f32,
    /// Colour of hatch lines, instead of the line colour.
    #[value(example = "#9cc4ff")]
    pub color: Option<Vec3>,
    /// Line direction on the first part of a group of touching parts.
    #[value(unit = "degrees", example = 45)]
    pub angle_deg: f32,
    /// Line spacing as a multiple of the mean thickness of the part.
    #[value(range = 0.0..=10.0, example = 0.2)]
    pub per_thickness: f32,
    /// Smallest line spacing.
    #[value(range = 0.1..=1000.0, unit = MIL, example = 5.2)]
    pub least: f32,
    /// Largest line spacing.
    ///
    /// Parts that touch many others may have more.
    #[value(range = 0.1..=1000.0, unit = MIL, example = 9.5)]
    pub most: f32,
    /// Parts with a smaller mean thickness are filled instead of hatched.
    #[value(range = 0.0..=1000.0, unit = MIL, example = 2.9)]
    pub solid_below: f32,
    /// Frame that lines are fixed to: the moving part, or the cut.
    #[value(example = "cut")]
    pub anchor: HatchAnchor,
    /// Whether lines keep their spacing in the scene when the camera moves closer, or double and halve it.
    #[value(example = "banded")]
    pub zoom: HatchZoom,
}

/// Anchor of hatch lines.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, PartialOrd, Ord, Described)]
pub enum HatchAnchor {
    /// The part, if it moves as a whole: lines follow its rotation about the cut's normal and its shift.
    #[default]
    Part,
    /// The clip-surface.
    Cut,
}

/// Behaviour of the line spacing when the camera moves closer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, PartialOrd, Ord, Described)]
pub enum HatchZoom {
    /// Distances are fixed in the scene.
    #[default]
    Fixed,
    /// Distances are doubled or halved to stay near the style's distance in the picture; in between every second line thins out.
    Banded,
}

impl Default for Hatch {
    fn default() -> Self {
        Self {
            width: 0.0,
            alpha: 0.6,
            color: None,
            angle_deg: 45.0,
            per_thickness: 0.20,
            least: 5.2,
            most: 9.5,
            solid_below: 2.9,
            anchor: HatchAnchor::default(),
            zoom: HatchZoom::default(),
        }
    }
}

impl Hatch {
    /// Returns true if it draws anything.
    pub fn is_drawn(&self) -> bool {
        self.width > 0.0 && self.alpha > 0.0
    }
}
