//! `[[run]]` with a `scene`: words of the command line with placeholders, and the values that take their place.

use std::collections::BTreeMap;

use super::Asked;
use super::claims::{self, Claim};
use crate::Result;
use crate::experiment::Parameters;
use crate::experiment::drift::Drift;
use crate::experiment::sweep::{Axes, Axis, Point, Templates, Value, expand};
use crate::scene::reader::{Entry, Table};

const RUN_KEYS: &[&str] = &[
    "name",
    "about",
    "input",
    "moves",
    "scene",
    "truth",
    "resolution",
    "strategies",
    "rounds",
    "pictures",
    "drift",
    "sweep",
    "quick",
    "expect",
];

const QUICK_KEYS: &[&str] = &["resolution", "rounds", "strategies", "sweep", "drift"];

/// Rounds where nobody says how many.
const USUAL_ROUNDS: usize = 9;

/// Most rounds, as of `cutaway compare`.
const MOST_ROUNDS: usize = 10_000;

/// Strategies on the points of a sweep.
#[derive(Clone, Debug)]
pub struct SceneRun {
    /// The points, in the order of the values; the first axis by name varies slowest.
    pub points: Vec<Point>,
    /// Measured rounds, after one to warm up.
    pub rounds: usize,
    /// Of which points pictures are kept.
    pub pictures: Pictures,
    /// How the camera drifts, if it does.
    pub drift: Option<Drift>,
    /// What is expected.
    pub claims: Vec<Claim>,
    /// What is varied.
    pub axes: Axes,
}

/// Of which points of a run pictures are kept: `pictures = true`, `false`, `"all"`, `"last"`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pictures {
    /// Of none.
    None,
    /// Of the first.
    First,
    /// Of the last.
    Last,
    /// Of all.
    All,
}

impl Pictures {
    /// Whether those of the point with this index are, out of so many.
    pub fn are_kept(self, index: usize, points: usize) -> bool {
        match self {
            Self::None => false,
            Self::First => index == 0,
            Self::Last => index + 1 == points,
            Self::All => true,
        }
    }
}

/// What a run says, before it is expanded.
#[derive(Clone)]
struct Draft {
    templates: Templates,
    axes: Axes,
    rounds: usize,
    drift: Option<Drift>,
}

/// Reads a run, in full and quick.
pub(super) fn read(entry: &Entry<'_>) -> Result<(Asked, Asked)> {
    let table = entry.table(RUN_KEYS)?;
    let words = |key: &str| table.get(key).map(|e| some_texts(&e)).transpose();
    let mut draft = Draft {
        templates: Templates {
            scene: words("scene")?.unwrap_or_default(),
            truth: words("truth")?,
            resolution: text(&table, "resolution")?,
            strategies: some_texts(&table.need("strategies", "[\"all\"]")?)?,
        },
        axes: Axes::default(),
        rounds: rounds(&table)?.unwrap_or(USUAL_ROUNDS),
        drift: drift(&table)?,
    };
    if let Some(sweep) = table.get("sweep") {
        for (name, values) in sweep.open_table()?.all() {
            draft
                .axes
                .add(axis(name, &values, None)?)
                .map_err(|f| values.place(f))?;
        }
    }
    let kept = table.get("pictures");
    let kept = kept.map_or(Ok(Pictures::First), |e| pictures(&e))?;
    let mut full = draft.expanded(entry, kept)?;
    full.claims = claims::read(&table, &full)?;
    let mut quick = match table.get("quick") {
        Some(quick) => draft.quick(&quick)?.expanded(&quick, kept)?,
        None => full.clone(),
    };
    quick.claims.clone_from(&full.claims);
    Ok((Asked::Scenes(full), Asked::Scenes(quick)))
}

impl Draft {
    fn quick(&self, entry: &Entry<'_>) -> Result<Self> {
        let table = entry.table(QUICK_KEYS)?;
        let mut quick = self.clone();
        if let Some(resolution) = text(&table, "resolution")? {
            quick.templates.resolution = Some(resolution);
        }
        if let Some(strategies) = table.get("strategies") {
            quick.templates.strategies = some_texts(&strategies)?;
        }
        if let Some(sweep) = table.get("sweep") {
            let names: Vec<&str> = self.axes.names().collect();
            for (name, values) in sweep.table(&names)?.all() {
                quick
                    .axes
                    .replace(axis(name, &values, self.axes.get(name))?);
            }
        }
        quick.axes.forget_unused(&quick.templates, &self.templates);
        quick.rounds = rounds(&table)?.unwrap_or(quick.rounds);
        quick.drift = drift(&table)?.or(quick.drift);
        Ok(quick)
    }

