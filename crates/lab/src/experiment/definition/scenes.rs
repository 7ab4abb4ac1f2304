//! Parser of a `[[run]]` with a `scene`: the scene document and the sweep axes.

use std::path::Path;

use cutaway::Result;
use cutaway_io::document::Document;
use cutaway_io::document::paths;
use cutaway_io::document::reader::{Entry, Table};

use super::Asked;
use super::claims::{self, Claim};
use super::drift::drift;
use crate::experiment::Parameter;
use crate::experiment::drift::Drift;
use crate::experiment::sweep::{Axes, Changes, Point, SweepAxis, SweepValue, Variable, expand};

const RUN_KEYS: &[&str] = &[
    "name",
    "about",
    "input",
    "moves",
    "scene",
    "set",
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

const QUICK_KEYS: &[&str] = &[
    "set",
    "resolution",
    "rounds",
    "strategies",
    "sweep",
    "drift",
];

/// Default number of rounds.
const USUAL_ROUNDS: usize = 9;

/// Maximum number of rounds, as for `cutaway compare`.
const MOST_ROUNDS: usize = 10_000;

/// Strategies to measure on the points of a sweep.
#[derive(Clone, Debug)]
pub struct SceneRun {
    /// The points, in the order of their axis values; the alphabetically first axis varies slowest.
    pub points: Vec<Point>,
    /// Number of measured rounds, without the warm-up round.
    pub rounds: usize,
    /// The points whose pictures are kept.
    pub pictures: Pictures,
    /// Drift of the camera, if any.
    pub drift: Option<Drift>,
    /// The expectations.
    pub claims: Vec<Claim>,
    /// The sweep axes.
    pub axes: Axes,
}

/// Points of a run whose pictures are kept: `pictures = true`, `false`, `"all"`, `"last"`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pictures {
    /// No point.
    None,
    /// The first point.
    First,
    /// The last point.
    Last,
    /// All points.
    All,
}

impl Pictures {
    /// Returns true if the pictures of the point with this index are kept; `points` is the number of points.
    pub fn are_kept(self, index: usize, points: usize) -> bool {
        match self {
            Self::None => false,
            Self::First => index == 0,
            Self::Last => index + 1 == points,
            Self::All => true,
        }
    }
}

/// A run as the file defines it, before it is expanded into points.
#[derive(Clone)]
struct RunDraft {
    variable: Variable,
    axes: Axes,
    rounds: usize,
    drift: Option<Drift>,
}

