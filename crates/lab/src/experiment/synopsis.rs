//! Description of an experiment for reports: its question and analysis, its runs, and its charts.
//!
//! It is read from the experiment's file and written to the folder of its records as `experiment.json`, the only source that a report
//! has for it. What was drawn at each point is in the point's record. Unknown keys of `experiment.json` are ignored.

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
    /// Names of all record files that its runs write, without `.json`; empty in records older than this field.
    #[serde(default)]
    pub points: Vec<String>,
    /// Text of the experiment's file at the time; empty in records older than this field.
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
    /// Common name of the input that it represents, if any: `plane cuts`.
    #[serde(default)]
    pub input: Option<String>,
    /// The inputs that move in that use.
    #[serde(default)]
    pub moves: Moves,
}

/// A chart of an experiment.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ChartSynopsis {
    /// Title, as a sentence.
    pub title: String,
    /// Names of the runs it shows; all if empty.
    #[serde(default)]
    pub runs: Vec<String>,
    /// Parameter or figure along the x axis.
    pub x: String,
    /// Figure along the y axis.
    pub y: String,
    /// The logarithmic axes: `x`, `y`.
    #[serde(default)]
    pub log: Vec<String>,
    /// True if y is an error and x its cost, so that the chart has a Pareto front.
    #[serde(default)]
    pub pareto: bool,
    /// One line under the chart.
    #[serde(default)]
    pub note: Option<String>,
}

impl Synopsis {
    /// Index of a run in the experiment; past the last one if it is not there.
    pub fn place_of(&self, run: &str) -> usize {
        let place = self.runs.iter().position(|r| r.name == run);
        place.unwrap_or(self.runs.len())
    }
}
