//! Units of length as values of options: `mm`, `in` and so on.

use clap::ValueEnum;
use clap::builder::PossibleValue;

use crate::scene::LengthUnit;

impl ValueEnum for LengthUnit {
    fn value_variants<'a>() -> &'a [Self] {
        &Self::ALL
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        Some(PossibleValue::new(self.symbol()))
    }
}
