//! Comparison of expectations with measured results.

use std::collections::BTreeMap;

use super::definition::{Claim, SceneRun, Wanted};
use super::figures::figure;
use super::sweep::{Point, SweepAxis};
use super::{Bound, Ending, Expectation, Measurement, Reached, Record, StrategyMeasurement};

/// Checks a kept record against its run's current expectations. Returns true if any result differs from the recorded one.
pub fn judge_again(run: &SceneRun, point: &Point, record: &mut Record) -> bool {
    let found = Findings {
        measurement: &record.measurement,
        figures: &record.figures,
    };
    let expectations = reached(run, point, &found);
    let is_other = expectations != record.expectations;
    record.expectations = expectations;
    is_other
}

/// Measurements at a point, to be compared with its expectations.
pub struct Findings<'a> {
    /// The strategies, in the order of the point's trials.
    pub measurement: &'a Measurement,
    /// Figures that need more than one frame, by strategy in the same order.
    pub figures: &'a [BTreeMap<String, f64>],
}

/// Results of all of a run's expectations at a point, in the order in which the expectations are written.
pub fn reached(run: &SceneRun, point: &Point, found: &Findings<'_>) -> Vec<Reached> {
    let bits = found.measurement.adapter.sub_pixel_bits;
    // If the device's number of sub-pixel bits is unknown, every claim applies.
    let is_about =
        |c: &&Claim| (c.sub_pixel_bits.zip(bits)).is_none_or(|(least, has)| has >= least);
    run.claims
        .iter()
        .filter(is_about)
        .flat_map(|c| of_claim(run, point, c, found))
        .collect()
}

fn of_claim(run: &SceneRun, point: &Point, claim: &Claim, found: &Findings<'_>) -> Vec<Reached> {
    let names = || found.measurement.strategies.iter().map(|s| s.name.as_str());
    let is_meant = |i: &usize| {
        let trial = &point.trials[*i];
        let name = names().nth(*i).unwrap_or_default();
        claim.means(name, &point.parameters, trial)
    };
    let meant: Vec<usize> = (0..point.trials.len()).filter(is_meant).collect();
    let mut all = Vec::new();
    for index in &meant {
        let strategy = &found.measurement.strategies[*index];
        let ended = ending(claim, strategy);
        // If a frame's outcome is not the expected one, its figures are meaningless.
        let is_as_expected = ended.holds;
        if !is_as_expected || claim.outcome != Ending::Complete || claim.figures.is_empty() {
            all.push(ended);
        }
        if is_as_expected {
            all.extend(bounds(claim, *index, found));
        }
    }
    for (name, wanted) in &claim.figures {
        if let Wanted::FallsAlong(axis) = wanted {
            all.extend(falls(run, point, claim, &meant, (name, axis), found));
        }
    }
    all
}

fn expectation(claim: &Claim, what: String) -> Expectation {
    Expectation {
        what,
        why: claim.why.clone(),
    }
}

/// Checks the outcome of a frame.
fn ending(claim: &Claim, strategy: &StrategyMeasurement) -> Reached {
    let reason = strategy.reason.as_deref().unwrap_or_default();
    let says_so = claim
        .reason
        .as_ref()
        .is_none_or(|words| reason.contains(words));
    let mut what = claim.outcome.name().to_owned();
    if let Some(words) = &claim.reason {
        what.push_str(&format!(", because of `{words}`"));
    }
    let mut found = strategy.outcome.name().to_owned();
    if !reason.is_empty() {
        found.push_str(&format!(": {reason}"));
    }
    Reached {
        strategy: strategy.name.clone(),
        expected: expectation(claim, what),
        found,
        holds: strategy.outcome == claim.outcome && says_so,
    }
}

