//! A strategy at a point: all that was found of it, by name.
//!
//! Names of figures are those of charts and of the columns of the CSV: those of [`crate::experiment::figures`], and for each situation the
//! time over that of drawing the uncut scene. What was not measured is not there.

use std::collections::BTreeMap;

use super::{Situation, number_of};
use crate::experiment::figures::figures;
use crate::experiment::{Record, StrategyMeasurement};

/// A strategy at a point.
#[derive(Clone, Debug)]
pub(crate) struct Row<'a> {
    /// The point.
    pub record: &'a Record,
    /// Which of its strategies.
    pub index: usize,
    /// Figures by name.
    pub figures: BTreeMap<String, f64>,
}

/// All strategies of a point.
pub(crate) fn rows(record: &Record) -> Vec<Row<'_>> {
    (0..record.measurement.strategies.len())
        .map(|index| Row::of(record, index))
        .collect()
}

impl<'a> Row<'a> {
    fn of(record: &'a Record, index: usize) -> Self {
        let measurement = &record.measurement;
        let mut figures = figures(measurement, index, &record.figures[index]);
        let found = &measurement.strategies[index];
        for situation in Situation::ALL {
            if let Some(ratio) = situation.ratio(record, found) {
                figures.insert(situation.figure().to_owned(), ratio);
            }
        }
        Self {
            record,
            index,
            figures,
        }
    }

    /// What was found of the strategy.
    pub(crate) fn found(&self) -> &'a StrategyMeasurement {
        &self.record.measurement.strategies[self.index]
    }

    /// A parameter of the scene or of the strategy, as it is written.
    pub(crate) fn parameter(&self, name: &str) -> Option<&'a str> {
        let of_strategy = self.record.of_strategies[self.index].get(name);
        of_strategy
            .or_else(|| self.record.parameters.get(name))
            .map(String::as_str)
    }

    /// What the experiment calls the strategy: its name, with placeholders where it is swept, `grid:{cells}+mask`. A record that does
    /// not say is read by the values that stand in the name, and errs where two parameters have one value.
    pub(crate) fn family(&self) -> String {
        if let Some(family) = self.record.families.get(self.index) {
            return family.clone();
        }
        let mut name = self.found().name.clone();
        for (parameter, value) in &self.record.of_strategies[self.index] {
            name = with_name_for_value(&name, parameter, value);
        }
        name
    }
}

/// Replaces a value that stands alone in a name, however it is written: `0.50` is `0.5`.
fn with_name_for_value(name: &str, parameter: &str, value: &str) -> String {
    let is_same = |word: &str| {
        word == value
            || matches!((number_of(word), number_of(value)), (Some(a), Some(b)) if a.total_cmp(&b).is_eq())
    };
    let mut told = String::new();
    for word in name.split_inclusive([':', '+', '@', ',']) {
        let bare = word.trim_end_matches([':', '+', '@', ',']);
        if !bare.is_empty() && is_same(bare) {
            told.push_str(&format!("{{{parameter}}}"));
        } else {
            told.push_str(bare);
        }
        told.push_str(&word[bare.len()..]);
    }
    told
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::example;
    use crate::report::derived::standing::tests::record_of;

    #[test]
    fn families_are_those_of_the_experiment() {
        let mut record = record_of(example());
        record.measurement.strategies[0].name = "grid:256+vds:256".to_owned();
        record.of_strategies[0].insert("texels".to_owned(), "256".to_owned());
        let family = |record: &Record| rows(record)[0].family();
        assert_eq!(family(&record), "grid:{texels}+vds:{texels}", "a guess");
        record.families = vec!["grid:256+vds:{texels}".to_owned(), String::new()];
        assert_eq!(family(&record), "grid:256+vds:{texels}");
    }

    #[test]
    fn values_in_names_are_told_by_their_parameter() {
        for (name, value, told) in [
            ("grid:64+vds:1024", "64", "grid:{n}+vds:1024"),
            ("adaptive:0.5+mask", "0.50", "adaptive:{n}+mask"),
            ("grid:640+mask", "64", "grid:640+mask"),
            (
                "raycast+kbuffer:8@compute",
                "8",
                "raycast+kbuffer:{n}@compute",
            ),
            ("raycast+mask", "mask", "raycast+{n}"),
        ] {
            assert_eq!(with_name_for_value(name, "n", value), told);
        }
    }
}
