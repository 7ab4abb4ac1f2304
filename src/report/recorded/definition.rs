//! What was asked: as much of an experiment's definition as a report tells.
//!
//! Measuring has checked the definition; here keys that say nothing to a reader are passed over.

use serde::{Deserialize, Serialize};

use crate::experiment::definition::Moves;

/// An experiment.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Definition {
    /// The stem of its file.
    pub name: String,
    /// One sentence.
    #[serde(default)]
    pub question: String,
    /// Markdown: what was asked, how to read the answer, what it cannot say.
    #[serde(default)]
    pub analysis: String,
    /// Its runs, in order.
    #[serde(default, rename = "run", alias = "runs")]
    pub runs: Vec<RunDefinition>,
    /// Its charts, in order.
    #[serde(default, rename = "chart", alias = "charts")]
    pub charts: Vec<ChartDefinition>,
    /// Files of all records that its runs make, without `.json`; empty in records that are older than this.
    #[serde(default)]
    pub points: Vec<String>,
}

/// A run of an experiment.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RunDefinition {
    /// Unique in the experiment.
    pub name: String,
    /// One line.
    #[serde(default)]
    pub about: Option<String>,
    /// What a user would call the input that it stands for.
    #[serde(default)]
    pub input: Option<String>,
    /// What moves where that is used.
    #[serde(default)]
    pub moves: Moves,
}

/// A chart of an experiment.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ChartDefinition {
    /// What it shows.
    pub title: String,
    /// Names of runs; all if empty.
    #[serde(default)]
    pub runs: Vec<String>,
    /// A parameter or a figure.
    pub x: String,
    /// A figure.
    pub y: String,
    /// Which axes are logarithmic: `x`, `y`.
    #[serde(default)]
    pub log: Vec<String>,
    /// Whether y is an error and x its cost, so that there is a front.
    #[serde(default)]
    pub pareto: bool,
    /// One line under it.
    #[serde(default)]
    pub note: Option<String>,
}

impl Definition {
    /// Place of a run in the definition; after all others where it is not there.
    pub fn place_of(&self, run: &str) -> usize {
        let place = self.runs.iter().position(|r| r.name == run);
        place.unwrap_or(self.runs.len())
    }
}
