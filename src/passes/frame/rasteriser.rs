//! Choice of rasteriser.

use std::fmt;
use std::str::FromStr;

use crate::Error;
use crate::error::did_you_mean;
use crate::scene::describe::{Described, words};

/// Which rasteriser draws a frame's mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Described)]
pub enum Rasteriser {
    /// The GPU's own.
    #[default]
    Hardware,
    /// The passes of `rasterise`: the same coverage, computed with integers in compute shaders.
    Compute,
}

impl fmt::Display for Rasteriser {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Rasteriser {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        Self::named(text).ok_or_else(|| {
            Error::input(
                format!("rasteriser `{text}`"),
                "there is no such rasteriser",
                did_you_mean(text, words(&Self::ALL)),
            )
        })
    }
}
