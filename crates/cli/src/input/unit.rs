//! Length units as option values: `mm`, `in` and so on.

use clap::builder::{PossibleValuesParser, TypedValueParser};
use cutaway::scene::LengthUnit;

/// Parses a unit symbol. The option's help lists all of them.
pub(crate) fn parser() -> impl TypedValueParser<Value = LengthUnit> {
    PossibleValuesParser::new(LengthUnit::ALL.map(LengthUnit::symbol)).try_map(|symbol| {
        let mut all = LengthUnit::ALL.into_iter();
        all.find(|unit| unit.symbol() == symbol)
            .ok_or("no such unit")
    })
}
