//! Part colours as modified by a style.

use glam::Vec3;

use super::oklab::{oklab_from_srgb, srgb_from_oklab};
use crate::scene::describe::{Described, Field, Given, Leaf};

/// Rule that changes the colour of a part.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub enum Tint {
    /// The colour is kept.
    #[default]
    Material,
    /// All parts have this colour, sRGB in 0..=1.
    Color(Vec3),
    /// The hue is kept, in OKLab (Ottosson 2020).
    Hue(Hue),
}

/// Lightness and chroma for all parts; each part keeps its hue.
#[derive(Clone, Copy, Debug, PartialEq, Described)]
pub struct Hue {
    /// OKLab lightness; parts keep their hues.
    #[value(range = 0.0..=1.0, example = 0.8)]
    pub lightness: f32,
    /// Largest OKLab chroma.
    ///
    /// Lower values are kept.
    #[value(range = 0.0..=0.4, example = 0.024)]
    pub chroma: f32,
    /// Offset added to OKLab a and b.
    #[value(example = [0, 0])]
    pub warmth: [f32; 2],
}

impl Default for Hue {
    fn default() -> Self {
        Self {
            lightness: 0.8,
            chroma: 0.03,
            warmth: [0.0; 2],
        }
    }
}

/// The colour or the values of the hue: setting one replaces the other.
impl Described for Tint {
    fn fields(&self) -> &'static [Field] {
        Self::FIELDS
    }

    fn set(&mut self, field: usize, given: Given) -> bool {
        let Some(of_hue) = field.checked_sub(1) else {
            return match Vec3::of(given) {
                Some(color) => {
                    *self = Self::Color(color);
                    true
                }
                None => false,
            };
        };
        let mut hue = match self {
            Self::Hue(hue) => *hue,
            _ => Hue::default(),
        };
        let is_set = hue.set(of_hue, given);
        if is_set {
            *self = Self::Hue(hue);
        }
        is_set
    }

    fn get(&self, field: usize) -> Option<Given> {
        match (field.checked_sub(1), self) {
            (None, Self::Color(color)) => color.get(),
            (Some(of_hue), Self::Hue(hue)) => hue.get(of_hue),
            _ => None,
        }
    }
}

impl Tint {
    /// Declarations of its values.
    pub const FIELDS: &'static [Field] = &[
        Field::leaf(
            "color",
            "one colour for all parts",
            Vec3::TYPE,
            "\"#d8d4cc\"",
        ),
        Hue::FIELDS[0],
        Hue::FIELDS[1],
        Hue::FIELDS[2],
    ];

    /// The tinted colour of a part; `given`, a colour set explicitly for the part, takes precedence over the tint.
    pub(super) fn of(self, color: Vec3, given: Option<Vec3>) -> Vec3 {
        if let Some(given) = given {
            return given;
        }
        match self {
            Self::Material => color,
            Self::Color(one) => one,
            Self::Hue(Hue {
                lightness,
                chroma,
                warmth: [a, b],
            }) => {
                let own = oklab_from_srgb(color);
                let share = (chroma / own.y.hypot(own.z).max(1e-6)).min(1.0);
                let lab = Vec3::new(lightness, own.y * share + a, own.z * share + b);
                srgb_from_oklab(lab)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hue_stays_and_lightness_is_set() {
        let tint = Tint::Hue(Hue {
            lightness: 0.8,
            chroma: 0.024,
            warmth: [0.0, 0.0],
        });
        for color in [Vec3::X, Vec3::Y, Vec3::Z, Vec3::new(0.3, 0.2, 0.1)] {
            let [own, made] = [color, tint.of(color, None)].map(oklab_from_srgb);
            assert!((made.x - 0.8).abs() < 1e-4, "lightness of {color}");
            assert!(
                (made.y.hypot(made.z) - 0.024).abs() < 1e-4,
                "chroma of {color}"
            );
            let turned = (own.y * made.z - own.z * made.y) / (own.y.hypot(own.z) * 0.024);
            assert!(turned.abs() < 1e-2, "hue of {color} is off by {turned}");
        }
        let grey = oklab_from_srgb(tint.of(Vec3::splat(0.5), None));
        assert!(grey.y.hypot(grey.z) < 1e-4, "grey stays grey");
    }

    #[test]
    fn values_are_set_and_read_back() {
        let mut tint = Tint::Material;
        assert!(!tint.set(1, Given::Flag(true)), "no lightness");
        assert_eq!(tint, Tint::Material);
        for (field, given) in [
            (0, Given::Color(Vec3::X)),
            (1, Given::Number(0.5)),
            (2, Given::Number(0.1)),
            (3, Given::Numbers(vec![0.1, 0.2])),
        ] {
            assert!(tint.set(field, given.clone()), "{field}");
            assert_eq!(tint.get(field), Some(given), "{field}");
        }
        assert_eq!(tint.get(0), None, "a hue replaces the colour");
    }

    #[test]
    fn what_is_given_comes_first() {
        let red = Tint::Color(Vec3::X);
        assert_eq!(red.of(Vec3::Y, None), Vec3::X);
        assert_eq!(red.of(Vec3::Y, Some(Vec3::Z)), Vec3::Z);
        assert_eq!(Tint::Material.of(Vec3::Y, None), Vec3::Y);
    }
}