/// Checks the bounds on figures of a strategy.
fn bounds(claim: &Claim, index: usize, found: &Findings<'_>) -> Vec<Reached> {
    let of_figure = |(name, wanted): &(String, Wanted)| {
        let Wanted::Within(bound) = wanted else {
            return None;
        };
        let number = number(found, index, name);
        Some(Reached {
            strategy: found.measurement.strategies[index].name.clone(),
            expected: expectation(claim, format!("{name} {}", words(bound))),
            found: describe(name, number),
            holds: number.is_some_and(|n| bound.holds(n)),
        })
    };
    claim.figures.iter().filter_map(of_figure).collect()
}

fn number(found: &Findings<'_>, index: usize, name: &str) -> Option<f64> {
    let none = BTreeMap::new();
    let more = found.figures.get(index).unwrap_or(&none);
    figure(found.measurement, index, more, name)
}

fn describe(name: &str, number: Option<f64>) -> String {
    number.map_or_else(|| format!("no {name}"), |n| format!("{name} {n}"))
}

/// Bounds as text.
fn words(bound: &Bound) -> String {
    match (bound.least, bound.most) {
        (Some(least), Some(most)) if least >= most => format!("{least}"),
        (Some(least), Some(most)) => format!("{least} to {most}"),
        (Some(least), None) => format!("at least {least}"),
        (None, Some(most)) => format!("at most {most}"),
        (None, None) => "anything".to_owned(),
    }
}

/// Checks that a figure falls from each value of an axis to the next, all else being equal; gives one result for each step. A figure
/// that reaches 0 may stay there. A figure that is 0 at every value cannot fall, and shows nothing about the axis.
fn falls(
    run: &SceneRun,
    point: &Point,
    claim: &Claim,
    meant: &[usize],
    (name, axis): (&str, &str),
    found: &Findings<'_>,
) -> Vec<Reached> {
    let Some(axis) = run.axes.get(axis) else {
        return Vec::new();
    };
    let mut all = Vec::new();
    for chain in chains(point, axis, meant).values() {
        let at = |(_, i): &(usize, usize)| number(found, *i, name);
        let is_flat = chain.iter().all(|c| at(c).is_some_and(|n| n <= 0.0));
        for pair in chain.windows(2) {
            let [before, after] = [at(&pair[0]), at(&pair[1])];
            let falls = before
                .zip(after)
                .is_some_and(|(b, a)| a < b || (a <= 0.0 && b <= 0.0));
            let text = if is_flat {
                let axis = &axis.name;
                format!("{name} 0 at every value of {axis}, so it cannot fall")
            } else {
                format!("{}, then {}", describe(name, before), describe(name, after))
            };
            let [from, to] = [pair[0].0, pair[1].0].map(|v| &axis.values[v].is);
            let what = format!("{name} falls along {} from {from} to {to}", axis.name);
            all.push(Reached {
                strategy: found.measurement.strategies[pair[1].1].name.clone(),
                expected: expectation(claim, what),
                found: text,
                holds: falls && !is_flat,
            });
        }
    }
    all
}

/// The index of a strategy text, and the parameter values that it has on all axes but one.
type Chain = (usize, Vec<(String, String)>);

/// Groups of renderers that differ only in one axis. Each renderer comes with the index of its axis value, by which a group is sorted.
fn chains(
    point: &Point,
    axis: &SweepAxis,
    meant: &[usize],
) -> BTreeMap<Chain, Vec<(usize, usize)>> {
    let mut chains: BTreeMap<Chain, Vec<(usize, usize)>> = BTreeMap::new();
    for index in meant {
        for (template, member) in &point.trials[*index].families {
            let own = member.parameters.get(&axis.name);
            let Some(value) = axis.values.iter().position(|v| Some(&v.is) == own) else {
                continue;
            };
            let others = member
                .parameters
                .iter()
                .filter(|(key, _)| **key != axis.name);
            let others = others.map(|(key, value)| (key.clone(), value.to_string()));
            let chain = chains.entry((*template, others.collect())).or_default();
            chain.push((value, *index));
        }
    }
    chains.values_mut().for_each(|c| c.sort_unstable());
    chains
}
