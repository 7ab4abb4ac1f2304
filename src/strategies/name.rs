//! Names of strategies: `raycast+mask`, `adaptive:0.5+mask`, `grid:256+vds:1024`; `planar` and `stencil` stand alone.

use std::fmt;
use std::str::FromStr;

use crate::Error;
use crate::error::did_you_mean;

/// A way to produce cap points per pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
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
    /// A tessellation as fine as the screen asks for.
    Adaptive {
        /// Error on the screen that it stays under.
        tau: Tau,
    },
    /// The section of the mesh by the plane, triangulated.
    Planar,
}

/// An error on the screen, kept in thousandths of a pixel so that it is equal to itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Tau {
    thousandths_px: u32,
}

impl Tau {
    /// Half a pixel.
    pub const HALF: Self = Self {
        thousandths_px: 500,
    };

    /// So many pixels, rounded to thousandths; none outside of 0.01 to 100.
    pub fn of_px(px: f64) -> Option<Self> {
        (0.01..=100.0).contains(&px).then(|| Self {
            thousandths_px: (px * 1000.0).round() as u32,
        })
    }

    /// In pixels.
    pub fn px(self) -> f64 {
        f64::from(self.thousandths_px) / 1000.0
    }
}

impl fmt::Display for Tau {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.px())
    }
}

/// A way to tell whether a point is inside a solid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum InsideTest {
    /// None: the cap surface ends where the solid does.
    Alone,
    /// Parity bits per crossing, written by the one pass over the mesh.
    Mask,
    /// Parity in the stencil buffer, a draw of the mesh for each crossing.
    Stencil,
    /// All fragments of each pixel, in lists.
    ABuffer,
    /// The nearest fragments of each pixel and part.
    KBuffer {
        /// How many.
        depths: u32,
    },
    /// The paper's volumetric depth sprite.
    Vds {
        /// Texels along a side.
        resolution: u32,
    },
    /// Layered depth images, built in every frame.
    Ldi {
        /// Texels along a side.
        resolution: u32,
    },
}

impl InsideTest {
    /// Whether it can fill a part by the nonzero rule.
    pub fn counts_winding(self) -> bool {
        matches!(self, Self::Mask | Self::Stencil)
    }

    /// Texels along a side of its depth images, if it has any.
    pub fn resolution(self) -> Option<u32> {
        match self {
            Self::Vds { resolution } | Self::Ldi { resolution } => Some(resolution),
            _ => None,
        }
    }
}

/// A cap surface with an inside test.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
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
    /// The section of the mesh, triangulated.
    pub const PLANAR: Self = Self {
        surface: CapSurface::Planar,
        inside: InsideTest::Alone,
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
    /// One of each kind that is built, with its usual parameters; what `all` means. `grid` and `adaptive` go with the other
    /// inside tests as well.
    pub const ALL: [Self; 12] = [
        Self::RAYCAST_MASK,
        Self::RAYCAST_STENCIL,
        Self::STENCIL,
        Self::PLANAR,
        Self::raycast(InsideTest::ABuffer),
        Self::raycast(InsideTest::KBuffer { depths: 8 }),
        Self::raycast(InsideTest::Ldi { resolution: 1024 }),
        Self::raycast(InsideTest::Vds { resolution: 1024 }),
        Self {
            surface: CapSurface::Adaptive { tau: Tau::HALF },
            inside: InsideTest::Mask,
        },
        Self {
            surface: CapSurface::Grid { cells: 256 },
            inside: InsideTest::Mask,
        },
        Self {
            surface: CapSurface::Grid { cells: 256 },
            inside: InsideTest::Ldi { resolution: 1024 },
        },
        Self::PAPER,
    ];

    const fn raycast(inside: InsideTest) -> Self {
        Self {
            surface: CapSurface::Raycast,
            inside,
        }
    }

    /// Whether it can fill a part by the nonzero rule.
    pub fn counts_winding(self) -> bool {
        self.inside.counts_winding() || self.surface == CapSurface::Planar
    }

    /// Whether it can say where several parts share a cap: all parts are asked at one crossing.
    pub fn tells_overlaps(self) -> bool {
        !self.is_by_the_papers_rule() && self.surface != CapSurface::Alone
    }

    /// Whether surface and caps of a frame follow from the one list of crossings per pixel.
    pub fn lists_crossings(self) -> bool {
        let alone = matches!(self.surface, CapSurface::Planar | CapSurface::Alone);
        !alone && !self.is_by_the_papers_rule()
    }

    /// Whether the mesh is clipped by chi at every fragment and the tessellated cap drawn by itself, as in the paper, rather than
    /// both by one list of crossings: where the inside test answers for points.
    pub fn is_by_the_papers_rule(self) -> bool {
        let tessellated = matches!(
            self.surface,
            CapSurface::Grid { .. } | CapSurface::Adaptive { .. }
        );
        let of_points = matches!(self.inside, InsideTest::Vds { .. } | InsideTest::Ldi { .. });
        tessellated && of_points
    }
}

