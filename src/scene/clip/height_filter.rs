//! Interpolation of a relief's heights between the texels of its map: by shader or by sampler.

use std::fmt;
use std::str::FromStr;

use crate::Error;
use crate::error::did_you_mean;

/// Interpolator of heights that a strategy evaluates at points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum HeightFilter {
    /// The shader, from four texels in f32: the definition of a relief.
    #[default]
    Exact,
    /// The sampler of the GPU, which keeps the place within a cell in few bits, 8 on nearly all devices.
    Hardware,
}

impl fmt::Display for HeightFilter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Exact => "exact",
            Self::Hardware => "hardware",
        })
    }
}

impl FromStr for HeightFilter {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        match text {
            "exact" => Ok(Self::Exact),
            "hardware" => Ok(Self::Hardware),
            _ => Err(Error::input(
                format!("height filter `{text}`"),
                "there is no such filter",
                did_you_mean(text, ["exact", "hardware"]),
            )),
        }
    }
}
