//! A heat map: a picture that shows where a frame is wrong, and in which way.
//!
//! The colours are those of Okabe and Ito (2008), which can be told apart with all common kinds of colour blindness, over a dim
//! grey rendering of the exact kinds. A single wrong pixel would be overlooked in a large picture, so each wrong pixel gets a
//! one-pixel ring in a lighter tone of its colour. The ring is drawn only over pixels that are not wrong.

use cutaway::layers::{Kind, Layer, Layers};
use image::{Rgba, RgbaImage};

use super::PixelErrors;
use crate::exact::Exact;

/// Classes of a heat map, the gravest first: a pixel has the colour of the first class that fits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Class {
    /// A hole: the strategy shows a back face, or background where exact has none within a pixel.
    Crack,
    /// Exact has a cap, the strategy does not.
    MissedCap,
    /// The strategy has a cap, exact does not.
    LeakedCap,
    /// The kind is right, but the part or the clip-surface is wrong.
    WrongPart,
    /// A surface where exact has background or, at an outline, background where exact has a surface.
    Mismatch,
    /// Right, but marked by the strategy.
    Unreliable,
    /// Right, but sampling is ambiguous there.
    Undecided,
}

/// A class, its colour and its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LegendEntry {
    /// The class.
    pub class: Class,
    /// Its colour, sRGB.
    pub rgb: [u8; 3],
    /// The name that a legend shows.
    pub name: &'static str,
    /// What a pixel of the class means, as a phrase for a legend.
    pub meaning: &'static str,
}

/// The classes in order, each with its colour, name and meaning.
pub fn legend() -> [LegendEntry; 7] {
    let entry = |class, rgb, name, meaning| LegendEntry {
        class,
        rgb,
        name,
        meaning,
    };
    [
        entry(
            Class::Crack,
            [240, 228, 66],
            "crack",
            "a hole in the picture: a back face or the background shows, where there is neither cap nor outline",
        ),
        entry(
            Class::MissedCap,
            [213, 94, 0],
            "missed cap",
            "there is a cap, and the method draws none",
        ),
        entry(
            Class::LeakedCap,
            [0, 114, 178],
            "leaked cap",
            "the method draws a cap where there is none",
        ),
        entry(
            Class::WrongPart,
            [204, 121, 167],
            "wrong part",
            "the cap or surface belongs to another part or clip-surface",
        ),
        entry(
            Class::Mismatch,
            [230, 159, 0],
            "surface against background",
            "a surface where there is background, or the reverse, along an outline",
        ),
        entry(
            Class::Unreliable,
            [86, 180, 233],
            "unreliable",
            "right, but marked by the method as possibly wrong",
        ),
        entry(
            Class::Undecided,
            [0, 158, 115],
            "undecided",
            "right, at a pixel where rounding decides: nothing drawn there counts as wrong",
        ),
    ]
}

impl Class {
    fn of(exact: &Exact, index: usize, found: &Layer) -> Option<Self> {
        let verdict = PixelErrors::of(&exact.layers, index, found);
        [
            (verdict.crack && !verdict.missed_cap, Self::Crack),
            (verdict.missed_cap, Self::MissedCap),
            (verdict.leaked_cap, Self::LeakedCap),
            (verdict.wrong_part, Self::WrongPart),
            (verdict.wrong, Self::Mismatch),
            (found.unreliable, Self::Unreliable),
            (exact.undecided[index], Self::Undecided),
        ]
        .into_iter()
        .find_map(|(fits, class)| fits.then_some(class))
    }

    fn is_wrong(self) -> bool {
        self < Self::Unreliable
    }

    fn rgb(self) -> [u8; 3] {
        legend()
            .into_iter()
            .find(|e| e.class == self)
            .map_or([255; 3], |e| e.rgb)
    }
}

/// Draws where a frame differs from exact.
///
/// # Panics
///
/// If the frames differ in size.
pub fn heatmap(exact: &Exact, layers: &Layers) -> RgbaImage {
    marked(exact, layers, |truth| opaque(ground(truth)))
}

/// The marks of [`heatmap`] alone, as an overlay for a picture of the frame: transparent where there is no mark.
///
/// # Panics
///
/// If the frames differ in size.
pub fn heatmap_overlay(exact: &Exact, layers: &Layers) -> RgbaImage {
    marked(exact, layers, |_| Rgba([0; 4]))
}

fn marked(exact: &Exact, layers: &Layers, ground: impl Fn(&Layer) -> Rgba<u8>) -> RgbaImage {
    assert_eq!(
        exact.layers.size_px, layers.size_px,
        "frames of different size cannot be compared"
    );
    let [width, height] = layers.size_px;
    let index = |x: u32, y: u32| (y * width + x) as usize;
    let class = |x: u32, y: u32| {
        let i = index(x, y);
        Class::of(exact, i, &layers.pixels[i])
    };
    let mut picture = RgbaImage::from_fn(width, height, |x, y| {
        let own = class(x, y).map(|class| opaque(class.rgb()));
        own.unwrap_or_else(|| ground(&exact.layers.pixels[index(x, y)]))
    });
    for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
        if class(x, y).is_some_and(Class::is_wrong) {
            continue;
        }
        let neighbours = (y.saturating_sub(1)..(y + 2).min(height))
            .flat_map(|j| (x.saturating_sub(1)..(x + 2).min(width)).map(move |i| (i, j)));
        let worst = neighbours
            .filter_map(|(i, j)| class(i, j))
            .filter(|c| c.is_wrong())
            .min();
        if let Some(worst) = worst {
            picture.put_pixel(x, y, opaque(worst.rgb().map(|c| c / 2 + 128)));
        }
    }
    picture
}

fn opaque([r, g, b]: [u8; 3]) -> Rgba<u8> {
    Rgba([r, g, b, 255])
}

/// Dim grey of a right pixel: lighter where its surface faces the light more directly.
fn ground(truth: &Layer) -> [u8; 3] {
    let [dark, light] = match truth.kind {
        Kind::Background => return [16; 3],
        Kind::Surface => [34.0, 70.0],
        Kind::Cap => [70.0, 104.0],
    };
    // Any fixed light direction will do: the scene only has to be recognisable.
    let lit = truth.normal.dot(glam::Vec3::new(0.4, 0.8, 0.45)).abs();
    [(dark + (light - dark) * lit.min(1.0)) as u8; 3]
}
