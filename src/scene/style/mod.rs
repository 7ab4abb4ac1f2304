//! Style: how a picture looks, not what it shows.
//!
//! Colours of parts come from their materials; a style takes their hue and sets lightness and chroma ([`Tint`]), so that an assembly of a
//! hundred parts looks calm. Lengths are in thousandths of the picture's height ([`Style::px`]): a picture looks the same at 768 and at
//! 4000 rows. Effects that a style does not use cost nothing: no pass, no binding, no instruction.
//!
//! The default style is `lit`, which measurements use. The other styles are files (`crates/io/src/document/styles`).

mod engraving;
mod ghost;
mod hatch;
mod lengths;
mod occlusion;
mod oklab;
mod shadow;
mod tint;

pub use engraving::Engraving;
pub use ghost::{Ghost, GhostKind};
pub use hatch::{Hatch, HatchAnchor, HatchZoom};
pub use occlusion::{Occlusion, OcclusionKind};
pub use shadow::Shadow;
pub use tint::{Hue, Tint};

use glam::Vec3;

use super::Material;
use super::describe::{Described, Given, Leaf, ValueType};
use lengths::{MIL, WIDEST};

/// Look of a picture. Colours are sRGB in 0..=1.
#[derive(Clone, Copy, Debug, PartialEq, Described)]
pub struct Style {
    /// Background colour of the style.
    #[value(example = "#ffffff")]
    pub paper: Paper,
    /// Line colour.
    ///
    /// Used for strokes and hatches.
    #[value(example = "#20262e")]
    pub ink: Vec3,
    /// Shading model.
    #[value(example = "calm")]
    pub shading: Shading,
    /// Look of surfaces.
    #[value(table)]
    pub surface: SurfaceLook,
    /// Look of caps.
    #[value(table)]
    pub cap: CapLook,
    /// Gooch's lighting, used if `shading` selects it.
    #[value(table)]
    pub gooch: Gooch,
    /// Lines on caps.
    #[value(table)]
    pub hatch: Hatch,
    /// Darkening of recessed areas.
    #[value(table)]
    pub occlusion: Occlusion,
    /// Drawing of removed geometry.
    #[value(table)]
    pub ghost: Ghost,
    /// Shadow of the model on the ground.
    #[value(table)]
    pub shadow: Shadow,
    /// Lines on surfaces, used if `shading` selects them.
    #[value(table)]
    pub engraving: Engraving,
    /// Outlines, contours and creases.
    #[value(table)]
    pub strokes: Strokes,
}

