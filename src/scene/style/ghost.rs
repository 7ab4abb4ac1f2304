//! Ghost: removed geometry that is still shown.

use glam::Vec3;

/// The uncut solids where a cut has taken something of them away.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ghost {
    /// Elements that are drawn.
    pub kind: GhostKind,
    /// Width of phantom lines, in thousandths of the picture's height.
    pub width: f32,
    /// Opacity of lines, 0 to 1.
    pub alpha: f32,
    /// Opacity of glass, 0 to 1.
    pub glass: f32,
    /// Colour of lines and glass; `None` is the ink.
    pub color: Option<Vec3>,
}

/// Elements that are drawn of the removed geometry.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, PartialOrd, Ord)]
pub enum GhostKind {
    /// Nothing.
    #[default]
    None,
    /// Phantom lines: a long dash and two dots (ISO 128-2, 05.1).
    Lines,
    /// Glass, seen where it is grazed.
    Glass,
    /// Both.
    Both,
}

impl GhostKind {
    /// All, by their names.
    pub const ALL: [(&'static str, Self); 4] = [
        ("none", Self::None),
        ("lines", Self::Lines),
        ("glass", Self::Glass),
        ("both", Self::Both),
    ];
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
