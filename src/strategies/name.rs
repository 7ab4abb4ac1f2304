//! Names of strategies: `raycast+mask`, `grid:256+vds:1024`, and `stencil`, which stands alone.

use std::fmt;
use std::str::FromStr;

use crate::Error;
use crate::error::did_you_mean;

/// A way to produce cap points per pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CapSurface {
    /// All crossings of each pixel's ray, exactly.
    Raycast,
    /// None: the inside test draws the caps itself.
    Alone,
    /// The paper's quad, refined and displaced.
    Grid {
        /// Cells along a side.
        cells: u32,
    },
}

/// A way to tell whether a point is inside a solid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InsideTest {
    /// Parity bits per crossing, written by the one pass over the mesh.
    Mask,
    /// Parity in the stencil buffer, a draw of the mesh for each crossing.
    Stencil,
    /// The paper's volumetric depth sprite.
    Vds {
        /// Texels along a side.
        resolution: u32,
    },
}

impl InsideTest {
    /// Whether it can fill a part by the nonzero rule.
    pub fn counts_winding(self) -> bool {
        matches!(self, Self::Mask | Self::Stencil)
    }
}

/// A cap surface with an inside test.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Strategy {
    /// Where caps may be.
    pub surface: CapSurface,
    /// Where they are.
    pub inside: InsideTest,
}

impl Strategy {
    /// The exact one.
    pub const RAYCAST_MASK: Self = Self {
        surface: CapSurface::Raycast,
        inside: InsideTest::Mask,
    };
    /// The same by fixed-function hardware.
    pub const RAYCAST_STENCIL: Self = Self {
        surface: CapSurface::Raycast,
        inside: InsideTest::Stencil,
    };
    /// The classic for one plane.
    pub const STENCIL: Self = Self {
        surface: CapSurface::Alone,
        inside: InsideTest::Stencil,
    };
    /// The paper, with its own parameters.
    pub const PAPER: Self = Self {
        surface: CapSurface::Grid { cells: 256 },
        inside: InsideTest::Vds { resolution: 1024 },
    };
    /// All that are built, with their usual parameters; what `all` means.
    pub const ALL: [Self; 4] = [
        Self::RAYCAST_MASK,
        Self::RAYCAST_STENCIL,
        Self::STENCIL,
        Self::PAPER,
    ];

    /// Whether it can say where several parts share a cap: all parts are asked at one crossing.
    pub fn tells_overlaps(self) -> bool {
        self.surface == CapSurface::Raycast
    }
}

impl fmt::Display for CapSurface {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Raycast => f.write_str("raycast"),
            Self::Alone => f.write_str("no cap surface"),
            Self::Grid { cells } => write!(f, "grid:{cells}"),
        }
    }
}

impl fmt::Display for InsideTest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Mask => f.write_str("mask"),
            Self::Stencil => f.write_str("stencil"),
            Self::Vds { resolution } => write!(f, "vds:{resolution}"),
        }
    }
}

impl fmt::Display for Strategy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.surface == CapSurface::Alone {
            return write!(f, "{}", self.inside);
        }
        write!(f, "{}+{}", self.surface, self.inside)
    }
}

impl FromStr for Strategy {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let wrong =
            |what: String, mend: String| Error::input(format!("strategy `{text}`"), what, mend);
        if text.trim() == "stencil" {
            return Ok(Self::STENCIL);
        }
        let Some((surface, inside)) = text.split_once('+') else {
            return Err(wrong(
                "a strategy is a cap surface and an inside test".to_owned(),
                "write for example raycast+mask or grid:256+vds:1024; only stencil stands alone"
                    .to_owned(),
            ));
        };
        let number =
            |word: &str, value: Option<&str>, usual: u32, least: u32, most: u32| match value {
                None => Ok(usual),
                Some(v) => match v.parse::<u32>() {
                    Ok(n) if (least..=most).contains(&n) => Ok(n),
                    _ => Err(wrong(
                        format!("`{word}:{v}` is out of range"),
                        format!("use {word}:{least} to {word}:{most}"),
                    )),
                },
            };
        let parts = |word: &str| {
            let (name, value) = word
                .split_once(':')
                .map_or((word, None), |(n, v)| (n, Some(v)));
            (name.trim().to_owned(), value.map(|v| v.trim().to_owned()))
        };
        let (name, value) = parts(surface);
        let surface = match (name.as_str(), value.as_deref()) {
            ("raycast", None) => CapSurface::Raycast,
            ("grid", value) => CapSurface::Grid {
                cells: number("grid", value, 256, 1, 2048)?,
            },
            _ => {
                return Err(wrong(
                    format!("there is no cap surface `{surface}`"),
                    did_you_mean(&name, ["raycast", "grid"]),
                ));
            }
        };
        let (name, value) = parts(inside);
        let inside = match (name.as_str(), value.as_deref()) {
            ("mask", None) => InsideTest::Mask,
            ("stencil", None) => InsideTest::Stencil,
            ("vds", value) => InsideTest::Vds {
                resolution: number("vds", value, 1024, 16, 8192)?,
            },
            _ => {
                return Err(wrong(
                    format!("there is no inside test `{inside}`"),
                    did_you_mean(&name, ["mask", "stencil", "vds"]),
                ));
            }
        };
        Ok(Self { surface, inside })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_survive_a_round_trip() {
        for name in [
            "raycast+mask",
            "raycast+stencil",
            "stencil",
            "grid:256+vds:1024",
            "grid:8+vds:256",
        ] {
            assert_eq!(name.parse::<Strategy>().expect(name).to_string(), name);
        }
        assert_eq!(
            "grid+vds".parse::<Strategy>().expect("defaults"),
            Strategy::PAPER
        );
    }

    #[test]
    fn misspelt_names_are_mended() {
        for (name, mend) in [
            ("raycats+mask", "raycast"),
            ("raycast+msk", "mask"),
            ("grid:0+vds", "grid:1"),
            ("mask", "raycast+mask"),
        ] {
            let message = name.parse::<Strategy>().expect_err(name).to_string();
            assert!(message.contains(mend), "{message}");
        }
    }
}
