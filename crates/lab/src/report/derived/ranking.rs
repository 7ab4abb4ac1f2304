//! Ranks the strategies at some points; all of a report's recommendations use this ranking.
//!
//! The ranking holds the strategies that `cutaway render` accepts and that are exact wherever they drew; refusals do not count against
//! them. At each point, the time of a strategy is divided by that of the point's fastest strategy. Strategies are sorted by the median of
//! these factors, so that strategies measured at different points can be compared; ties are sorted by the median ratio. Strategies that
//! were exact at half of the points or fewer come last, because only strategies exact at more than half are sure to share a point.
//!
//! Another strategy is a draw with the first unless the first is faster at more than half of the points where both are exact. Faster
//! means by more than the sum of both median absolute deviations, and by more than [`BETWEEN_RUNS`].

use super::totals::names;
use super::{Situation, Spread, StrategyTotals, Usage, usage};
use crate::experiment::{Record, Samples};

/// Relative difference seen between the ratios of two runs of the same experiments on one machine, although the deviation within each
/// run was only 5 %. Strategies that differ by less cannot be told apart.
pub(crate) const BETWEEN_RUNS: f64 = 0.12;

/// A strategy in the ranking.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Ranked {
    /// Its name in the records.
    pub name: String,
    /// Command line of the strategy.
    pub usage: Usage,
    /// Number of points where the strategy was exact.
    pub exact: usize,
    /// Time in the requested situation divided by the time to draw the uncut scene.
    pub ratio: Spread,
    /// True if the first strategy of the ranking is not faster than this one.
    pub is_draw: bool,
}

/// The ranking of the strategies at some points, the best first.
pub(crate) fn ranked(records: &[&Record], situation: Situation) -> Vec<Ranked> {
    let all = names(records).into_iter();
    let mut all: Vec<(Ranked, Ratios)> = all
        .filter_map(|name| entry(name, records, situation))
        .collect();
    let least: Vec<f64> = (0..records.len())
        .map(|point| {
            let ratios = all.iter().filter_map(|(_, r)| r[point].as_ref());
            ratios.map(|r| r.median).fold(f64::INFINITY, f64::min)
        })
        .collect();
    let is_rare = |s: &Ranked| 2 * s.exact <= records.len();
    all.sort_by(|(a, of_a), (b, of_b)| {
        (is_rare(a).cmp(&is_rare(b)))
            .then(factor(of_a, &least).total_cmp(&factor(of_b, &least)))
            .then(a.ratio.median.total_cmp(&b.ratio.median))
    });
    let (mut ranking, ratios): (Vec<Ranked>, Vec<Ratios>) = all.into_iter().unzip();
    for (place, of_it) in ratios.iter().enumerate().skip(1) {
        ranking[place].is_draw = !is_faster(&ratios[0], of_it);
    }
    ranking
}

/// Ratios of a strategy, one entry per point.
type Ratios = Vec<Option<Samples>>;

fn entry(name: &str, records: &[&Record], situation: Situation) -> Option<(Ranked, Ratios)> {
    let usage = usage(name)?;
    let totals = StrategyTotals::of(name, records.iter().copied());
    if !totals.is_exact() {
        return None;
    }
    let of_point = |record: &&Record| {
        let mut found = record.measurement.strategies.iter();
        situation.ratios(record, found.find(|s| s.name == name)?)
    };
    let ratios: Ratios = records.iter().map(of_point).collect();
    let medians = ratios.iter().flatten().map(|r| r.median).collect();
    let ranked = Ranked {
        name: totals.name,
        usage,
        exact: totals.exact,
        ratio: Spread::of(medians)?,
        is_draw: false,
    };
    Some((ranked, ratios))
}

/// Median, over the points, of a strategy's ratio divided by the smallest ratio at the same point.
fn factor(ratios: &Ratios, least: &[f64]) -> f64 {
    let pairs = ratios.iter().zip(least);
    let factors = pairs.filter_map(|(ratio, least)| Some(ratio.as_ref()?.median / least));
    Samples::new(factors.collect()).median
}

