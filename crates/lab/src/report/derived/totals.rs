//! Totals of strategies over many points: counts of exact and refused points, and costs.

use std::collections::BTreeMap;

use super::is_exact;
use crate::experiment::{Ending, Record, Samples, StrategyMeasurement};

/// Minimum, median and maximum of some numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Spread {
    pub least: f64,
    pub median: f64,
    /// Maximum.
    pub most: f64,
}

impl Spread {
    /// Spread of some numbers; `None` if there are none.
    pub(crate) fn of(numbers: Vec<f64>) -> Option<Self> {
        let first = *numbers.first()?;
        let least = numbers.iter().copied().fold(first, f64::min);
        let most = numbers.iter().copied().fold(first, f64::max);
        Some(Self {
            least,
            median: Samples::new(numbers).median,
            most,
        })
    }
}

/// A strategy over some points.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct StrategyTotals {
    pub name: String,
    /// Number of points that the strategy was requested to draw.
    pub asked: usize,
    /// Number of points that it drew, with or without overflow.
    pub drawn: usize,
    /// Number of points that it drew completely and without a decided wrong pixel.
    pub exact: usize,
    /// Number of points where a bounded buffer was too small.
    pub overflowed: usize,
    /// Reasons for its refusals, each with its number of occurrences.
    pub refusals: BTreeMap<String, usize>,
    /// Maximum number of decided wrong pixels at a point.
    pub worst_px: usize,
    /// Frame time divided by the time to draw the uncut scene.
    pub ratio: Option<Spread>,
}

impl StrategyTotals {
    /// Totals of a strategy over the points that request it.
    pub(crate) fn of<'a>(name: &str, records: impl IntoIterator<Item = &'a Record>) -> Self {
        let all = records.into_iter().flat_map(|r| &r.measurement.strategies);
        Self::over(name, all.filter(|found| found.name == name))
    }

    /// Totals of several strategies together, each counted at the points that request it.
    pub(crate) fn over<'a>(
        name: &str,
        all: impl IntoIterator<Item = &'a StrategyMeasurement>,
    ) -> Self {
        let mut totals = Self {
            name: name.to_owned(),
            ..Self::default()
        };
        let mut ratios = Vec::new();
        for found in all {
            totals.count(found);
            ratios.extend(found.frame_over_draw_only);
        }
        totals.ratio = Spread::of(ratios);
        totals
    }

    fn count(&mut self, found: &StrategyMeasurement) {
        self.asked += 1;
        self.exact += usize::from(is_exact(found));
        self.overflowed += usize::from(found.outcome == Ending::Overflowed);
        match &found.comparison {
            Some(comparison) => {
                self.drawn += 1;
                self.worst_px = self.worst_px.max(comparison.decided_wrong_px);
            }
            None => {
                let reason = found.reason.clone().unwrap_or_default();
                *self.refusals.entry(reason).or_default() += 1;
            }
        }
    }

    /// Number of points that it refused.
    pub(crate) fn refused(&self) -> usize {
        self.asked - self.drawn
    }

    /// Returns true if it was exact wherever it drew.
    pub(crate) fn is_exact(&self) -> bool {
        self.drawn > 0 && self.exact == self.drawn
    }
}

/// Distinct names of all strategies of some points.
pub(super) fn names<'a>(records: &[&'a Record]) -> Vec<&'a str> {
    let mut names: Vec<&str> = Vec::new();
    for found in records.iter().flat_map(|r| &r.measurement.strategies) {
        if !names.contains(&found.name.as_str()) {
            names.push(&found.name);
        }
    }
    names
}

/// Names of self-standing strategies: those that at least one point requests by name rather than by a sweep over their
/// parameters.
pub(super) fn self_standing<'a>(records: &[&'a Record]) -> Vec<&'a str> {
    let mut names: Vec<&str> = Vec::new();
    for record in records {
        for (found, swept) in record.measurement.strategies.iter().zip(&record.families) {
            if swept.iter().any(|m| m.parameters.is_empty())
                && !names.contains(&found.name.as_str())
            {
                names.push(&found.name);
            }
        }
    }
    names
}

/// Totals of the self-standing strategies. Exact strategies come first, then the rest by how wrong they are; ties are sorted by cost.
/// Strategies that never drew come last.
pub(crate) fn totals_of_strategies(records: &[&Record]) -> Vec<StrategyTotals> {
    let mut found: Vec<StrategyTotals> = self_standing(records)
        .iter()
        .map(|name| StrategyTotals::of(name, records.iter().copied()))
        .collect();
    let cost = |s: &StrategyTotals| s.ratio.map_or(f64::INFINITY, |r| r.median);
    found.sort_by(|a, b| {
        (b.is_exact().cmp(&a.is_exact()))
            .then((a.drawn == 0).cmp(&(b.drawn == 0)))
            .then(a.worst_px.cmp(&b.worst_px))
            .then(cost(a).total_cmp(&cost(b)))
    });
    found
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::experiment::{FamilyMember, Measurement, Parameter, example};
    use cutaway_io::document::Document;

    pub(crate) fn record_of(measurement: Measurement) -> Record {
        let count = measurement.strategies.len();
        Record {
            format: Record::FORMAT,
            experiment: "01-example".to_owned(),
            run: "crank".to_owned(),
            parameters: BTreeMap::new(),
            is_quick: false,
            identity: String::new(),
            scene: Document::new(),
            truth: None,
            measurement,
            families: vec![vec![FamilyMember::default()]; count],
            figures: vec![BTreeMap::new(); count],
            expectations: Vec::new(),
            warnings: Vec::new(),
            pictures: Vec::new(),
            invocation: None,
        }
    }

    #[test]
    fn standings_count_points() {
        let exact = record_of(example());
        let mut wrong = record_of(example());
        if let Some(c) = &mut wrong.measurement.strategies[0].comparison {
            c.decided_wrong_px = 7;
        }
        wrong.measurement.strategies[0].frame_over_draw_only = Some(2.5);
        let found = totals_of_strategies(&[&exact, &wrong, &wrong]);
        let names: Vec<&str> = found.iter().map(|s| s.name.as_str()).collect();
        assert_eq!(names, ["raycast+mask", "planar+<mask>"]);
        let drawn = &found[0];
        assert_eq!(
            (drawn.asked, drawn.drawn, drawn.exact, drawn.worst_px),
            (3, 3, 1, 7)
        );
        assert!(!drawn.is_exact(), "two of three are wrong");
        let ratio = drawn.ratio.unwrap();
        assert_eq!([ratio.least, ratio.median, ratio.most], [1.5, 2.5, 2.5]);
        assert_eq!((found[1].refused(), found[1].refusals.len()), (3, 1));
    }

    #[test]
    fn strategies_of_sweeps_do_not_stand_for_themselves() {
        let mut record = record_of(example());
        let own = &mut record.families[0][0].parameters;
        own.insert("cells".to_owned(), Parameter::Whole(64));
        let names: Vec<String> = totals_of_strategies(&[&record])
            .into_iter()
            .map(|s| s.name)
            .collect();
        assert_eq!(names, ["planar+<mask>"]);
    }
}
