//! Methods: a strategy with its drawing options, `raycast+mask@compute,pyramid`.
//!
//! The `@` is followed by the options that differ from the defaults. A method is a small value: sessions keep frames by method, and
//! experiments and tests name, order and compare methods.

use std::fmt;
use std::str::FromStr;

use super::Strategy;
use crate::passes::{Rasteriser, ReliefWalk};
use crate::scene::{HeightFilter, Precision};
use crate::{Error, Result};

/// Method for a frame: a strategy and its drawing options.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Method {
    /// The strategy.
    pub strategy: Strategy,
    /// The drawing options.
    pub options: DrawOptions,
}

/// Options of how a strategy draws. An option that is `None` takes its [default](Method::or).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct DrawOptions {
    /// Rasteriser of the mesh; usually the GPU's own.
    pub rasteriser: Option<Rasteriser>,
    /// True if the compute rasteriser uses 64-bit atomics: the same picture in one sweep instead of two. Usually true if the adapter has
    /// them; false where a plan is recorded without an adapter.
    pub wide_atomics: Option<bool>,
    /// Sub-pixel bits: the hardware rasteriser snaps vertices to 2^-bits of a pixel. With fewer than 8 bits rays are followed farther
    /// beyond the solids. A session measures the value; 8 where a plan is recorded without an adapter.
    pub sub_pixel_bits: Option<u32>,
    /// How rays walk through reliefs; the crossings are the same. Usually chosen by the number of cells that a ray meets.
    pub relief_walk: Option<ReliefWalk>,
    /// True if the per-pixel list of crossings is written even for a few planes, which the compute rasteriser could test directly, and
    /// holds all crossings in the box of the cut solids, including those with no triangle nearby. Usually false; [hosts that clip by
    /// it](crate::gpu::clip_wgsl) need it, and with it the masks of all methods are identical word by word.
    pub list: Option<bool>,
    /// Filter for relief heights between texels. Usually exact; strategies that do not sample heights at points refuse any other filter if
    /// there is a relief.
    pub height_filter: Option<HeightFilter>,
}

/// An option word, and how it changes the options.
type Word = (&'static str, fn(&mut DrawOptions));

/// Words allowed after the `@`.
const OPTION_WORDS: [Word; 7] = [
    ("hardware", |m| m.rasteriser = Some(Rasteriser::Hardware)),
    ("compute", |m| m.rasteriser = Some(Rasteriser::Compute)),
    ("32-bit", |m| m.wide_atomics = Some(false)),
    ("cells", |m| m.relief_walk = Some(ReliefWalk::Cells)),
    ("pyramid", |m| m.relief_walk = Some(ReliefWalk::Pyramid)),
    ("list", |m| m.list = Some(true)),
    ("hardware-filter", |m| {
        m.height_filter = Some(HeightFilter::Hardware);
    }),
];

impl DrawOptions {
    /// Options with this rasteriser, and defaults otherwise.
    pub const fn by(rasteriser: Rasteriser) -> Self {
        Self {
            rasteriser: Some(rasteriser),
            wide_atomics: None,
            sub_pixel_bits: None,
            relief_walk: None,
            list: None,
            height_filter: None,
        }
    }

    /// Precision with which the hardware rasteriser places triangles: it draws caps even where the compute rasteriser draws the mesh.
    pub(crate) fn precision(&self) -> Precision {
        Precision {
            sub_pixel_bits: (self.sub_pixel_bits).unwrap_or(Precision::USUAL.sub_pixel_bits),
            slopes_in_f32: true,
        }
    }

    /// Returns true if a word may follow the `@`.
    pub fn is_word(word: &str) -> bool {
        OPTION_WORDS.iter().any(|(name, _)| *name == word)
    }

    /// These options, with unset ones taken from others.
    #[must_use]
    pub fn or(self, others: Self) -> Self {
        Self {
            rasteriser: self.rasteriser.or(others.rasteriser),
            wide_atomics: self.wide_atomics.or(others.wide_atomics),
            sub_pixel_bits: self.sub_pixel_bits.or(others.sub_pixel_bits),
            relief_walk: self.relief_walk.or(others.relief_walk),
            list: self.list.or(others.list),
            height_filter: self.height_filter.or(others.height_filter),
        }
    }
}

impl Method {
    /// A strategy with drawing options.
    pub const fn new(strategy: Strategy, options: DrawOptions) -> Self {
        Self { strategy, options }
    }

    /// The same method, with unset options taken from the given ones.
    #[must_use]
    pub fn or(self, usual: DrawOptions) -> Self {
        Self::new(self.strategy, self.options.or(usual))
    }
}

impl From<Strategy> for Method {
    fn from(strategy: Strategy) -> Self {
        Self::new(strategy, DrawOptions::default())
    }
}

impl From<&Strategy> for Method {
    fn from(strategy: &Strategy) -> Self {
        (*strategy).into()
    }
}

impl From<&Self> for Method {
    fn from(method: &Self) -> Self {
        *method
    }
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.strategy)?;
        let mut separator = '@';
        for (name, set) in OPTION_WORDS {
            let mut with = self.options;
            set(&mut with);
            if with == self.options {
                write!(f, "{separator}{name}")?;
                separator = ',';
            }
        }
        Ok(())
    }
}

impl FromStr for Method {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self> {
        let (name, words) = match text.split_once('@') {
            Some((name, words)) => (name, Some(words)),
            None => (text, None),
        };
        let mut method = Self::from(name.trim().parse::<Strategy>()?);
        for word in words.into_iter().flat_map(|w| w.split(',')) {
            let Some((_, set)) = OPTION_WORDS.iter().find(|(name, _)| *name == word.trim()) else {
                let known: Vec<&str> = OPTION_WORDS.iter().map(|(name, _)| *name).collect();
                return Err(Error::input(
                    text,
                    format!("unknown drawing option `{word}`"),
                    format!("after the @ write one or more of {}", known.join(", ")),
                ));
            };
            set(&mut method.options);
        }
        Ok(method)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn methods_are_written_as_they_are_read() {
        for text in [
            "raycast+mask",
            "raycast+mask@compute",
            "grid:64+vds:512",
            "raycast+mask@compute,32-bit",
            "raycast+mask@cells",
            "raycast+mask@compute,list",
            "raycast+mask@hardware",
            "grid:64+vds:512@hardware-filter",
        ] {
            let method: Method = text.parse().unwrap();
            assert_eq!(method.to_string(), text);
        }
        for (text, said) in [
            ("raycast+mask@gpu", "hardware"),
            ("raycats+mask@compute", "did you mean"),
        ] {
            let message = text.parse::<Method>().unwrap_err().to_string();
            assert!(message.contains(said), "{message}");
        }
    }

    #[test]
    fn what_a_method_says_comes_before_the_usual() {
        let usual = DrawOptions::by(Rasteriser::Compute);
        let options = |text: &str| text.parse::<Method>().unwrap().or(usual).options;
        assert_eq!(options("raycast+mask"), usual);
        assert_eq!(
            options("raycast+mask@hardware").rasteriser,
            Some(Rasteriser::Hardware)
        );
        let narrow = options("raycast+mask@32-bit,pyramid");
        assert_eq!(narrow.wide_atomics, Some(false));
        assert_eq!(narrow.relief_walk, Some(ReliefWalk::Pyramid));
        assert_eq!(narrow.rasteriser, usual.rasteriser);
    }
}
