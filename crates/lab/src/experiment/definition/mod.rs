//! Parser of an experiment: one TOML file with a question, scenes, sweep axes, strategies and expectations.
//!
//! Reading a file checks everything that can be checked without opening a scene: every key and strategy name is known, every path can
//! be set, every value is used, and every expectation matches a renderer. The result is already expanded: each run of scenes holds two
//! lists of points, one for the full task and one for `--quick`, and each point has its scene document.
//!
//! The format is described in `experiments/README.md`; the modules of this folder read its parts.

mod charts;
mod claims;
mod drift;
mod moves;
mod others;
mod scenes;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

pub use claims::{Claim, Wanted};
pub use moves::Moves;
pub use others::{AskedCases, AskedSearch};
pub use scenes::{Pictures, SceneRun};

use cutaway::{Error, Result};
use cutaway_io::document::reader::{Entry, Table, with_table};

use super::{RunSynopsis, Synopsis};

const FILE_KEYS: &[&str] = &["question", "analysis", "run", "chart"];

/// An experiment.
#[derive(Clone, Debug)]
pub struct Definition {
    /// Path of the experiment's file, as the caller gave it.
    pub path: PathBuf,
    /// Name of the experiment: the stem of its file.
    pub name: String,
    /// The runs.
    pub runs: Vec<DefinedRun>,
    /// Synopsis for the folder of records. It lists no points, as these differ between the full task and `--quick`.
    pub synopsis: Synopsis,
}

/// A run of an experiment.
#[derive(Clone, Debug)]
pub struct DefinedRun {
    /// Its name, unique in the experiment.
    pub name: String,
    /// The full task.
    pub full: Asked,
    /// The task with `--quick`.
    pub quick: Asked,
    /// True if the file defines a task for `--quick`; otherwise `--quick` uses the full task.
    pub has_quick: bool,
}

impl DefinedRun {
    /// The full task, or that of `--quick`.
    pub fn asked(&self, is_quick: bool) -> &Asked {
        if is_quick { &self.quick } else { &self.full }
    }
}

/// Task of a run.
#[derive(Clone, Debug)]
pub enum Asked {
    /// Strategies measured on scenes.
    Scenes(SceneRun),
    /// The library's hard cases.
    Cases(AskedCases),
    /// Random scenes, searched for faults.
    Search(AskedSearch),
}

impl Definition {
    /// Reads an experiment from its file.
    pub fn load(path: &Path) -> Result<Self> {
        let text = std::fs::read_to_string(path).map_err(|e| {
            let help = "check the path; an experiment is TOML text in UTF-8";
            Error::file(path, format!("cannot be read: {e}"), help)
        })?;
        Self::read(path, &text)
    }

    /// Reads an experiment from the text of a file.
    pub fn read(path: &Path, text: &str) -> Result<Self> {
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        let name = stem.into_owned();
        if !is_name(&name) || path.extension().is_none_or(|e| e != "toml") {
            return Err(Error::file(
                path,
                "the file name, which names the experiment, must be [a-z0-9-]+ and .toml, and neither `experiment` nor `peers`",
                "rename it, for example to 01-paper.toml",
            ));
        }
        with_table(path, text, FILE_KEYS, |root| {
            let question = question(root)?;
            let analysis = root.need("analysis", "\"\"\"What was asked.\"\"\"")?;
            let analysis = analysis.text()?.trim().to_owned();
            let (runs, synopses): (Vec<_>, _) = runs(root, path)?.into_iter().unzip();
            let charts = root.tables("chart")?;
            let charts = charts.iter().map(|e| charts::read(e, &runs));
            let synopsis = Synopsis {
                name: name.clone(),
                question,
                analysis,
                charts: charts.collect::<Result<_>>()?,
                runs: synopses,
                points: Vec::new(),
                toml: text.to_owned(),
            };
            Ok(Self {
                path: path.to_owned(),
                name,
                runs,
                synopsis,
            })
        })
    }
}

/// Names of other entries in a folder of records, which no record may have.
const TAKEN: [&str; 2] = ["experiment", "peers"];

/// Returns true if a name is a valid file name on any system.
fn is_name(name: &str) -> bool {
    let is_plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
    !name.is_empty() && name.chars().all(is_plain) && !TAKEN.contains(&name)
}

fn question(root: &Table<'_>) -> Result<String> {
    let entry = root.need("question", "\"What does it cost?\"")?;
    let question = entry.text()?.trim();
    if question.len() < 2 || !question.ends_with('?') {
        let help = "write one sentence that ends in a question mark";
        return Err(entry.fault("it is not a question", help));
    }
    Ok(question.to_owned())
}

fn runs(root: &Table<'_>, path: &Path) -> Result<Vec<(DefinedRun, RunSynopsis)>> {
    let entries = root.tables("run")?;
    if entries.is_empty() {
        let help = "add `[[run]]` with `name`, `scene` and `strategies`";
        return Err(root.entry.fault("the experiment runs nothing", help));
    }
    let runs: Vec<_> = entries
        .iter()
        .map(|e| run(e, path))
        .collect::<Result<_>>()?;
    let mut seen = BTreeSet::new();
    match runs.iter().position(|(r, _)| !seen.insert(&*r.name)) {
        Some(i) => Err(entries[i].fault("the name is taken", "give every run its own name")),
        None => Ok(runs),
    }
}

fn run(entry: &Entry<'_>, path: &Path) -> Result<(DefinedRun, RunSynopsis)> {
    let table = entry.open_table()?;
    let is_cases = table.get("cases").is_some();
    let is_search = table.get("random").is_some();
    if usize::from(is_cases) + usize::from(is_search) + usize::from(table.get("scene").is_some())
        != 1
    {
        let help = "give exactly one of `scene`, `cases` and `random`";
        return Err(entry.fault("it defines no task, or several tasks", help));
    }
    let name = table.need("name", "\"crank\"")?;
    if !is_name(name.text()?) {
        let help = "use lower-case letters, digits and `-`, and neither `experiment` nor `peers`: files are named after it";
        return Err(name.fault("it cannot be a name", help));
    }
    let about = table.get("about");
    let about = about.map(|e| e.text().map(str::to_owned)).transpose()?;
    let moves = table.get("moves").map(|e| moves::read(&e)).transpose()?;
    let input = table.get("input").map(|e| input(&e)).transpose()?;
    let (full, quick) = if is_cases {
        others::read_cases(entry)?
    } else if is_search {
        others::read_search(entry)?
    } else {
        scenes::read(entry, path)?
    };
    let name = name.text()?.to_owned();
    let synopsis = RunSynopsis {
        name: name.clone(),
        about,
        input,
        moves: moves.unwrap_or_default(),
    };
    let run = DefinedRun {
        name,
        full,
        quick,
        has_quick: table.get("quick").is_some(),
    };
    Ok((run, synopsis))
}

fn input(entry: &Entry<'_>) -> Result<String> {
    match entry.text()?.trim() {
        "" => Err(entry.fault(
            "it is empty",
            "write what a user would call it, such as \"plane cuts\"",
        )),
        text => Ok(text.to_owned()),
    }
}
