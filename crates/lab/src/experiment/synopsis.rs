//! Definition of an experiment for reports: the experiment in words, its runs, its charts.
//!
//! It is read from the file of an experiment and written to the folder of its records as `experiment.json`. A report has no other source
//! for it. The drawing of each point is in its record. Unknown keys of `experiment.json` are ignored.

use serde::{Deserialize, Serialize};

use super::Moves;

/// An experiment, described.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Synopsis {
    /// The stem of its file.
    pub name: String,
    /// One sentence that ends in a question mark.
    #[serde(default)]
    pub question: String,
    /// Markdown: the question, how to read the answer, the limits of the answer.
    #[serde(default)]
    pub analysis: String,
    /// Its runs, in order.
    #[serde(default, rename = "run")]
    pub runs: Vec<RunSynopsis>,
    /// Its charts, in order.
    #[serde(default, rename = "chart")]
    pub charts: Vec<ChartSynopsis>,
    /// Files of all records that its runs make, without `.json`; empty in records that are older than this.
    #[serde(default)]
    pub points: Vec<String>,
    /// The file of the experiment, as it was; empty in records that are older than this.
    #[serde(default)]
    pub toml: String,
}

/// A run of an experiment, described.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RunSynopsis {
    /// Unique in the experiment.
    pub name: String,
    /// Description, in a line.
    #[serde(default)]
    pub about: Option<String>,
    /// Common name of the input that it stands for, if any: `plane cuts`.
    #[serde(default)]
    pub input: Option<String>,
    /// The inputs that move in such a use.
    #[serde(default)]
    pub moves: Moves,
}

/// A chart of an experiment.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ChartSynopsis {
    /// Title, as a sentence.
    pub title: String,
    /// Names of runs; all if empty.
    #[serde(default)]
    pub runs: Vec<String>,
    /// A parameter or a figure.
    pub x: String,
    /// A figure.
    pub y: String,
    /// The logarithmic axes: `x`, `y`.
    #[serde(default)]
    pub log: Vec<String>,
    /// True if y is an error and x its cost, so that the chart has a Pareto front.
    #[serde(default)]
    pub pareto: bool,
    /// One line under it.
    #[serde(default)]
    pub note: Option<String>,
}

impl Synopsis {
    /// Place of a run in the experiment; after all others where it is not there.
    pub fn place_of(&self, run: &str) -> usize {
        let place = self.runs.iter().position(|r| r.name == run);
        place.unwrap_or(self.runs.len())
    }
}
