//! Who is asked: a strategy, and who rasterises its meshes.
//!
//! One of each family, with parameters that a picture of a few hundred pixels calls for. What does not depend on the size of a picture is
//! asked at the smaller one by all, at the larger one by a few.

use std::fmt;

use crate::strategies::{Rasteriser, Strategy};

/// A strategy, and who rasterises for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entrant {
    /// The strategy.
    pub strategy: Strategy,
    /// Who rasterises the mesh, where it is not who rasterises all.
    pub rasteriser: Option<Rasteriser>,
}

/// Pictures of up to so many pixels along a side are asked of all.
const SMALL_PX: u32 = 64;

/// Pictures of so many pixels along a side are asked of the others.
const LARGE_PX: u32 = 256;

/// All that are asked, and whether about large pictures too.
const NAMES: [(&str, bool); 15] = [
    ("raycast+mask", true),
    ("raycast+mask@compute", true),
    ("raycast+stencil", true),
    ("raycast+abuffer", true),
    ("raycast+abuffer@compute", false),
    ("raycast+kbuffer:8", false),
    ("raycast+ldi:512", false),
    ("raycast+vds:512", false),
    ("stencil", true),
    ("planar", true),
    ("planar@compute", false),
    ("adaptive:0.5+mask", false),
    ("grid:256+mask", false),
    ("grid:256+ldi:512", false),
    ("grid:256+vds:512", true),
];

impl Entrant {
    /// All that are asked about pictures of so many pixels along a side.
    pub fn all(size_px: u32) -> Vec<Self> {
        NAMES
            .iter()
            .filter(|(_, is_large)| size_px <= SMALL_PX || *is_large)
            .filter_map(|(name, _)| Self::named(name))
            .collect()
    }

    /// Sides of the pictures that the table usually asks it about.
    pub fn usual_sizes_px(&self) -> &'static [u32] {
        let is_small = Self::all(SMALL_PX).contains(self) && !Self::all(LARGE_PX).contains(self);
        match is_small {
            true => &[SMALL_PX],
            false => &[SMALL_PX, LARGE_PX],
        }
    }

    /// By name: a strategy, and `@compute` where the compute rasteriser is to draw. None for what is no name.
    pub fn named(name: &str) -> Option<Self> {
        let (strategy, rasteriser) = match name.split_once('@') {
            None => (name, None),
            Some((strategy, "compute")) => (strategy, Some(Rasteriser::Compute)),
            Some(_) => return None,
        };
        Some(Self {
            strategy: strategy.parse().ok()?,
            rasteriser,
        })
    }

    /// Texels along a side of its depth images, if it has any.
    pub fn resolution(&self) -> Option<u32> {
        use crate::strategies::InsideTest::{Ldi, Vds};
        match self.strategy.inside {
            Vds { resolution } | Ldi { resolution } => Some(resolution),
            _ => None,
        }
    }
}

impl From<Strategy> for Entrant {
    fn from(strategy: Strategy) -> Self {
        Self {
            strategy,
            rasteriser: None,
        }
    }
}

impl fmt::Display for Entrant {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.strategy)?;
        self.rasteriser.map_or(Ok(()), |r| write!(f, "@{r}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_is_that_of_an_entrant() {
        let all = Entrant::all(SMALL_PX);
        assert_eq!(all.len(), NAMES.len(), "a name is misspelt");
        for (entrant, (name, _)) in all.iter().zip(NAMES) {
            assert_eq!(entrant.to_string(), name);
        }
        let large = Entrant::all(SMALL_PX + 1).len();
        assert!(large < all.len(), "{large} are asked about large pictures");
        assert_eq!(Entrant::named("raycast+mask@abacus"), None);
    }
}
