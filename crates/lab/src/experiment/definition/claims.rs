//! Parser of `[[run.expect]]`: the expected results of strategies.
//!
//! An expectation concerns errors, never times: a time on one machine predicts nothing about another machine, so times belong in reports.
//! An expectation that declares a failure or a bound must give a reason.

use std::collections::{BTreeMap, BTreeSet};

use cutaway::Result;
use cutaway::error::did_you_mean;
use cutaway::scene::glob_matches;
use cutaway_io::document::reader::{Entry, Table};

use super::scenes::{SceneRun, some_texts};
use crate::experiment::figures::{OF_DRIFT, OF_PICTURES, OF_SIZE, OF_TIME, of_error};
use crate::experiment::sweep::{Point, Trial};
use crate::experiment::{Bound, Ending, Parameter, Parameters};

/// Keys of an expectation that are not names of figures.
const BESIDE_FIGURES: [&str; 6] = [
    "strategies",
    "where",
    "why",
    "outcome",
    "reason",
    "sub_pixel_bits",
];

/// Expected results of strategies.
#[derive(Clone, Debug, PartialEq)]
pub struct Claim {
    /// Globs that match the names of the renderers concerned.
    pub strategies: Vec<String>,
    /// Parameter values that the point or the renderer must have for the claim to apply.
    pub conditions: Parameters,
    /// Minimum number of sub-pixel bits that a rasteriser must have for the claim to apply; with `None`, it applies to every adapter.
    pub sub_pixel_bits: Option<u32>,
    /// Why the result cannot be better.
    pub why: Option<String>,
    /// Expected outcome of the frame.
    pub outcome: Ending,
    /// Words that the reason must contain if the frame is not complete.
    pub reason: Option<String>,
    /// Expected figures.
    pub figures: Vec<(String, Wanted)>,
}

/// Expected value of a figure.
#[derive(Clone, Debug, PartialEq)]
pub enum Wanted {
    /// A number, or a range.
    Within(Bound),
    /// From each value of this strategy axis to the next, the figure becomes strictly smaller, or is 0 at both.
    FallsAlong(String),
}

impl Claim {
    /// Returns true if the claim applies to a renderer at a point, given the renderer's name and the sweep values of both.
    pub fn means(&self, name: &str, of_point: &Parameters, trial: &Trial) -> bool {
        let is_made_so = |own: &Parameters| {
            let has = |(key, value): (&String, &Parameter)| {
                [own, of_point].iter().any(|p| p.get(key) == Some(value))
            };
            self.conditions.iter().all(has)
        };
        self.strategies.iter().any(|g| glob_matches(g, name)) && trial.is_made_by(is_made_so)
    }
}

/// Reads the expectations of a run.
pub(super) fn read(table: &Table<'_>, run: &SceneRun) -> Result<Vec<Claim>> {
    let entries = table.tables("expect")?;
    entries.iter().map(|e| claim(e, run)).collect()
}

fn claim(entry: &Entry<'_>, run: &SceneRun) -> Result<Claim> {
    for (key, stray) in entry.open_table()?.all() {
        if OF_TIME.contains(&key) || key.starts_with("time") || key.contains("draw_only") {
            let help = "leave it out, and draw it in a [[chart]]: times differ between machines";
            return Err(stray.fault("expectations cannot be about time", help));
        }
    }
    let mut names = of_error();
    names.extend(
        OF_SIZE
            .iter()
            .filter(|n| n.starts_with("bytes"))
            .map(|n| (*n).to_owned()),
    );
    if run.drift.is_some() {
        names.extend(OF_DRIFT.map(str::to_owned));
        names.extend(OF_PICTURES.map(str::to_owned));
    }
    let known: Vec<&str> = BESIDE_FIGURES
        .into_iter()
        .chain(names.iter().map(String::as_str))
        .collect();
    let table = entry.table(&known)?;
    let text = |key: &str| {
        table
            .get(key)
            .map(|e| e.text().map(str::to_owned))
            .transpose()
    };
    let outcome = table.get("outcome").map(|e| {
        e.choice(&[
            ("complete", Ending::Complete),
            ("refused", Ending::Refused),
            ("overflowed", Ending::Overflowed),
        ])
    });
    let mut claim = Claim {
        strategies: some_texts(&table.need("strategies", "[\"raycast+*\"]")?)?,
        conditions: conditions(&table, run)?,
        sub_pixel_bits: sub_pixel_bits(&table)?,
        why: text("why")?,
        outcome: outcome.transpose()?.unwrap_or(Ending::Complete),
        reason: text("reason")?,
        figures: Vec::new(),
    };
    let mut is_declared = claim.outcome != Ending::Complete;
    for name in &names {
        if let Some(entry) = table.get(name) {
            let wanted = wanted(&entry, run)?;
            // A bound of at most 0 means exactly 0, so it does not declare a failure.
            is_declared |= entry.is_table()
                && matches!(&wanted, Wanted::Within(b) if b.most.is_none_or(|most| most > 0.0));
            claim.figures.push((name.clone(), wanted));
        }
    }
    check(&table, &claim, is_declared)?;
    must_mean_somebody(&table, &claim, run)?;
    Ok(claim)
}

fn check(table: &Table<'_>, claim: &Claim, is_declared: bool) -> Result<()> {
    let fault = |what: &str, help: &str| Err(table.entry.fault(what, help));
    if claim.figures.is_empty() && table.get("outcome").is_none() {
        return fault(
            "nothing is expected",
            "add for example `decided_wrong_px = 0`",
        );
    }
    if claim.outcome == Ending::Refused && !claim.figures.is_empty() {
        return fault("a refused frame has no figures", "expect one or the other");
    }
    if claim.outcome == Ending::Complete && claim.reason.is_some() {
        let help = "leave `reason` out, or expect `outcome = \"refused\"`";
        return fault("a complete frame has no reason", help);
    }
    if is_declared && claim.why.is_none() {
        let help = "add `why = \"...\"`: what keeps it from being exact";
        return fault(
            "it declares a failure or a bound, but does not say why",
            help,
        );
    }
    Ok(())
}

