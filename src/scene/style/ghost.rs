//! Ghost: removed geometry that is still drawn.

use glam::Vec3;

use super::lengths::{MIL, WIDEST};
use crate::scene::describe::Described;

/// How solids are drawn where a cut has removed parts of them.
#[derive(Clone, Copy, Debug, PartialEq, Described)]
pub struct Ghost {
    /// Drawing of removed geometry.
    #[value(example = "lines")]
    pub kind: GhostKind,
    /// Width of phantom lines.
    #[value(range = 0.0..=WIDEST, unit = MIL, example = 1.2)]
    pub width: f32,
    /// Opacity of phantom lines.
    #[value(range = 0.0..=1.0, example = 0.85)]
    pub alpha: f32,
    /// Opacity of glass.
    #[value(range = 0.0..=1.0, example = 1)]
    pub glass: f32,
    /// Colour of phantom lines and glass, instead of the line colour.
    #[value(example = "#5b6f88")]
    pub color: Option<Vec3>,
}

/// How removed geometry is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, PartialOrd, Ord, Described)]
pub enum GhostKind {
    /// Nothing.
    #[default]
    None,
    /// Phantom lines: a long dash and two dots (ISO 128-2, 05.1).
    Lines,
    /// Glass, visible at grazing angles.
    Glass,
    /// Both.
    Both,
}

impl Default for Ghost {
    fn default() -> Self {
        Self {
            kind: GhostKind::None,
            width: 1.2,
            alpha: 0.85,
            glass: 1.0,
            color: None,
        }
    }
}

impl Ghost {
    /// Returns true if phantom lines are drawn.
    pub fn has_lines(&self) -> bool {
        matches!(self.kind, GhostKind::Lines | GhostKind::Both)
            && self.width > 0.0
            && self.alpha > 0.0
    }

    /// Returns true if glass is drawn.
    pub fn has_glass(&self) -> bool {
        matches!(self.kind, GhostKind::Glass | GhostKind::Both) && self.glass > 0.0
    }

    /// Returns true if anything is drawn.
    pub fn is_drawn(&self) -> bool {
        self.has_lines() || self.has_glass()
    }
}