    fn expanded(&self, entry: &Entry<'_>, pictures: Pictures) -> Result<SceneRun> {
        let points = expand(&self.axes, &self.templates).map_err(|f| entry.place(f))?;
        Ok(SceneRun {
            points,
            rounds: self.rounds,
            pictures,
            drift: self.drift,
            claims: Vec::new(),
            axes: self.axes.clone(),
        })
    }
}

fn text(table: &Table<'_>, key: &str) -> Result<Option<String>> {
    let entry = table.get(key);
    entry.map(|e| e.text().map(str::to_owned)).transpose()
}

/// Texts of a list that is not empty.
pub(super) fn some_texts(entry: &Entry<'_>) -> Result<Vec<String>> {
    let texts = entry.texts()?;
    if texts.is_empty() || texts.iter().any(|t| t.trim().is_empty()) {
        return Err(entry.fault("it is empty, or a text in it is", "write at least one word"));
    }
    Ok(texts)
}

fn pictures(entry: &Entry<'_>) -> Result<Pictures> {
    if entry.is_text() {
        return entry.choice(&[("all", Pictures::All), ("last", Pictures::Last)]);
    }
    let is_kept = entry.flag().map_err(|_| {
        let mend = "write true (of the first point), \"last\", \"all\", or false";
        entry.fault("it does not say of which points pictures are kept", mend)
    })?;
    Ok(if is_kept {
        Pictures::First
    } else {
        Pictures::None
    })
}

fn rounds(table: &Table<'_>) -> Result<Option<usize>> {
    let Some(entry) = table.get("rounds") else {
        return Ok(None);
    };
    let rounds: usize = entry.whole()?;
    if (1..=MOST_ROUNDS).contains(&rounds) {
        return Ok(Some(rounds));
    }
    let mend = format!("use 1 to {MOST_ROUNDS}");
    Err(entry.fault("so many rounds cannot be measured", mend))
}

fn drift(table: &Table<'_>) -> Result<Option<Drift>> {
    let Some(entry) = table.get("drift") else {
        return Ok(None);
    };
    let table = entry.table(&["frames", "px"])?;
    let frames = table.need("frames", "64")?;
    let px = table.need("px", "0.015625")?;
    let drift = Drift {
        frames: frames.whole()?,
        px: px.number()?,
    };
    if !(2..=4096).contains(&drift.frames) {
        return Err(frames.fault("nothing changes between so many frames", "use 2 to 4096"));
    }
    Ok(Some(drift))
}

/// Reads the values of an axis. Where the axis had tables, a text means the one that it is the `is` of.
fn axis(name: &str, entry: &Entry<'_>, full: Option<&Axis>) -> Result<Axis> {
    let values: Vec<Value> = (entry.list()?.iter())
        .map(|e| value(name, e, full))
        .collect::<Result<_>>()?;
    Axis::of(name, values).map_err(|f| entry.place(f))
}

fn value(axis: &str, entry: &Entry<'_>, full: Option<&Axis>) -> Result<Value> {
    if !entry.is_table() {
        let is = entry.word()?;
        let known = full.and_then(|a| a.values.iter().find(|v| v.is == is));
        return Ok(known.cloned().unwrap_or_else(|| Value {
            with: Parameters::from([(axis.to_owned(), is.clone())]),
            lists: BTreeMap::new(),
            is,
        }));
    }
    let table = entry.open_table()?;
    let is = table.need("is", "\"2 k\"")?.word()?;
    let mut with = Parameters::from([(axis.to_owned(), is.clone())]);
    let mut lists = BTreeMap::new();
    for (key, entry) in table.all().filter(|(key, _)| *key != "is") {
        let text = if entry.is_list() {
            let words: Vec<String> =
                (entry.list()?.iter().map(Entry::word)).collect::<Result<_>>()?;
            let text = words.join(" ");
            lists.insert(key.to_owned(), words);
            text
        } else {
            entry.word()?
        };
        if with.insert(key.to_owned(), text).is_some() {
            return Err(entry.fault("it is the name of the axis", "give it another name"));
        }
    }
    Ok(Value { is, with, lists })
}
