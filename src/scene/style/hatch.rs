//! Hatch: lines on caps.

use glam::Vec3;

/// Parallel lines on caps, in units of the scene: they stay where they are while the camera moves. Parts that touch have unlike ones.
/// Lengths are in thousandths of the picture's height, as the scene was first seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hatch {
    /// Width of a line; 0 draws none.
    pub width: f32,
    /// Opacity of a line, 0 to 1.
    pub alpha: f32,
    /// Colour of lines; `None` is the ink.
    pub color: Option<Vec3>,
    /// Direction of the lines of the first class of parts, in degrees from the horizontal of the cap.
    pub angle_deg: f32,
    /// Distance from line to line over the mean thickness of the part.
    pub per_thickness: f32,
    /// The least distance from line to line.
    pub least: f32,
    /// The greatest; what touches many others may have more.
    pub most: f32,
    /// Parts that are thinner on the mean have their caps filled.
    pub solid_below: f32,
    /// Anchor of the lines.
    pub anchor: HatchAnchor,
    /// Behaviour of line distances when the camera comes nearer.
    pub zoom: HatchZoom,
}

/// Anchor of the lines of a hatch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, PartialOrd, Ord)]
pub enum HatchAnchor {
    /// The part, where that moves as a whole: lines turn about the normal of the cut and shift along it as the part does.
    #[default]
    Part,
    /// The clip-surface.
    Cut,
}

impl HatchAnchor {
    /// All, by their names.
    pub const ALL: [(&'static str, Self); 2] = [("part", Self::Part), ("cut", Self::Cut)];
}

/// Behaviour of the distances between lines when the camera comes nearer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, PartialOrd, Ord)]
pub enum HatchZoom {
    /// Distances are fixed in the scene.
    #[default]
    Fixed,
    /// Distances are doubled or halved to stay near the style's distance in the picture; in between every second line thins out.
    Banded,
}

impl HatchZoom {
    /// All, by their names.
    pub const ALL: [(&'static str, Self); 2] = [("fixed", Self::Fixed), ("banded", Self::Banded)];
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
