//! Strategies and their names: `raycast+mask`, `adaptive:0.5+mask`, `grid:256+vds:1024`; `planar` and `stencil` stand alone.

use std::fmt;
use std::str::FromStr;

use super::row::{
    Abilities, CapSurface, CapSurfaceRow, Caps, InsideTest, InsideTestKind, SelectedRow,
    StrategyRow,
};
use super::table::{CAP_SURFACES, INSIDE_TESTS, all};
use super::{inside, surface};
use crate::Error;
use crate::error::{did_you_mean, nearest};

impl CapSurface {
    /// All crossings of each pixel's ray, exactly.
    pub const RAYCAST: Self = Self::new(&surface::raycast::ROW, 0);
    /// The section of the mesh by the plane, triangulated.
    pub const PLANAR: Self = Self::new(&surface::planar::ROW, 0);
    /// One plane, counted in the stencil.
    pub const STENCIL: Self = Self::new(&inside::stencil::alone::ROW, 0);

    /// The paper's quad, refined into `cells` cells along each side and displaced.
    pub const fn grid(cells: u32) -> Self {
        Self::new(&surface::grid::ROW, cells)
    }

    /// A tessellation just fine enough to stay within `tau_px` pixels of the relief; `None` unless `tau_px` is 0.01 to 100.
    pub fn adaptive(tau_px: f64) -> Option<Self> {
        Self::with(&surface::adaptive::ROW, tau_px)
    }
}

impl InsideTest {
    /// Parity bits per crossing, written by a single pass over the mesh.
    pub const MASK: Self = Self::new(&inside::mask::ROW, 0);
    /// Generalised winding numbers of parts that are not closed; other parts as by [`Self::MASK`].
    pub const WINDING: Self = Self::new(&inside::winding::ROW, 0);
    /// Parity in the stencil buffer, a draw of the mesh for each crossing.
    pub const STENCIL: Self = Self::new(&inside::stencil::ROW, 0);

    /// The paper's volumetric depth sprite, with `resolution` texels along each side.
    pub const fn vds(resolution: u32) -> Self {
        Self::new(&inside::vds::ROW, resolution)
    }

    /// A layered depth image, whose lists keep fragments that depth peeling loses, with `resolution` texels along each side.
    pub const fn ldi(resolution: u32) -> Self {
        Self::new(&inside::ldi::ROW, resolution)
    }

    /// Returns true if it tests points against images of the part.
    pub fn is_of_points(&self) -> bool {
        matches!(self.row().answers, InsideTestKind::Points(_))
    }
}

/// A cap surface with an inside test.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Strategy {
    /// Cap surface, which determines where caps are possible.
    pub surface: CapSurface,
    /// Inside test, which decides where caps are; `None` if the cap surface decides that.
    pub inside: Option<InsideTest>,
}

impl Strategy {
    /// The exact strategy.
    pub const RAYCAST_MASK: Self = Self::new(CapSurface::RAYCAST, InsideTest::MASK);
    /// `raycast+winding`: as `raycast+mask`, and right for meshes that are not closed.
    pub const RAYCAST_WINDING: Self = Self::new(CapSurface::RAYCAST, InsideTest::WINDING);
    /// The exact strategy by fixed-function hardware.
    pub const RAYCAST_STENCIL: Self = Self::new(CapSurface::RAYCAST, InsideTest::STENCIL);
    /// The section of the mesh, triangulated.
    pub const PLANAR: Self = Self::alone(CapSurface::PLANAR);
    /// The classic method for one plane.
    pub const STENCIL: Self = Self::alone(CapSurface::STENCIL);
    /// The paper's method, with the paper's parameters.
    pub const PAPER: Self = Self::new(CapSurface::grid(256), InsideTest::vds(1024));

    /// A cap surface with an inside test.
    pub const fn new(surface: CapSurface, inside: InsideTest) -> Self {
        Self {
            surface,
            inside: Some(inside),
        }
    }

    /// A cap surface that needs no inside test.
    pub const fn alone(surface: CapSurface) -> Self {
        Self {
            surface,
            inside: None,
        }
    }

    /// One strategy of each kind, with default parameters.
    pub fn all() -> Vec<Self> {
        all()
    }

    /// Returns true if it has the same cap surface and inside test, with any parameters.
    pub fn is_of_the_kind(&self, other: &Self) -> bool {
        let kind = |s: &Self| (s.surface.facts().name, s.inside.map(|i| i.facts().name));
        kind(self) == kind(other)
    }

    /// Features that it supports.
    pub fn can(&self) -> Abilities {
        let of_surface = self.surface.facts().can;
        let both = match &self.inside {
            Some(inside) => of_surface.and(inside.facts().can),
            None => of_surface,
        };
        match self.is_by_the_papers_rule() {
            // Each clip-surface is drawn by itself: there is no list of crossings in which to test all parts or to insert cutter faces.
            true => Abilities {
                overlaps: false,
                cutters: false,
                compute: false,
                ..both
            },
            false => both,
        }
    }