impl Default for Style {
    fn default() -> Self {
        Self {
            paper: Paper::default(),
            ink: Vec3::ZERO,
            shading: Shading::default(),
            surface: SurfaceLook::default(),
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

/// Look of surfaces.
#[derive(Clone, Copy, Debug, PartialEq, Described)]
pub struct SurfaceLook {
    /// Colours of surfaces.
    #[value(flat)]
    pub tint: Tint,
    /// Draws vertex colours and textures from files instead of part colours.
    ///
    /// The vertex paints of meshes: [`Mesh::vertex_paint`](super::Mesh::vertex_paint).
    #[value(key = "coat", example = true)]
    pub vertex_paint: bool,
}

impl Default for SurfaceLook {
    fn default() -> Self {
        Self {
            tint: Tint::default(),
            vertex_paint: true,
        }
    }
}

/// Settings for caps that differ from those for surfaces.
#[derive(Clone, Copy, Debug, PartialEq, Described)]
pub struct CapLook {
    /// Colours of caps.
    #[value(flat)]
    pub tint: Tint,
    /// Share of the light that caps receive (calm).
    ///
    /// At 0 caps have their plain colour, regardless of lighting.
    #[value(range = 0.0..=1.0, example = 1)]
    pub light: f32,
    /// Share of cap shading that depends on the normal (calm).
    ///
    /// The rest is uniform, like paper.
    #[value(range = 0.0..=1.0, example = 0.6)]
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

impl Leaf for Paper {
    const TYPE: ValueType = ValueType::Or(&ValueType::Color, &["gradient", "transparent", "none"]);

    fn of(given: Given) -> Option<Self> {
        match given {
            Given::Color(color) => Some(Self::Color(color)),
            Given::Text(word) => match word.as_str() {
                "gradient" => Some(Self::Gradient),
                "transparent" | "none" => Some(Self::None),
                _ => None,
            },
            _ => None,
        }
    }

    fn get(&self) -> Option<Given> {
        Some(match self {
            Self::Gradient => Given::Text("gradient".to_owned()),
            Self::Color(color) => Given::Color(*color),
            Self::None => Given::Text("transparent".to_owned()),
        })
    }
}

/// Lighting model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, PartialOrd, Ord, Described)]
pub enum Shading {
    /// A key light over the left shoulder, a cool fill, highlights.
    #[default]
    Lit,
    /// The same lights, soft and without highlights, on colours of equal lightness.
    Calm,
    /// No light at all.
    Flat,
    /// From cool to warm (Gooch et al. 1998).
    Gooch,
    /// Three tones with sharp edges between them, and a highlight (Lake et al. 2000).
    Toon,
    /// A matte material.
    Clay,
    /// Tone shown by lines on surfaces ([`Engraving`]); caps are unlit.
    Engraved,
}

/// Shading from cool to warm: cool is a blue plus a share of the part's colour, warm a yellow plus a share of it (Gooch et al. 1998: b, y,
/// alpha and beta).
#[derive(Clone, Copy, Debug, PartialEq, Described)]
pub struct Gooch {
    /// Amount of blue in the cool tone (gooch).
    #[value(range = 0.0..=1.0, example = 0.4)]
    pub blue: f32,
    /// Amount of yellow in the warm tone (gooch).
    #[value(range = 0.0..=1.0, example = 0.3)]
    pub yellow: f32,
    /// Base-colour weight in the cool tone (Gooch alpha).
    #[value(range = 0.0..=1.0, example = 0.25)]
    pub of_cool: f32,
    /// Base-colour weight in the warm tone (Gooch beta).
    #[value(range = 0.0..=1.0, example = 0.55)]
    pub of_warm: f32,
}

impl Default for Gooch {
    fn default() -> Self {
        // These values make metal look less green than the paper's 0.4, 0.4, 0.2 and 0.6.
        Self {
            blue: 0.40,
            yellow: 0.30,
            of_cool: 0.25,
            of_warm: 0.55,
        }
    }
}

/// Stroke widths by class of border, strongest class first, in thousandths of the picture's height; 0 draws none. A border lies between
/// two samples of the picture.
#[derive(Clone, Copy, Debug, PartialEq, Described)]
pub struct Strokes {
    /// Width of strokes around the model; 0 for none.
    #[value(range = 0.0..=WIDEST, unit = MIL, example = 2.1)]
    pub outline: f32,
    /// Width of strokes around caps.
    ///
    /// Except where the model ends there.
    #[value(range = 0.0..=WIDEST, unit = MIL, example = 2.1)]
    pub cut: f32,
    /// Width of strokes between parts.
    #[value(range = 0.0..=WIDEST, unit = MIL, example = 1.5)]
    pub part: f32,
    /// Width of strokes between a part's caps on two clip-surfaces.
    #[value(range = 0.0..=WIDEST, unit = MIL, example = 1.3)]
    pub face: f32,
    /// Width of strokes where a part occludes itself.
    #[value(range = 0.0..=WIDEST, unit = MIL, example = 1.3)]
    pub contour: f32,
    /// Width of strokes along creases.
    #[value(range = 0.0..=WIDEST, unit = MIL, example = 1)]
    pub crease: f32,
    /// Smallest dihedral angle of a crease; less than 1 counts as 1.
    #[value(range = 0.0..=180.0, unit = "degrees", example = 30)]
    pub crease_deg: f32,
    /// Smallest depth step of a contour, in pixel widths.
    #[value(range = 0.0..=1e6, unit = "px", example = 8)]
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
        self.surface.tint.of(material.color, None)
    }

    /// Colour of the caps of a part, sRGB in 0..=1.
    pub fn cap_color(&self, material: &Material) -> Vec3 {
        match self.cap.tint {
            Tint::Material => material.cap_color(),
            tint => tint.of(material.color, material.cap_color),
        }
    }
}
