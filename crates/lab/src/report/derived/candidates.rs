//! All methods requested at some points, with their costs at these points, exact methods first.

use super::totals::{names, self_standing};
use super::{Situation, Spread, StrategyTotals};
use crate::experiment::Record;

/// A method at some points.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Candidate {
    /// Numbers of points requested, drawn and exact, and the reasons for refusals.
    pub totals: StrategyTotals,
    /// Time in the requested situation divided by the time to draw the uncut scene; `None` if nothing was drawn.
    pub ratio: Option<Spread>,
}

/// The methods of some points: first the exact methods, then the wrong ones, then those that drew nothing, each group sorted by cost.
/// If any method is requested by name, methods that only come from sweeps over strategy parameters are left out.
pub(crate) fn candidates(records: &[&Record], situation: Situation) -> Vec<Candidate> {
    let named = match self_standing(records) {
        none if none.is_empty() => names(records),
        named => named,
    };
    let mut all: Vec<Candidate> = (named.into_iter())
        .map(|name| candidate(name, records, situation))
        .collect();
    let cost = |c: &Candidate| c.ratio.map_or(f64::INFINITY, |r| r.median);
    all.sort_by(|a, b| {
        (b.totals.is_exact().cmp(&a.totals.is_exact()))
            .then((a.totals.drawn == 0).cmp(&(b.totals.drawn == 0)))
            .then(cost(a).total_cmp(&cost(b)))
    });
    all
}

fn candidate(name: &str, records: &[&Record], situation: Situation) -> Candidate {
    let ratios = records.iter().filter_map(|record| {
        let mut found = record.measurement.strategies.iter();
        situation.ratio(record, found.find(|s| s.name == name)?)
    });
    Candidate {
        totals: StrategyTotals::of(name, records.iter().copied()),
        ratio: Spread::of(ratios.collect()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::example;
    use crate::report::derived::totals::tests::record_of;

    #[test]
    fn exact_ones_come_before_cheap_ones_and_refusals_last() {
        let mut measurement = example();
        let mut cheap = measurement.strategies[0].clone();
        cheap.name = "grid:256+vds:1024".to_owned();
        if let Some(c) = &mut cheap.comparison {
            c.decided_wrong_px = 9;
        }
        measurement.strategies.insert(0, cheap);
        let record = record_of(measurement);
        let all = candidates(&[&record], Situation::View);
        let found: Vec<&str> = all.iter().map(|c| c.totals.name.as_str()).collect();
        assert_eq!(
            found,
            ["raycast+mask", "grid:256+vds:1024", "planar+<mask>"]
        );
        assert!(all[0].ratio.is_some() && all[2].ratio.is_none());
    }
}
