//! Defects as one word: `KIND[:amount=5%,seed=1]`.

use std::fmt;
use std::str::FromStr;

use super::{Defect, DefectKind};
use crate::error::{Error, Result, did_you_mean};
use crate::scene::section::Amount;

const EXAMPLE: &str = "write for example `holes:amount=5%,seed=1` or `soup:amount=0.01`";

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

    /// Whether its amount is a length rather than a share.
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

    /// Sets a key of [`DefectKind::keys`]; what is wrong with the value otherwise.
    pub fn set(&mut self, key: &str, value: &str) -> Result<(), String> {
        let whole = |value: &str| value.parse::<u64>().map_err(|_| "it is no whole number");
        match key {
            "amount" => self.set_amount(Amount::parse(value)?),
            "seed" => {
                self.seed = whole(value)?;
                Ok(())
            }
            "axis" => {
                let known = AXES.iter().find(|(name, ..)| *name == value);
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
            _ => {
                let count = u32::try_from(whole(value)?).unwrap_or(u32::MAX);
                if !(1..=MOST_PIECES).contains(&count) {
                    return Err(format!("it must be from 1 to {MOST_PIECES}"));
                }
                match self.kind.pieces() {
                    Some(pieces) => *pieces = count,
                    None => return Err(format!("{} has no such key", self.kind.name())),
                }
                Ok(())
            }
        }
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

impl FromStr for Defect {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self> {
        let fault =
            |what: String, mend: String| Err(Error::input(format!("defect `{text}`"), what, mend));
        let (name, settings) = text.split_once(':').unwrap_or((text, ""));
        let Some(kind) = DefectKind::named(name.trim()) else {
            let mend = did_you_mean(name.trim(), DefectKind::NAMES);
            return fault("there is no such defect".to_owned(), mend);
        };
        let mut defect = Self::of(kind);
        for setting in settings.split(',').filter(|s| !s.trim().is_empty()) {
            let Some((key, value)) = setting.split_once('=') else {
                let what = format!("`{setting}` is not of the form key=value");
                return fault(what, EXAMPLE.to_owned());
            };
            let (key, value) = (key.trim(), value.trim());
            if !kind.keys().contains(&key) {
                let mend = did_you_mean(key, kind.keys().iter().copied());
                return fault(format!("`{key}` is no key of {}", kind.name()), mend);
            }
            if let Err(what) = defect.set(key, value) {
                return fault(format!("{key} = `{value}`: {what}"), EXAMPLE.to_owned());
            }
        }
        Ok(defect)
    }
}