    /// Limitations in a few words; empty if there are none.
    pub fn limit(&self) -> &'static str {
        let of_test = self.inside.map_or("", |inside| inside.facts().limit);
        match self.surface.facts().limit {
            "" => of_test,
            limit => limit,
        }
    }

    /// Texels along a side of the images that its inside test samples, if any.
    pub fn resolution(&self) -> Option<u32> {
        let inside = self.inside.filter(InsideTest::is_of_points)?;
        Some(inside.steps())
    }

    /// Returns true if clip-surfaces are drawn as triangles.
    pub fn is_tessellated(&self) -> bool {
        matches!(self.surface.row().caps, Caps::Triangles(_))
    }

    /// Returns true if surface and caps of a frame follow from the per-pixel list of crossings.
    pub fn lists_crossings(&self) -> bool {
        self.inside.is_some() && !self.is_by_the_papers_rule()
    }

    /// Returns true if the mesh is clipped by chi at every fragment and the tessellated cap is drawn separately, as in the paper, instead
    /// of both by the per-pixel list of crossings. This is so if the inside test answers for points.
    pub fn is_by_the_papers_rule(&self) -> bool {
        self.is_tessellated() && self.inside.is_some_and(|i| i.is_of_points())
    }
}

impl fmt::Display for Strategy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.inside {
            Some(inside) => write!(f, "{}+{inside}", self.surface),
            None => self.surface.fmt(f),
        }
    }
}

impl FromStr for Strategy {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let wrong = |what: String, help: String| {
            Error::input(format!("strategy `{}`", text.trim()), what, help)
        };
        let (surface, inside) = match text.split_once('+') {
            Some((surface, inside)) => (surface.trim(), Some(inside.trim())),
            None => (text.trim(), None),
        };
        let (alone, listed): (Vec<&'static CapSurfaceRow>, Vec<&'static CapSurfaceRow>) =
            CAP_SURFACES.iter().partition(|row| row.is_alone());
        let by_itself = alone.iter().find(|row| row.facts.name == surface);
        match (by_itself, inside) {
            (Some(row), None) => Ok(Self::alone(SelectedRow::usual(*row))),
            (Some(_), Some(_)) => Err(wrong(
                format!("`{surface}` takes no inside test"),
                format!("write `{surface}` alone"),
            )),
            (None, Some(inside)) => Ok(Self::new(
                chosen("cap surface", surface, &listed, &wrong)?,
                chosen("inside test", inside, INSIDE_TESTS, &wrong)?,
            )),
            (None, None) => {
                let names: Vec<&str> = alone.iter().map(|row| row.facts.name).collect();
                let usual = format!(
                    "write for example {} or {}; {} stand alone",
                    Self::RAYCAST_MASK,
                    Self::PAPER,
                    names.join(" and ")
                );
                Err(wrong(
                    "a strategy is a cap surface and an inside test".to_owned(),
                    match nearest(surface, &names) {
                        Some(near) => format!("did you mean `{near}`? Or {usual}"),
                        None => usual,
                    },
                ))
            }
        }
    }
}

/// The row with the given name, with its parameter.
fn chosen<R: StrategyRow>(
    what: &str,
    word: &str,
    rows: &[&'static R],
    wrong: &dyn Fn(String, String) -> Error,
) -> Result<SelectedRow<R>, Error> {
    let (name, value) = match word.split_once(':') {
        Some((name, value)) => (name.trim(), Some(value.trim())),
        None => (word, None),
    };
    let Some(row) = rows.iter().find(|row| row.facts().name == name) else {
        return Err(wrong(
            format!("there is no {what} `{name}`"),
            did_you_mean(name, rows.iter().map(|row| row.facts().name)),
        ));
    };
    match (value, &row.facts().parameter) {
        (None, _) => Ok(SelectedRow::usual(*row)),
        (Some(value), None) => Err(wrong(
            format!("{name} takes no parameter, but `:{value}` follows"),
            format!("write {name}"),
        )),
        (Some(value), Some(parameter)) => {
            let number = value.parse().ok();
            number
                .and_then(|n| SelectedRow::with(*row, n))
                .ok_or_else(|| {
                    let [least, most] =
                        [parameter.least, parameter.most].map(|s| SelectedRow::new(*row, s));
                    wrong(
                        format!("`{word}` is out of range"),
                        format!("use {least} to {most}: {}", parameter.about),
                    )
                })
        }
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
        for strategy in Strategy::all() {
            let name = strategy.to_string();
            assert_eq!(name.parse::<Strategy>().expect(&name), strategy);
        }
    }

    #[test]
    fn misspelt_names_are_mended() {
        for (name, help) in [
            ("raycats+mask", "raycast"),
            ("raycast+msk", "mask"),
            ("raycast:3+mask", "write raycast"),
            ("grid:0+vds", "grid:1"),
            ("grid:2.5+vds", "use grid:1 to grid:2048"),
            ("adaptive:0+mask", "adaptive:0.01"),
            ("adaptiv+mask", "adaptive"),
            ("planar+mask", "write `planar` alone"),
            ("mask", "help: write for example raycast+mask"),
            ("planarr", "did you mean `planar`?"),
            ("stensil", "did you mean `stencil`?"),
        ] {
            let message = name.parse::<Strategy>().expect_err(name).to_string();
            assert!(message.contains(help), "{message}");
        }
    }
}
