//! Interpolation of a relief's heights between the texels of its map: by shader or by sampler.

use std::fmt;
use std::str::FromStr;

use crate::Error;
use crate::error::did_you_mean;
use crate::scene::describe::{Described, words};

/// How a strategy interpolates heights at points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Described)]
pub enum HeightFilter {
    /// The shader interpolates four texels in f32, which is how a relief is defined.
    #[default]
    Exact,
    /// The GPU's sampler, which keeps only a few bits of the position within a cell, 8 on nearly all devices.
    Hardware,
}

impl fmt::Display for HeightFilter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for HeightFilter {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        Self::named(text).ok_or_else(|| {
            Error::input(
                format!("height filter `{text}`"),
                "there is no such filter",
                did_you_mean(text, words(&Self::ALL)),
            )
        })
    }
}