/// Returns true if one strategy is faster than another at more than half of the points where both have times.
fn is_faster(one: &Ratios, other: &Ratios) -> bool {
    let both = one.iter().zip(other);
    let both: Vec<(&Samples, &Samples)> = both
        .filter_map(|(a, b)| a.as_ref().zip(b.as_ref()))
        .collect();
    let apart = |(a, b): &&(&Samples, &Samples)| {
        b.median - a.median > (a.mad + b.mad).max(BETWEEN_RUNS * a.median)
    };
    2 * both.iter().filter(apart).count() > both.len()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::{PerClock, example};
    use crate::report::derived::totals::tests::record_of;

    /// Name of a strategy, its times on the clocks solid and frame, and its number of wrong pixels.
    type TimedStrategy<'a> = (&'a str, f64, f64, usize);

    const PEELED: TimedStrategy<'_> = ("raycast+vds:64", 50.0, 4.0, 0);
    const STEADY: TimedStrategy<'_> = ("raycast+mask", 0.0, 8.0, 0);
    const CHEAP: TimedStrategy<'_> = ("stencil", 0.0, 1.0, 0);

    fn record(strategies: &[TimedStrategy<'_>]) -> Record {
        let mut measurement = example();
        let one = measurement.strategies[0].clone();
        let named = strategies.iter().map(|(name, solid, frame, wrong)| {
            let mut found = one.clone();
            found.name = (*name).to_owned();
            found.time_ms = PerClock {
                solid: Samples::new(vec![*solid]),
                cut: Samples::default(),
                frame: Samples::new(vec![*frame]),
            };
            if let Some(c) = &mut found.comparison {
                c.decided_wrong_px = *wrong;
            }
            found
        });
        measurement.strategies = named.collect();
        record_of(measurement)
    }

    fn ranked_names(records: &[&Record], situation: Situation) -> Vec<String> {
        let ranking = ranked(records, situation);
        ranking.into_iter().map(|s| s.name).collect()
    }

    #[test]
    fn the_cheapest_that_is_never_wrong_is_first() {
        let a = record(&[PEELED, STEADY, CHEAP]);
        let b = record(&[PEELED, STEADY, ("stencil", 0.0, 1.0, 1)]);
        let c = record(&[("planar", 0.0, 1.0, 0), STEADY]);
        assert_eq!(
            ranked_names(&[&a], Situation::View)[0],
            "stencil",
            "the control"
        );
        assert_eq!(
            ranked_names(&[&a, &b, &c], Situation::View),
            ["raycast+vds:64", "raycast+mask", "planar"]
        );
        assert_eq!(
            ranked_names(&[&a, &b, &c], Situation::Mesh),
            ["raycast+mask", "raycast+vds:64", "planar"],
            "all clocks are paid"
        );
    }

    #[test]
    fn strategies_are_compared_where_both_were_asked() {
        let both =
            |stencil, mask| record(&[("stencil", 0.0, stencil, 0), ("raycast+mask", 0.0, mask, 0)]);
        let [cheap, dear] = [both(3.0, 2.0), both(12.0, 10.0)];
        let alone = record(&[("raycast+mask", 0.0, 20.0, 0)]);
        let records = [&cheap, &cheap, &dear, &dear, &alone, &alone, &alone];
        let ranking = ranked(&records, Situation::View);
        // The stencil has the smaller median only because it was not measured at the dearest points. Where it was measured, it is slower.
        let found: Vec<(&str, f64)> = (ranking.iter())
            .map(|s| (s.name.as_str(), s.ratio.median))
            .collect();
        assert_eq!(found, [("raycast+mask", 5.0), ("stencil", 3.75)]);
        assert!(!ranking[1].is_draw);
    }

    #[test]
    fn what_render_refuses_is_not_ranked() {
        let all = record(&[("winding", 0.0, 0.5, 0), CHEAP]);
        assert_eq!(ranked_names(&[&all], Situation::View), ["stencil"]);
    }

    #[test]
    fn neither_faster_at_most_points_is_a_draw() {
        let at = |a: f64, b: f64| record(&[("stencil", 0.0, a, 0), ("raycast+mask", 0.0, b, 0)]);
        let [won, lost, near] = [at(10.0, 20.0), at(20.0, 10.0), at(10.0, 11.0)];
        let is_draw = |records: &[&Record]| ranked(records, Situation::View)[1].is_draw;
        assert!(!is_draw(&[&won, &won, &lost]), "the control");
        assert!(is_draw(&[&won, &lost]), "one point each");
        assert!(is_draw(&[&won, &near]), "half is not most");
        assert!(is_draw(&[&near]), "within what runs differ by");
        // A median of 20 that scatters by 11 to either side cannot be distinguished from 10.
        let mut noisy = won.clone();
        noisy.measurement.draw_only_ms = Samples::new(vec![2.0; 3]);
        for (found, frame) in
            (noisy.measurement.strategies.iter_mut()).zip([[10.0, 10.0, 10.0], [9.0, 20.0, 31.0]])
        {
            found.time_ms.frame = Samples::new(frame.into());
        }
        assert!(is_draw(&[&noisy]), "within the spread of the rounds");
    }
}
