//! Occlusion: darkening of places that see little of the sky.

/// Darkening of what lies deep, from the layers of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Occlusion {
    /// Method.
    pub kind: OcclusionKind,
    /// Greatest distance at which geometry hides the sky, in percent of the diagonal of the scene (`horizon`).
    pub radius_percent: f32,
    /// Number of planes through the line of sight that are searched for horizons.
    pub slices: u32,
    /// Number of samples to each side of a slice.
    pub steps: u32,
    /// The standard deviation of the blur, in percent of the diagonal of the picture (`unsharp`).
    pub blur_percent: f32,
    /// Darkening per excess depth of one scene diagonal over the surroundings (`unsharp`, lambda of Luft et al. 2006).
    pub strength: f32,
    /// Weight on surfaces, 0 to 1.
    pub surface: f32,
    /// Weight on caps, 0 to 1.
    pub cap: f32,
    /// Weight on caps of the occlusion by their own relief, 0 to 1, whatever the kind.
    pub relief: f32,
}

/// Method that computes occlusion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, PartialOrd, Ord)]
pub enum OcclusionKind {
    /// No occlusion.
    #[default]
    None,
    /// The share of the sky over the horizons around, weighted by the cosine: of what the picture shows the true one (Jimenez et al. 2016).
    Horizon,
    /// The difference of depth and blurred depth (Luft, Colditz and Deussen 2006), as Trapp and Döllner 2013 have it (4.5): sets apart in
    /// depth and leaves narrow gaps as they are.
    Unsharp,
}

impl OcclusionKind {
    /// All, by their names.
    pub const ALL: [(&'static str, Self); 3] = [
        ("none", Self::None),
        ("horizon", Self::Horizon),
        ("unsharp", Self::Unsharp),
    ];
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
