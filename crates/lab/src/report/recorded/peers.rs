//! Results of other tools on the same cuts, next to ours: `peers/*.json`.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::experiment::Samples;

/// One comparison with other tools.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PeerRecord {
    /// Version of this form, [`PeerRecord::FORMAT`].
    pub format: u32,
    /// `planar` or `relief`.
    pub what: String,
    /// The machine, in whatever words the script has for it.
    #[serde(default)]
    pub machine: serde_json::Value,
    /// Versions of the other tools, by name.
    #[serde(default)]
    pub versions: BTreeMap<String, String>,
    /// Version and commit of cutaway.
    #[serde(default)]
    pub cutaway: BTreeMap<String, Option<String>>,
    /// The command line.
    #[serde(default)]
    pub command: String,
    /// Results, one row per cut and tool.
    pub rows: Vec<PeerRow>,
    /// Checks of the areas against their expected values.
    #[serde(default)]
    pub checks: Vec<PeerCheck>,
}

impl PeerRecord {
    /// The version that is read.
    pub const FORMAT: u32 = 1;
}

/// An area, what it had to be, and whether it was.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PeerCheck {
    /// Name of the mesh.
    pub mesh: String,
    /// The cut in words.
    pub cut: String,
    /// Tool that computed the area.
    pub tool: String,
    /// Error of the area, in its unit.
    pub off: f64,
    /// Largest error allowed.
    pub bound: f64,
    /// Origin of the bound.
    #[serde(default)]
    pub bound_is: String,
    /// True if the error is within the bound.
    pub holds: bool,
}

/// One cut by one tool.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PeerRow {
    /// Name of the mesh.
    pub mesh: String,
    /// Its triangles.
    #[serde(default)]
    pub triangles: Option<u64>,
    /// The cut in words.
    pub cut: String,
    /// Tool that made the cut.
    pub tool: String,
    /// Area of the section or of the cap, where there is one.
    #[serde(default)]
    pub area: Option<f64>,
    /// Unit of the area.
    #[serde(default)]
    pub area_unit: Option<String>,
    /// Time, where it was taken.
    #[serde(default)]
    pub time_ms: Option<Samples>,
    /// Work that the time covers.
    #[serde(default)]
    pub clock: Option<String>,
    /// `done`, `refused` or `failed`.
    pub outcome: String,
    /// The tool's own words, where it did not do it.
    #[serde(default)]
    pub reason: Option<String>,
    /// The command that repeats it.
    #[serde(default)]
    pub command: Option<String>,
}
