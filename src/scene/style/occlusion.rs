//! Occlusion: darkening of points from which little of the sky is visible.

use crate::scene::describe::Described;

/// Darkening of recessed areas, computed from a picture's layers.
#[derive(Clone, Copy, Debug, PartialEq, Described)]
pub struct Occlusion {
    /// Ambient-occlusion method.
    #[value(example = "horizon")]
    pub kind: OcclusionKind,
    /// Largest distance of an occluder, in percent of the scene's diagonal (horizon).
    #[value(range = 0.0..=100.0, unit = "percent", example = 5)]
    pub radius_percent: f32,
    /// Planes searched for horizons per pixel (horizon).
    #[value(range = 1.0..=32.0, example = 3)]
    pub slices: u32,
    /// Samples along each plane on either side of the pixel (horizon).
    #[value(range = 1.0..=64.0, example = 6)]
    pub steps: u32,
    /// Standard deviation of the blur, in percent of the picture's diagonal (unsharp).
    #[value(range = 0.0..=10.0, unit = "percent", example = 2)]
    pub blur_percent: f32,
    /// Darkening of deeper pixels (unsharp).
    ///
    /// Per excess depth of one scene diagonal over the surroundings: lambda of Luft et al. 2006.
    #[value(range = 0.0..=100.0, example = 6)]
    pub strength: f32,
    /// Weight of occlusion on surfaces.
    #[value(range = 0.0..=1.0, example = 0.7)]
    pub surface: f32,
    /// Weight of occlusion on caps.
    #[value(range = 0.0..=1.0, example = 0.35)]
    pub cap: f32,
    /// Weight of the occlusion of caps by their own relief.
    ///
    /// Applies to every method.
    #[value(range = 0.0..=1.0, example = 0.5)]
    pub relief: f32,
}

/// Method that computes occlusion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, PartialOrd, Ord, Described)]
pub enum OcclusionKind {
    /// No occlusion.
    #[default]
    None,
    /// Cosine-weighted share of the sky above the surrounding horizons: ground truth for the visible geometry (Jimenez et al. 2016).
    Horizon,
    /// Difference between depth and blurred depth (Luft, Colditz and Deussen 2006), as in Trapp and Döllner 2013 (4.5): emphasises depth
    /// steps and leaves narrow gaps unchanged.
    Unsharp,
}

impl Default for Occlusion {
    fn default() -> Self {
        Self {
            kind: OcclusionKind::None,
            radius_percent: 5.0,
            slices: 3,
            steps: 6,
            blur_percent: 2.0,
            strength: 6.0,
            surface: 0.70,
            cap: 0.35,
            relief: 0.0,
        }
    }
}

impl Occlusion {
    /// Returns true if it darkens anything.
    pub fn is_drawn(&self) -> bool {
        let is_found = match self.kind {
            OcclusionKind::None => false,
            OcclusionKind::Horizon => self.radius_percent > 0.0,
            OcclusionKind::Unsharp => self.strength > 0.0 && self.blur_percent > 0.0,
        };
        is_found && self.surface.max(self.cap) > 0.0
    }
}