/// Reads a run: the full task, and that of `--quick`. File names are relative to the folder of `path`, the experiment's file.
pub(super) fn read(entry: &Entry<'_>, path: &Path) -> Result<(Asked, Asked)> {
    let table = entry.table(RUN_KEYS)?;
    let scene = scene(&table, path)?;
    // If a change that the experiment makes to a scene file is wrong, the error must name the experiment's file, not the scene file.
    let node;
    let (entry, table) = if scene.path() == path {
        (entry.clone(), table)
    } else {
        node = entry.node.clone().of_file(&path.into());
        let entry = entry.of(&node);
        let table = entry.table(RUN_KEYS)?;
        (entry, table)
    };
    let entry = &entry;
    let mut draft = RunDraft {
        variable: Variable {
            scene,
            truth: table.get("truth").map(|t| changes(&t)).transpose()?,
            strategies: some_texts(&table.need("strategies", "[\"all\"]")?)?,
        },
        axes: Axes::default(),
        rounds: rounds(&table)?.unwrap_or(USUAL_ROUNDS),
        drift: drift(&table)?,
    };
    draft.set(&table)?;
    if let Some(sweep) = table.get("sweep") {
        for (name, values) in sweep.open_table()?.all() {
            let axis = axis(name, &values, &draft)?;
            draft.axes.0.push(axis);
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

impl RunDraft {
    /// Applies the keys of a run that change the scene, other than `scene` itself.
    fn set(&mut self, table: &Table<'_>) -> Result<()> {
        let scene = &mut self.variable.scene;
        if let Some(size) = table.get("resolution") {
            scene.set_node("resolution", size.node.clone())?;
        }
        if let Some(set) = table.get("set") {
            *scene = scene
                .with_changes(&changes(&set)?)
                .map_err(|e| set.place(e))?;
        }
        Ok(())
    }

    fn quick(&self, entry: &Entry<'_>) -> Result<Self> {
        let table = entry.table(QUICK_KEYS)?;
        let mut quick = self.clone();
        quick.set(&table)?;
        if let Some(strategies) = table.get("strategies") {
            quick.variable.strategies = some_texts(&strategies)?;
        }
        if let Some(sweep) = table.get("sweep") {
            let names: Vec<&str> = self.axes.names().collect();
            for (name, values) in sweep.table(&names)?.all() {
                quick.axes.replace(fewer(name, &values, self)?);
            }
        }
        // `--quick` has one size, even if the full task has several.
        if table.get("resolution").is_some() {
            let is_of_more = |a: &SweepAxis| {
                let mut sets = a.values.iter().flat_map(|v| &v.sets);
                a.is_of_strategies() || sets.any(|(path, _)| path != "resolution")
            };
            quick.axes.0.retain(is_of_more);
            let values = quick.axes.0.iter_mut().flat_map(|a| &mut a.values);
            values.for_each(|v| v.sets.retain(|(path, _)| path != "resolution"));
        }
        quick.axes.forget_unused(&quick.variable.strategies);
        quick.rounds = rounds(&table)?.unwrap_or(quick.rounds);
        quick.drift = drift(&table)?.or(quick.drift);
        Ok(quick)
    }

    fn expanded(&self, entry: &Entry<'_>, pictures: Pictures) -> Result<SceneRun> {
        let points = expand(&self.axes, &self.variable).map_err(|f| entry.place(f))?;
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

/// The scene of a run: a table, or the name of a scene file.
fn scene(table: &Table<'_>, path: &Path) -> Result<Document> {
    let entry = table.need("scene", "{ part = [{ shape = \"crank\" }] }")?;
    if entry.is_table() {
        return Document::of_node(path, entry.node.clone());
    }
    let folder = path.parent().unwrap_or_else(|| Path::new(""));
    let file = folder.join(entry.text()?);
    if !file.is_file() {
        let what = format!("there is no file {}", file.display());
        let help = "check the name, which is relative to the experiment, or write the scene as a table: [run.scene]";
        return Err(entry.fault(what, help).missing());
    }
    Document::read(&file)
}

/// Reads values to set in a document, each with its path.
fn changes(entry: &Entry<'_>) -> Result<Changes> {
    let table = entry.open_table()?;
    let all = table.all();
    Ok(all
        .map(|(path, e)| (path.to_owned(), e.node.clone()))
        .collect())
}

/// Reads a non-empty list of texts.
pub(super) fn some_texts(entry: &Entry<'_>) -> Result<Vec<String>> {
    let texts = entry.texts()?;
    if texts.is_empty() || texts.iter().any(|t| t.trim().is_empty()) {
        return Err(entry.fault(
            "it is empty or contains an empty text",
            "write at least one word",
        ));
    }
    Ok(texts)
}

fn pictures(entry: &Entry<'_>) -> Result<Pictures> {
    if entry.is_text() {
        return entry.choice(&[("all", Pictures::All), ("last", Pictures::Last)]);
    }
    let is_kept = entry.flag().map_err(|_| {
        let help = "write true (for the first point), \"last\", \"all\", or false";
        entry.fault(
            "it does not select the points whose pictures are kept",
            help,
        )
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
    let help = format!("use 1 to {MOST_ROUNDS}");
    Err(entry.fault("this number of rounds cannot be measured", help))
}

/// Reads an axis. Its name is the path at which its values are set, or a placeholder in braces in a strategy. It can be any name if the
/// paths are given with the values: `{ path = "..", values = [..] }`, or a table for each value.
fn axis(name: &str, entry: &Entry<'_>, draft: &RunDraft) -> Result<SweepAxis> {
    if entry.is_table() {
        let table = entry.table(&["path", "values"])?;
        let path = table.need("path", "\"cut.front.surfaces.0.amplitude\"")?;
        let paths = match path.is_list() {
            true => some_texts(&path)?,
            false => vec![path.text()?.to_owned()],
        };
        let values = table.need("values", "[\"1%\", \"4%\"]")?;
        return of_paths(name, paths, &values, draft);
    }
    let braces = format!("{{{name}}}");
    let is_of_strategies = (draft.variable.strategies.iter()).any(|s| s.contains(&braces));
    if is_of_strategies {
        return of_strategies(name, entry);
    }
    if entry.list()?.iter().any(Entry::is_table) {
        let values = entry.list()?;
        let values = values.iter().map(|e| tabled(e, draft));
        let values = values.collect::<Result<_>>()?;
        return SweepAxis::of(name, Vec::new(), values).map_err(|f| entry.place(f));
    }
    let is_path = paths::find(name).is_some();
    if !name.contains('.') && !is_path && draft.variable.scene.root().get(name).is_none() {
        let help = format!(
            "write {braces} in a strategy, or name the axis by the path of a value, such as `cut.front.surfaces.0.amplitude`"
        );
        return Err(entry.fault("its values are not used", help));
    }
    of_paths(name, vec![name.to_owned()], entry, draft)
}

/// Reads the values that replace those of an axis for `--quick`. If the values of the axis are tables, they are selected by label.
fn fewer(name: &str, entry: &Entry<'_>, draft: &RunDraft) -> Result<SweepAxis> {
    let Some(full) = draft.axes.get(name) else {
        return axis(name, entry, draft);
    };
    if !full.paths.is_empty() {
        return of_paths(name, full.paths.clone(), entry, draft);
    }
    if full.values.iter().all(|v| v.sets.is_empty()) {
        return of_strategies(name, entry);
    }
    let value = |e: &Entry<'_>| {
        if e.is_table() {
            return tabled(e, draft);
        }
        let is = called(e)?;
        let known = full.values.iter().find(|v| v.is == is);
        known.cloned().ok_or_else(|| {
            let names: Vec<String> = full.values.iter().map(|v| v.is.to_string()).collect();
            let help = format!("use one of: {}", names.join(", "));
            e.fault(format_args!("the sweep has no value `{is}`"), help)
        })
    };
    let values = entry.list()?.iter().map(value).collect::<Result<_>>()?;
    SweepAxis::of(name, Vec::new(), values).map_err(|f| entry.place(f))
}

fn of_strategies(name: &str, entry: &Entry<'_>) -> Result<SweepAxis> {
    let value = |e: &Entry<'_>| {
        Ok(SweepValue {
            is: called(e)?,
            sets: Changes::new(),
        })
    };
    let values = entry.list()?.iter().map(value).collect::<Result<_>>()?;
    SweepAxis::of(name, Vec::new(), values).map_err(|f| entry.place(f))
}

/// Reads an axis that sets each of its values at the same paths.
fn of_paths(
    name: &str,
    paths: Vec<String>,
    entry: &Entry<'_>,
    draft: &RunDraft,
) -> Result<SweepAxis> {
    let value = |e: &Entry<'_>| {
        let sets = paths.iter().map(|path| (path.clone(), e.node.clone()));
        let sets: Changes = sets.collect();
        settable(&sets, e, draft)?;
        Ok(SweepValue {
            is: called(e)?,
            sets,
        })
    };
    let values = entry.list()?.iter().map(value).collect::<Result<_>>()?;
    SweepAxis::of(name, paths, values).map_err(|f| entry.place(f))
}

/// Reads a value that is a table with the paths that it sets: `{ is = "2 k", "part.0.shape" = "torus?segments=48&sides=21" }`.
fn tabled(entry: &Entry<'_>, draft: &RunDraft) -> Result<SweepValue> {
    let table = entry.open_table()?;
    let is = called(&table.need("is", "\"2 k\"")?)?;
    let others = table.all().filter(|(key, _)| *key != "is");
    let sets: Changes = others
        .map(|(path, e)| (path.to_owned(), e.node.clone()))
        .collect();
    if sets.is_empty() {
        let help = "add the paths and values that it sets, such as `\"part.0.scale\" = 2`";
        return Err(entry.fault("it sets nothing", help));
    }
    settable(&sets, entry, draft)?;
    Ok(SweepValue { is, sets })
}

fn settable(sets: &Changes, entry: &Entry<'_>, draft: &RunDraft) -> Result<()> {
    if sets
        .iter()
        .any(|(path, _)| path == "strategy.name" || path == "strategy")
    {
        let help = "name the strategies in `strategies`: each strategy is measured at each point";
        return Err(entry.fault("the strategy is not set in the scene here", help));
    }
    draft
        .variable
        .scene
        .with_changes(sets)
        .map(|_| ())
        .map_err(|e| entry.place(e))
}

/// Label of a value.
fn called(entry: &Entry<'_>) -> Result<Parameter> {
    Parameter::of(&entry.node.value).ok_or_else(|| {
        let help = "give it a label: `{ is = \"small\", \"resolution\" = [64, 48] }`";
        entry.fault("a list or a table has no name", help)
    })
}
