//! Names and parameters of defects, and their text form: `holes:amount=5%,seed=1,patch=1`.

use std::fmt;

use super::{Defect, DefectKind};
use crate::scene::Amount;
use crate::scene::describe::{Described, Field, Given, Leaf, ValueType, words};

/// Largest number of pieces accepted; more are taken for a typing error.
const MOST_PIECES: f64 = 100_000.0;

/// Sides by name: the number of the axis, and true for the end with the smaller coordinates.
const AXES: [(&str, (usize, bool)); 6] = [
    ("x", (0, false)),
    ("y", (1, false)),
    ("z", (2, false)),
    ("-x", (0, true)),
    ("-y", (1, true)),
    ("-z", (2, true)),
];

fn axis_name(axis: usize, from_below: bool) -> &'static str {
    let is_it = |(_, side): &&(&str, (usize, bool))| *side == (axis, from_below);
    AXES.iter().find(is_it).map_or("z", |(name, _)| name)
}

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

    /// The kind with a given name, with default parameters.
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

    /// Returns true if the amount is a length rather than a share.
    pub(super) fn is_length(&self) -> bool {
        matches!(self, Self::Gaps { .. } | Self::Soup)
    }

    /// The piece count (patch size, charts or copies), for kinds that have one.
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
    /// A defect of a kind with the default amount and seed.
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

    /// Returns the reason if the amount is invalid for this kind.
    pub fn defect(&self) -> Option<&'static str> {
        match self.amount {
            Amount::Percent(p) if !(0.0..=100.0).contains(&p) => Some("it must be from 0% to 100%"),
            Amount::Units(v) if !self.kind.is_length() && v != 0.0 => {
                Some("it is a share: write it in percent, for example 5%")
            }
            _ => None,
        }
    }

    /// Declarations of the values of all kinds.
    pub const FIELDS: &'static [Field] = &[AMOUNT, SEED, PATCH, CHARTS, COPIES, AXIS];
}

const AMOUNT: Field = Field::leaf(
    "amount",
    "amount of damage",
    Amount::TYPE.within(0.0, f64::INFINITY),
    "\"5%\"",
)
.fixed();
const SEED: Field = Field::leaf("seed", "seed for the choice of faces", u64::TYPE, "1").fixed();
const PIECES: ValueType = ValueType::Whole(1.0, MOST_PIECES);
const PATCH: Field = Field::leaf(
    "patch",
    "adjacent faces per patch (holes, flipped, duplicated)",
    PIECES,
    "12",
)
.fixed();
const CHARTS: Field = Field::leaf("charts", "number of pieces (gaps)", PIECES, "8").fixed();
const COPIES: Field =
    Field::leaf("copies", "number of small copies (overlap)", PIECES, "8").fixed();
const AXIS: Field = Field::leaf(
    "axis",
    "side to remove (open)",
    ValueType::Choice(&words(&AXES)),
    "\"-z\"",
);

/// The fields that apply to its kind.
impl Described for Defect {
    fn fields(&self) -> &'static [Field] {
        match self.kind {
            DefectKind::Holes { .. }
            | DefectKind::Flipped { .. }
            | DefectKind::Duplicated { .. } => &[AMOUNT, SEED, PATCH],
            DefectKind::TJunctions | DefectKind::Soup => &[AMOUNT, SEED],
            DefectKind::Gaps { .. } => &[AMOUNT, SEED, CHARTS],
            DefectKind::Overlap { .. } => &[AMOUNT, SEED, COPIES],
            DefectKind::Open { .. } => &[AMOUNT, AXIS],
        }
    }

    fn set(&mut self, field: usize, given: Given) -> bool {
        match (self.fields().get(field).map_or("", |f| f.key), given) {
            ("amount", given) => self.amount.set(given),
            ("seed", given) => self.seed.set(given),
            ("axis", Given::Text(word)) => {
                let known = AXES.iter().find(|(name, _)| *name == word);
                if let Some((_, (axis, from_below))) = known {
                    self.kind = DefectKind::Open {
                        axis: *axis,
                        from_below: *from_below,
                    };
                }
                known.is_some()
            }
            (_, given) => self.kind.pieces().is_some_and(|pieces| pieces.set(given)),
        }
    }

    fn get(&self, field: usize) -> Option<Given> {
        match (self.fields().get(field)?.key, self.kind) {
            ("amount", _) => self.amount.get(),
            ("seed", _) => self.seed.get(),
            ("axis", DefectKind::Open { axis, from_below }) => {
                Some(Given::Text(axis_name(axis, from_below).to_owned()))
            }
            (_, mut kind) => kind.pieces()?.get(),
        }
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
            return write!(f, ",axis={}", axis_name(axis, from_below));
        }
        write!(f, ",seed={}", self.seed)?;
        let mut kind = self.kind;
        match (self.fields().get(2), kind.pieces()) {
            (Some(field), Some(count)) => write!(f, ",{}={count}", field.key),
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_value_is_set_and_read_back() {
        for name in DefectKind::NAMES {
            let mut defect = Defect::of(DefectKind::named(name).expect(name));
            let before = defect;
            for (index, field) in defect.fields().iter().enumerate() {
                let given = defect.get(index);
                let given = given.unwrap_or_else(|| panic!("{name}: {}", field.key));
                assert!(defect.set(index, given), "{name}: {}", field.key);
            }
            assert_eq!(defect, before, "{name}");
        }
    }
}