fn sub_pixel_bits(table: &Table<'_>) -> Result<Option<u32>> {
    let Some(entry) = table.get("sub_pixel_bits") else {
        return Ok(None);
    };
    let bits = entry.whole()?;
    match (4..=8).contains(&bits) {
        true => Ok(Some(bits)),
        false => Err(entry.fault("adapters have 4 to 8", "write 8, or leave it out")),
    }
}

fn conditions(table: &Table<'_>, run: &SceneRun) -> Result<Parameters> {
    let mut conditions = Parameters::new();
    let Some(entry) = table.get("where") else {
        return Ok(conditions);
    };
    let known: Vec<&str> = run.axes.names().collect();
    for (key, value) in entry.table(&known)?.all() {
        let is = Parameter::of(&value.node.value);
        let axis = run.axes.get(key).into_iter();
        let held = axis
            .flat_map(|a| &a.values)
            .find(|v| Some(&v.is) == is.as_ref());
        let Some(held) = held else {
            let asked = is.map_or_else(String::new, |is| is.to_string());
            let help = "use a value that is listed in [run.sweep], in the same spelling";
            return Err(value.fault(format_args!("its value is never `{asked}`"), help));
        };
        conditions.insert(key.to_owned(), held.is.clone());
    }
    Ok(conditions)
}

fn wanted(entry: &Entry<'_>, run: &SceneRun) -> Result<Wanted> {
    if !entry.is_table() {
        let number = entry.number()?;
        return Ok(Wanted::Within(Bound {
            least: Some(number),
            most: Some(number),
        }));
    }
    let table = entry.table(&["least", "most", "falls_along"])?;
    let number = |key: &str| table.get(key).map(|e| e.number()).transpose();
    let bound = Bound {
        least: number("least")?,
        most: number("most")?,
    };
    let Some(along) = table.get("falls_along") else {
        return match (bound.least, bound.most) {
            (None, None) => Err(entry.fault("nothing is expected", "write `{ most = 30 }`")),
            (Some(least), Some(most)) if least > most => Err(entry.fault(
                "no number lies in this range",
                "make `least` no greater than `most`",
            )),
            _ => Ok(Wanted::Within(bound)),
        };
    };
    if bound != Bound::default() {
        let help = "write two [[run.expect]]";
        return Err(entry.fault("`falls_along` excludes `least` and `most`", help));
    }
    let axis = along.text()?;
    let points = run.points.first();
    let mut of_strategies = points.iter().flat_map(|p| &p.trials);
    if !of_strategies.any(|e| e.is_made_by(|p| p.contains_key(axis)))
        || run.axes.get(axis).is_none()
    {
        let of_strategies = |name: &&str| {
            let mut trials = run.points.iter().flat_map(|p| &p.trials);
            trials.any(|e| e.is_made_by(|p| p.contains_key(*name)))
        };
        let known: Vec<&str> = run.axes.names().filter(of_strategies).collect();
        let help = if known.is_empty() {
            "vary a parameter of the strategies, as in \"grid:{cells}+mask\"".to_owned()
        } else {
            did_you_mean(axis, known)
        };
        let what = format!("`{axis}` is not an axis of the strategies");
        return Err(along.fault(what, help));
    }
    Ok(Wanted::FallsAlong(axis.to_owned()))
}

/// Returns true if, among the renderers that a claim applies to, two come from one strategy text with different values of the axis.
fn has_a_step(point: &Point, claim: &Claim, axis: &str) -> bool {
    let meant = (point.trials.iter())
        .filter(|e| claim.means(&e.renderer.to_string(), &point.parameters, e));
    let mut seen: BTreeMap<usize, &Parameter> = BTreeMap::new();
    for (template, member) in meant.flat_map(|e| &e.families) {
        if let Some(value) = member.parameters.get(axis)
            && *seen.entry(*template).or_insert(value) != value
        {
            return true;
        }
    }
    false
}

/// Fails if an expectation applies to no renderer, as it could then never be missed.
fn must_mean_somebody(table: &Table<'_>, claim: &Claim, run: &SceneRun) -> Result<()> {
    let strategies = table.need("strategies", "[\"*\"]")?;
    let names: BTreeSet<String> = (run.points.iter().flat_map(|p| &p.trials))
        .map(|e| e.renderer.to_string())
        .collect();
    for glob in &claim.strategies {
        if !names.iter().any(|n| glob_matches(glob, n)) {
            let help = did_you_mean(glob, names.iter().map(String::as_str));
            return Err(strategies.fault(format_args!("no strategy matches `{glob}`"), help));
        }
    }
    let is_meant = run.points.iter().any(|p| {
        let mut trials = p.trials.iter();
        trials.any(|e| claim.means(&e.renderer.to_string(), &p.parameters, e))
    });
    let along = claim.figures.iter().filter_map(|(_, wanted)| match wanted {
        Wanted::FallsAlong(axis) => Some(axis),
        Wanted::Within(_) => None,
    });
    for axis in along {
        if !run.points.iter().any(|p| has_a_step(p, claim, axis)) {
            let what =
                format!("no strategy has two values of `{axis}`, so no figure can fall along it");
            let help = "give the axis two values, or expect `{ most = .. }`";
            return Err(table.entry.fault(what, help));
        }
    }
    if is_meant {
        return Ok(());
    }
    let help = "change `where` or `strategies` so that they match a renderer at some point";
    Err(table
        .entry
        .fault("it matches no renderer at any point", help))
}
