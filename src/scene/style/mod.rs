//! Style: everything about how a picture looks and nothing about what it shows.
//!
//! Colours of parts come from their materials; a style takes their hue and sets lightness and chroma ([`Tint`]), so that an assembly of a
//! hundred parts stays calm. Lengths are in thousandths of the picture's height ([`Style::px`]): a picture looks the same at 768 and at
//! 4000 rows. What a style does not ask for costs nothing: no pass, no binding, no instruction.
//!
//! The default is `lit`, which is what measurements take. The others are files (`crates/io/src/document/styles`).

mod engraving;
mod ghost;
mod hatch;
mod occlusion;
mod oklab;
mod shadow;
mod tint;

pub use engraving::Engraving;
pub use ghost::{Ghost, GhostKind};
pub use hatch::{Hatch, HatchAnchor, HatchZoom};
pub use occlusion::{Occlusion, OcclusionKind};
pub use shadow::Shadow;
pub use tint::Tint;

use glam::Vec3;

use super::Material;

/// Look of a picture. Colours are sRGB in 0..=1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    /// Background.
    pub paper: Paper,
    /// Colour of strokes and hatches.
    pub ink: Vec3,
    /// Lighting model.
    pub shading: Shading,
    /// Colours of surfaces.
    pub surface: Tint,
    /// True if the coats of meshes ([`Mesh::coat`](super::Mesh::coat)) replace `surface`.
    pub coat: bool,
    /// Look of caps.
    pub cap: CapLook,
    /// Gooch's lighting, used if `shading` selects it.
    pub gooch: Gooch,
    /// Lines between what differs.
    pub strokes: Strokes,
    /// Lines on caps.
    pub hatch: Hatch,
    /// Lines on surfaces, used if `shading` selects them.
    pub engraving: Engraving,
    /// Darkening of what lies deep.
    pub occlusion: Occlusion,
    /// Drawing of removed geometry.
    pub ghost: Ghost,
    /// Shadow of the model on the ground.
    pub shadow: Shadow,
}

impl Default for Style {
    fn default() -> Self {
        Self {
            paper: Paper::default(),
            ink: Vec3::ZERO,
            shading: Shading::default(),
            surface: Tint::default(),
            coat: true,
            cap: CapLook::default(),
            gooch: Gooch::default(),
            strokes: Strokes::default(),
            hatch: Hatch::default(),
            engraving: Engraving::default(),
            occlusion: Occlusion::default(),
            ghost: Ghost::default(),
            shadow: Shadow::default(),
        }
    }
}

/// Differences of caps from surfaces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CapLook {
    /// Their colours.
    pub tint: Tint,
    /// Strength of light on caps by [`Shading::Calm`], 0 to 1: at 0 they have their colour whatever the light.
    pub light: f32,
    /// Share of cap shading that depends on the normal, 0 to 1; the rest is even, as of paper.
    pub relief: f32,
}

impl Default for CapLook {
    fn default() -> Self {
        Self {
            tint: Tint::Material,
            light: 1.0,
            relief: 1.0,
        }
    }
}

/// Background of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub enum Paper {
    /// Light grey that darkens downwards.
    #[default]
    Gradient,
    /// One colour, sRGB in 0..=1.
    Color(Vec3),
    /// Nothing: alpha is the share of the pixel that model and strokes cover.
    None,
}

/// Lighting model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, PartialOrd, Ord)]
pub enum Shading {
    /// A key light over the left shoulder, a cool fill, highlights.
    #[default]
    Lit,
    /// The same lights, soft and without highlights, on colours of one lightness.
    Calm,
    /// No light at all.
    Flat,
    /// From cool to warm (Gooch et al. 1998).
    Gooch,
    /// Three tones with sharp edges between them, and a highlight (Lake et al. 2000).
    Toon,
    /// A matte material.
    Clay,
    /// Tone as lines on surfaces ([`Engraving`]); caps without light.
    Engraved,
}

/// Light from cool to warm: cool is a blue and a share of the own colour, warm a yellow and a share of that (Gooch et al. 1998, b, y, alpha
/// and beta).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gooch {
    /// Blue of what the light does not reach.
    pub blue: f32,
    /// Yellow of what it does.
    pub yellow: f32,
    /// Share of the own colour in cool.
    pub of_cool: f32,
    /// Share of the own colour in warm.
    pub of_warm: f32,
}

impl Default for Gooch {
    fn default() -> Self {
        // Less green on metal than with the 0.4, 0.4, 0.2, 0.6 of the paper.
        Self {
            blue: 0.40,
            yellow: 0.30,
            of_cool: 0.25,
            of_warm: 0.55,
        }
    }
}

impl Shading {
    /// All, by their names.
    pub const ALL: [(&'static str, Self); 7] = [
        ("lit", Self::Lit),
        ("calm", Self::Calm),
        ("flat", Self::Flat),
        ("gooch", Self::Gooch),
        ("toon", Self::Toon),
        ("clay", Self::Clay),
        ("engraved", Self::Engraved),
    ];
}

/// Widths of strokes by the class of border that they are on, in thousandths of the picture's height; 0 draws none. A border is between
/// two samples of the picture, strongest class first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strokes {
    /// Around the model.
    pub outline: f32,
    /// At the border of a cap, unless the model ends there.
    pub cut: f32,
    /// Between two parts.
    pub part: f32,
    /// Between caps of one part by two clip-surfaces.
    pub face: f32,
    /// At the border of a surface that hides more of the same part.
    pub contour: f32,
    /// At a fold of a surface.
    pub crease: f32,
    /// The least fold that is a crease, in degrees.
    pub crease_deg: f32,
    /// The least jump in depth that is a contour, in widths of a pixel.
    pub depth_px: f32,
}

impl Default for Strokes {
    fn default() -> Self {
        Self {
            outline: 0.0,
            cut: 0.0,
            part: 0.0,
            face: 0.0,
            contour: 0.0,
            crease: 0.0,
            crease_deg: 30.0,
            depth_px: 8.0,
        }
    }
}

impl Strokes {
    /// Widths of all classes, the strongest first.
    pub fn widths(&self) -> [f32; 6] {
        [
            self.outline,
            self.cut,
            self.part,
            self.face,
            self.contour,
            self.crease,
        ]
    }

    /// The greatest width.
    pub fn widest(&self) -> f32 {
        self.widths().into_iter().fold(0.0, f32::max)
    }
}

impl Style {
    /// Returns true if it is the default style, which measurements use: a single pass.
    pub fn is_plain(&self) -> bool {
        *self == Self::default()
    }

    /// Converts a style length to pixels, given the image height in pixels.
    pub fn px(length: f32, rows: u32) -> f32 {
        length * rows as f32 / 1000.0
    }

    /// Colour of the surface of a part, sRGB in 0..=1.
    pub fn surface_color(&self, material: &Material) -> Vec3 {
        self.surface.of(material.color, None)
    }

    /// Colour of the caps of a part, sRGB in 0..=1.
    pub fn cap_color(&self, material: &Material) -> Vec3 {
        match self.cap.tint {
            Tint::Material => material.cap_color(),
            tint => tint.of(material.color, material.cap_color),
        }
    }
}
