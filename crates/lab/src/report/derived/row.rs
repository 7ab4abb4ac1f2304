//! All figures of a strategy at a point, by name: one row of the CSV file.
//!
//! Charts and CSV columns use the same figure names: those of [`crate::experiment::figures`], and for each situation one name for the
//! time divided by the time to draw the uncut scene. Figures that were not measured are absent.

use std::collections::BTreeMap;

use super::Situation;
use crate::experiment::figures::figures;
use crate::experiment::{FamilyMember, Parameter, Record, StrategyMeasurement};

/// A strategy at a point.
#[derive(Clone, Debug)]
pub(crate) struct Row<'a> {
    /// The point.
    pub record: &'a Record,
    /// Index of the strategy in the record.
    pub index: usize,
    /// Family and parameters of the strategy.
    pub member: &'a FamilyMember,
    /// Figures by name.
    pub figures: BTreeMap<String, f64>,
}

/// All strategies of a point.
pub(crate) fn rows(record: &Record) -> Vec<Row<'_>> {
    (0..record.measurement.strategies.len())
        .map(|index| Row::of(record, index, &record.families[index][0]))
        .collect()
}

/// The strategies of a point, with one row for each strategy text of the experiment that produced the strategy.
pub(crate) fn rows_by_family(record: &Record) -> Vec<Row<'_>> {
    (record.families.iter().enumerate())
        .flat_map(|(index, families)| families.iter().map(move |m| Row::of(record, index, m)))
        .collect()
}

impl<'a> Row<'a> {
    fn of(record: &'a Record, index: usize, member: &'a FamilyMember) -> Self {
        let measurement = &record.measurement;
        let mut figures = figures(measurement, index, &record.figures[index]);
        let found = &measurement.strategies[index];
        for situation in Situation::ALL {
            if let Some(ratios) = situation.ratios(record, found) {
                figures.insert(situation.figure().to_owned(), ratios.median);
                figures.insert(format!("{}.mad", situation.figure()), ratios.mad);
            }
        }
        Self {
            record,
            index,
            member,
            figures,
        }
    }

    /// Measurement of the strategy.
    pub(crate) fn found(&self) -> &'a StrategyMeasurement {
        &self.record.measurement.strategies[self.index]
    }

    /// A parameter of the scene or of the strategy.
    pub(crate) fn parameter(&self, name: &str) -> Option<&'a Parameter> {
        let of_strategy = self.member.parameters.get(name);
        of_strategy.or_else(|| self.record.parameters.get(name))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::example;
    use crate::report::derived::totals::tests::record_of;

    #[test]
    fn a_strategy_is_as_often_there_as_it_was_made() {
        let mut record = record_of(example());
        let member = |family: &str, name: &str, value: i64| FamilyMember {
            family: family.to_owned(),
            parameters: BTreeMap::from([(name.to_owned(), Parameter::Whole(value))]),
        };
        record.families[0] = vec![
            member("grid:{cells}+vds:1024", "cells", 256),
            member("grid:256+vds:{texels}", "texels", 1024),
        ];
        assert_eq!(rows(&record).len(), 2);
        let all = rows_by_family(&record);
        let found: Vec<_> = all.iter().map(|r| r.parameter("texels")).collect();
        assert_eq!(found, [None, Some(&Parameter::Whole(1024)), None]);
    }
}
