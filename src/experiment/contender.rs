//! Who is measured: a strategy, and by which means its frames are drawn; or winding numbers on the CPU.
//!
//! A strategy is written by its name, and after an `@` what differs from the usual: `raycast+mask@compute`,
//! `raycast+mask@compute,32-bit`, `raycast+mask@cells`. `winding` draws by generalised winding numbers
//! ([`Windings`](crate::exact::Windings)): no strategy, but who else could be asked about open meshes. It runs on the CPU, on all
//! its cores, and its times are those of the wall, whatever the clocks of the others are.

use std::fmt;
use std::str::FromStr;

use crate::passes::{Rasteriser, ReliefWalk};
use crate::scene::HeightFilter;
use crate::strategies::{FrameOptions, Strategy};
use crate::{Error, Result};

/// Who draws a frame to be measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Contender {
    /// A strategy, on the device.
    Strategy(Drawn),
    /// Generalised winding numbers, on the CPU.
    Winding,
}

/// A strategy with the means that its frames are drawn by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Drawn {
    /// The strategy.
    pub strategy: Strategy,
    /// Who rasterises the mesh, where it is not who rasterises all.
    pub rasteriser: Option<Rasteriser>,
    /// How rays are followed through reliefs, where it is not left to choose.
    pub relief_walk: Option<ReliefWalk>,
    /// Who interpolates heights, where it is not who does for all.
    pub height_filter: Option<HeightFilter>,
    /// Does without atomics of 64 bits, as core WebGPU has to.
    pub is_narrow: bool,
}

/// A word, and what it does.
type Means = (&'static str, fn(&mut Drawn));

/// What may follow the `@`.
const MEANS: [Means; 6] = [
    ("hardware", |c| c.rasteriser = Some(Rasteriser::Hardware)),
    ("compute", |c| c.rasteriser = Some(Rasteriser::Compute)),
    ("32-bit", |c| c.is_narrow = true),
    ("cells", |c| c.relief_walk = Some(ReliefWalk::Cells)),
    ("pyramid", |c| c.relief_walk = Some(ReliefWalk::Pyramid)),
    ("hardware-filter", |c| {
        c.height_filter = Some(HeightFilter::Hardware);
    }),
];

/// The name of the contender that is no strategy.
const WINDING: &str = "winding";

impl Contender {
    /// Whether a word may follow the `@`.
    pub fn is_means(word: &str) -> bool {
        MEANS.iter().any(|(name, _)| *name == word)
    }

    /// The options of its frames, where the others have these.
    pub fn options(&self, usual: FrameOptions) -> FrameOptions {
        match self {
            Self::Strategy(drawn) => drawn.options(usual),
            Self::Winding => usual,
        }
    }

    /// The strategy, if it is one.
    pub fn strategy(&self) -> Option<Strategy> {
        match self {
            Self::Strategy(drawn) => Some(drawn.strategy),
            Self::Winding => None,
        }
    }
}

impl Drawn {
    fn options(&self, usual: FrameOptions) -> FrameOptions {
        FrameOptions {
            rasteriser: self.rasteriser.unwrap_or(usual.rasteriser),
            relief_walk: self.relief_walk.or(usual.relief_walk),
            height_filter: self.height_filter.or(usual.height_filter),
            wide_atomics: if self.is_narrow {
                Some(false)
            } else {
                usual.wide_atomics
            },
            ..usual
        }
    }
}

impl From<Strategy> for Drawn {
    fn from(strategy: Strategy) -> Self {
        Self {
            strategy,
            rasteriser: None,
            relief_walk: None,
            height_filter: None,
            is_narrow: false,
        }
    }
}

impl From<Strategy> for Contender {
    fn from(strategy: Strategy) -> Self {
        Self::Strategy(strategy.into())
    }
}

impl fmt::Display for Contender {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Strategy(drawn) => drawn.fmt(f),
            Self::Winding => f.write_str(WINDING),
        }
    }
}

impl fmt::Display for Drawn {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.strategy)?;
        let mut separator = '@';
        for (name, apply) in MEANS {
            let mut with = *self;
            apply(&mut with);
            let mut without = Self::from(self.strategy);
            apply(&mut without);
            // A means is named if it is in force and not the usual.
            if with == *self && without != Self::from(self.strategy) {
                write!(f, "{separator}{name}")?;
                separator = ',';
            }
        }
        Ok(())
    }
}

impl FromStr for Contender {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self> {
        let (name, means) = match text.split_once('@') {
            Some((name, means)) => (name.trim(), Some(means)),
            None => (text.trim(), None),
        };
        if name == WINDING {
            return match means {
                None => Ok(Self::Winding),
                Some(_) => Err(Error::input(
                    text,
                    "winding numbers are asked for on the CPU: there are no means to choose",
                    "leave out the @ and what follows",
                )),
            };
        }
        let mut drawn = Drawn::from(name.parse::<Strategy>()?);
        for name in means.into_iter().flat_map(|m| m.split(',')) {
            let Some((_, apply)) = MEANS.iter().find(|(n, _)| *n == name.trim()) else {
                let known: Vec<&str> = MEANS.iter().map(|(n, _)| *n).collect();
                return Err(Error::input(
                    text,
                    format!("`{name}` is no means of drawing"),
                    format!("after the @ write some of {}", known.join(", ")),
                ));
            };
            apply(&mut drawn);
        }
        Ok(Self::Strategy(drawn))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn contenders_are_written_as_they_are_read() {
        for text in [
            "raycast+mask",
            "raycast+mask@compute",
            "grid:64+vds:512",
            "raycast+mask@compute,32-bit",
            "raycast+mask@cells",
            "raycast+mask@hardware",
            "winding",
            "grid:64+vds:512@hardware-filter",
        ] {
            let contender: Contender = text.parse().unwrap();
            assert_eq!(contender.to_string(), text);
        }
        for (text, said) in [
            ("raycast+mask@gpu", "hardware"),
            ("raycats+mask@compute", "did you mean"),
            ("winding@compute", "on the CPU"),
        ] {
            let told = text.parse::<Contender>().unwrap_err().to_string();
            assert!(told.contains(said), "{told}");
        }
    }

    #[test]
    fn means_change_the_options_they_name() {
        let usual = FrameOptions::by(Rasteriser::Hardware);
        let options = |text: &str| text.parse::<Contender>().unwrap().options(usual);
        assert_eq!(options("raycast+mask"), usual);
        assert_eq!(
            options("raycast+mask@compute").rasteriser,
            Rasteriser::Compute
        );
        assert_eq!(
            options("raycast+mask@compute,32-bit").wide_atomics,
            Some(false)
        );
        assert_eq!(
            options("raycast+mask@pyramid").relief_walk,
            Some(ReliefWalk::Pyramid)
        );
    }
}
