//! Description of an experiment for reports: its question and analysis, its runs, and its charts.
//!
//! The description is read from the experiment's file and written to the folder of the experiment's records as `experiment.json`, from
//! which reports read it. The scene of each point is in the point's record. Unknown keys of `experiment.json` are ignored.

use serde::{Deserialize, Serialize};

use super::Moves;

/// Description of an experiment.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Synopsis {
    /// Name of the experiment: the stem of its file.
    pub name: String,
    /// The experiment's question: one sentence that ends in a question mark.
    #[serde(default)]
    pub question: String,
    /// Analysis in Markdown: what is asked, how to read the answer, and the answer's limits.
    #[serde(default)]
    pub analysis: String,
    /// Its runs, in order.
    #[serde(default, rename = "run")]
    pub runs: Vec<RunSynopsis>,
    /// Its charts, in order.
    #[serde(default, rename = "chart")]
    pub charts: Vec<ChartSynopsis>,
    /// Names, without `.json`, of all record files that the experiment's runs write; empty in files older than this field.
    #[serde(default)]
    pub points: Vec<String>,
    /// Text of the experiment's file when it was measured; empty in files older than this field.
    #[serde(default)]
    pub toml: String,
}

/// Description of an experiment's run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RunSynopsis {
    /// Name of the run, unique in the experiment.
    pub name: String,
    /// Description in one line.
    #[serde(default)]
    pub about: Option<String>,
    /// Common name of the kind of input that the run represents, such as `plane cuts`, if any.
    #[serde(default)]
    pub input: Option<String>,
    /// The inputs that move in the use case that the run represents.
    #[serde(default)]
    pub moves: Moves,
}

/// A chart of an experiment.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ChartSynopsis {
    /// Title of the chart, as a sentence.
    pub title: String,
    /// Names of the runs that the chart shows; all runs if empty.
    #[serde(default)]
    pub runs: Vec<String>,
    /// Parameter or figure along the x axis.
    pub x: String,
    /// Figure along the y axis.
    pub y: String,
    /// Which axes are logarithmic: `x`, `y` or both.
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
    /// Index of a run in the experiment; the number of runs if the experiment has no such run.
    pub fn place_of(&self, run: &str) -> usize {
        let place = self.runs.iter().position(|r| r.name == run);
        place.unwrap_or(self.runs.len())
    }
}
