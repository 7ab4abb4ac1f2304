//! Names and numbers of defects, and how one is written: `holes:amount=5%,seed=1,patch=1`.

use std::fmt;

use super::{Defect, DefectKind};
use crate::scene::Amount;

/// Pieces of a mesh: more than this are a slip.
const MOST_PIECES: u32 = 100_000;

const AXES: [(&str, usize, bool); 6] = [
    ("x", 0, false),
    ("y", 1, false),
    ("z", 2, false),
    ("-x", 0, true),
    ("-y", 1, true),
    ("-z", 2, true),
];

impl DefectKind {
    /// Names of all kinds.
    pub const NAMES: [&str; 8] = [
        "holes",
        "flipped",
        "duplicated",
        "t-junctions",
        "gaps",
        "overlap",
        "open",
        "soup",
    ];

    /// The kind of a name, with its usual numbers.
    pub fn named(name: &str) -> Option<Self> {
        Some(match name {
            "holes" => Self::Holes { patch: 1 },
            "flipped" => Self::Flipped { patch: 1 },
            "duplicated" => Self::Duplicated { patch: 1 },
            "t-junctions" => Self::TJunctions,
            "gaps" => Self::Gaps { charts: 8 },
            "overlap" => Self::Overlap { copies: 8 },
            "open" => Self::Open {
                axis: 2,
                from_below: false,
            },
            "soup" => Self::Soup,
            _ => return None,
        })
    }

    /// Its name.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Holes { .. } => "holes",
            Self::Flipped { .. } => "flipped",
            Self::Duplicated { .. } => "duplicated",
            Self::TJunctions => "t-junctions",
            Self::Gaps { .. } => "gaps",
            Self::Overlap { .. } => "overlap",
            Self::Open { .. } => "open",
            Self::Soup => "soup",
        }
    }

    /// Keys of a defect of this kind.
    pub fn keys(&self) -> &'static [&'static str] {
        match self {
            Self::Holes { .. } | Self::Flipped { .. } | Self::Duplicated { .. } => {
                &["amount", "seed", "patch"]
            }
            Self::TJunctions | Self::Soup => &["amount", "seed"],
            Self::Gaps { .. } => &["amount", "seed", "charts"],
            Self::Overlap { .. } => &["amount", "seed", "copies"],
            Self::Open { .. } => &["amount", "axis"],
        }
    }

    /// Returns true if the amount is a length rather than a share.
    pub(super) fn is_length(&self) -> bool {
        matches!(self, Self::Gaps { .. } | Self::Soup)
    }

    /// The number of pieces, for kinds that have one.
    fn pieces(&mut self) -> Option<&mut u32> {
        match self {
            Self::Holes { patch } | Self::Flipped { patch } | Self::Duplicated { patch } => {
                Some(patch)
            }
            Self::Gaps { charts: count } | Self::Overlap { copies: count } => Some(count),
            _ => None,
        }
    }
}

impl Defect {
    /// A defect of a kind with the usual amount and seed.
    pub fn of(kind: DefectKind) -> Self {
        let percent = match kind {
            DefectKind::Gaps { .. } | DefectKind::Soup => 1.0,
            DefectKind::Overlap { .. } | DefectKind::Open { .. } => 20.0,
            _ => 5.0,
        };
        Self {
            kind,
            amount: Amount::Percent(percent),
            seed: 1,
        }
    }

    /// Sets the side that is missing; what is wrong with the word otherwise.
    pub fn set_axis(&mut self, word: &str) -> Result<(), String> {
        let known = AXES.iter().find(|(name, ..)| *name == word);
        let Some((_, axis, from_below)) = known else {
            let names = AXES.map(|(name, ..)| name);
            return Err(format!("use one of: {}", names.join(", ")));
        };
        self.kind = DefectKind::Open {
            axis: *axis,
            from_below: *from_below,
        };
        Ok(())
    }

    /// Sets the seed, or the number of pieces by its key; what is wrong with the number otherwise.
    pub fn set_number(&mut self, key: &str, number: u64) -> Result<(), String> {
        if key == "seed" {
            self.seed = number;
            return Ok(());
        }
        let count = u32::try_from(number).unwrap_or(u32::MAX);
        if !(1..=MOST_PIECES).contains(&count) {
            return Err(format!("it must be from 1 to {MOST_PIECES}"));
        }
        match self.kind.pieces() {
            Some(pieces) => *pieces = count,
            None => return Err(format!("{} has no such key", self.kind.name())),
        }
        Ok(())
    }

    /// Sets the amount; what is wrong with it otherwise.
    pub fn set_amount(&mut self, amount: Amount) -> Result<(), String> {
        let is_length = self.kind.is_length();
        match amount {
            Amount::Percent(p) if !(0.0..=100.0).contains(&p) => {
                return Err("it must be from 0% to 100%".to_owned());
            }
            Amount::Units(v) if is_length && v < 0.0 => {
                return Err("it must not be below 0".to_owned());
            }
            Amount::Units(v) if !is_length && v != 0.0 => {
                return Err("it is a share: write it in percent, for example 5%".to_owned());
            }
            _ => {}
        }
        self.amount = amount;
        Ok(())
    }
}

impl fmt::Display for Defect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:amount=", self.kind.name())?;
        match self.amount {
            Amount::Units(v) => write!(f, "{v}")?,
            Amount::Percent(p) => write!(f, "{p}%")?,
        }
        if let DefectKind::Open { axis, from_below } = self.kind {
            let is_it = |(_, a, b): &&(&str, usize, bool)| *a == axis && *b == from_below;
            let name = AXES.iter().find(is_it).map_or("z", |(name, ..)| name);
            return write!(f, ",axis={name}");
        }
        write!(f, ",seed={}", self.seed)?;
        let mut kind = self.kind;
        match (kind.keys().get(2), kind.pieces()) {
            (Some(key), Some(count)) => write!(f, ",{key}={count}"),
            _ => Ok(()),
        }
    }
}
