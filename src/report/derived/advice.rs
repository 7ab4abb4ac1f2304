//! What to use for one kind of input, over all points that stand for it.
//!
//! Whoever was wrong or overflowed anywhere is out, whatever it costs; a refusal is told and forgiven, for it is no picture. Of the others
//! the cheapest is advised. One that was exact at fewer than half of the points comes last: cheap there says little.

use super::{Situation, Spread, Standing};
use crate::experiment::{Record, StrategyMeasurement};

/// A strategy that may be used.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Advised {
    /// Its name.
    pub name: String,
    /// Points where it was exact.
    pub exact: usize,
    /// Time over drawing the uncut scene, in the situation that was asked about.
    pub ratio: Spread,
}

/// Strategies that are exact wherever they drew, the first to be used first.
pub(crate) fn advised(records: &[&Record], situation: Situation) -> Vec<Advised> {
    let mut names: Vec<&str> = Vec::new();
    for found in records.iter().flat_map(|r| &r.measurement.strategies) {
        if !names.contains(&found.name.as_str()) {
            names.push(&found.name);
        }
    }
    let mut all: Vec<Advised> = Vec::new();
    for name in names {
        let is_it = |found: &&StrategyMeasurement| found.name == name;
        let standing = Standing::of(name, records.iter().copied());
        let ratios = records.iter().filter_map(|record| {
            let found = record.measurement.strategies.iter().find(is_it)?;
            situation.ratio(record, found)
        });
        if let (true, Some(ratio)) = (standing.is_exact(), Spread::of(ratios.collect())) {
            all.push(Advised {
                name: standing.name,
                exact: standing.exact,
                ratio,
            });
        }
    }
    all.sort_by(|a, b| {
        let is_rare = |s: &Advised| 2 * s.exact < records.len();
        (is_rare(a).cmp(&is_rare(b))).then(a.ratio.median.total_cmp(&b.ratio.median))
    });
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::{PerClock, Samples, example};
    use crate::report::derived::standing::tests::record_of;

    /// A point; each strategy with its times on solid and frame, and its wrong pixels.
    fn record(strategies: &[(&str, f64, f64, usize)]) -> Record {
        let mut measurement = example();
        let one = measurement.strategies[0].clone();
        let named = strategies.iter().map(|(name, solid, frame, wrong)| {
            let mut found = one.clone();
            found.name = (*name).to_owned();
            found.time_ms = PerClock {
                solid: Samples::of(vec![*solid]),
                cut: Samples::default(),
                frame: Samples::of(vec![*frame]),
            };
            if let Some(c) = &mut found.comparison {
                c.decided_wrong_px = *wrong;
            }
            found
        });
        measurement.strategies = named.collect();
        record_of(measurement)
    }

    #[test]
    fn the_cheapest_that_is_never_wrong_is_advised() {
        let often = [
            ("peeled", 50.0, 4.0, 0),
            ("steady", 0.0, 8.0, 0),
            ("cheap", 0.0, 1.0, 0),
        ];
        let wrong_once = [
            ("peeled", 50.0, 4.0, 0),
            ("steady", 0.0, 8.0, 0),
            ("cheap", 0.0, 1.0, 1),
        ];
        let rare = [("rare", 0.0, 1.0, 0), ("steady", 0.0, 8.0, 0)];
        let [a, b, c] = [record(&often), record(&wrong_once), record(&rare)];
        let names = |records: &[&Record], situation| -> Vec<String> {
            advised(records, situation)
                .into_iter()
                .map(|s| s.name)
                .collect()
        };
        assert_eq!(names(&[&a], Situation::View)[0], "cheap", "the control");
        assert_eq!(
            names(&[&a, &b, &c], Situation::View),
            ["peeled", "steady", "rare"]
        );
        assert_eq!(
            names(&[&a, &b, &c], Situation::Mesh),
            ["steady", "peeled", "rare"],
            "all clocks are paid"
        );
    }
}