impl fmt::Display for CapSurface {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Raycast => f.write_str("raycast"),
            Self::Alone => f.write_str("no cap surface"),
            Self::Grid { cells } => write!(f, "grid:{cells}"),
            Self::Adaptive { tau } => write!(f, "adaptive:{tau}"),
            Self::Planar => f.write_str("planar"),
        }
    }
}

impl fmt::Display for InsideTest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Alone => f.write_str("no inside test"),
            Self::Mask => f.write_str("mask"),
            Self::Stencil => f.write_str("stencil"),
            Self::ABuffer => f.write_str("abuffer"),
            Self::KBuffer { depths } => write!(f, "kbuffer:{depths}"),
            Self::Vds { resolution } => write!(f, "vds:{resolution}"),
            Self::Ldi { resolution } => write!(f, "ldi:{resolution}"),
        }
    }
}

impl fmt::Display for Strategy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.surface == CapSurface::Alone {
            return write!(f, "{}", self.inside);
        }
        if self.inside == InsideTest::Alone {
            return write!(f, "{}", self.surface);
        }
        write!(f, "{}+{}", self.surface, self.inside)
    }
}

impl FromStr for Strategy {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let wrong =
            |what: String, mend: String| Error::input(format!("strategy `{text}`"), what, mend);
        match text.trim() {
            "stencil" => return Ok(Self::STENCIL),
            "planar" => return Ok(Self::PLANAR),
            _ => {}
        }
        let Some((surface, inside)) = text.split_once('+') else {
            let usual = "write for example raycast+mask or grid:256+vds:1024; planar and stencil stand alone";
            let near = did_you_mean(text.trim(), ["planar", "stencil"]);
            let near = near.split_once("? Known").map(|(near, _)| near);
            return Err(wrong(
                "a strategy is a cap surface and an inside test".to_owned(),
                near.map_or_else(|| usual.to_owned(), |near| format!("{near}? Or {usual}")),
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
            ("adaptive", None) => CapSurface::Adaptive { tau: Tau::HALF },
            ("adaptive", Some(value)) => CapSurface::Adaptive {
                tau: value.parse().ok().and_then(Tau::of_px).ok_or_else(|| {
                    wrong(
                        format!("`adaptive:{value}` is out of range"),
                        "use adaptive:0.01 to adaptive:100, an error in pixels".to_owned(),
                    )
                })?,
            },
            ("planar", None) => CapSurface::Planar,
            _ => {
                return Err(wrong(
                    format!("there is no cap surface `{surface}`"),
                    did_you_mean(&name, ["raycast", "grid", "adaptive", "planar"]),
                ));
            }
        };
        let (name, value) = parts(inside);
        let inside = match (name.as_str(), value.as_deref()) {
            ("mask", None) => InsideTest::Mask,
            ("stencil", None) => InsideTest::Stencil,
            ("abuffer", None) => InsideTest::ABuffer,
            ("kbuffer", value) => InsideTest::KBuffer {
                depths: number("kbuffer", value, 8, 1, 32)?,
            },
            ("vds", value) => InsideTest::Vds {
                resolution: number("vds", value, 1024, 16, 8192)?,
            },
            ("ldi", value) => InsideTest::Ldi {
                resolution: number("ldi", value, 1024, 16, 8192)?,
            },
            _ => {
                return Err(wrong(
                    format!("there is no inside test `{inside}`"),
                    did_you_mean(
                        &name,
                        ["mask", "stencil", "abuffer", "kbuffer", "vds", "ldi"],
                    ),
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
            "raycast+abuffer",
            "raycast+kbuffer:4",
            "raycast+ldi:64",
            "grid:256+vds:1024",
            "grid:8+vds:256",
            "grid:64+mask",
            "adaptive:0.5+mask",
            "adaptive:2+vds:1024",
            "planar",
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
            ("adaptive:0+mask", "adaptive:0.01"),
            ("adaptiv+mask", "adaptive"),
            ("mask", "help: write for example raycast+mask"),
            ("planarr", "did you mean `planar`?"),
            ("stensil", "did you mean `stencil`?"),
        ] {
            let message = name.parse::<Strategy>().expect_err(name).to_string();
            assert!(message.contains(mend), "{message}");
        }
    }
}
