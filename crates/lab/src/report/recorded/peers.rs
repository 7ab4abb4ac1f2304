//! Results of other tools on the same cuts, together with ours: `peers/*.json`.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::experiment::Samples;

/// One comparison with other tools.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PeerRecord {
    /// Version of this format, [`PeerRecord::FORMAT`].
    pub format: u32,
    /// Kind of the cuts: `planar` or `relief`.
    pub what: String,
    /// The machine, as the measuring script describes it.
    #[serde(default)]
    pub machine: serde_json::Value,
    /// Versions of the other tools, by name.
    #[serde(default)]
    pub versions: BTreeMap<String, String>,
    /// Version and commit of cutaway.
    #[serde(default)]
    pub cutaway: BTreeMap<String, Option<String>>,
    /// The command line that made this file.
    #[serde(default)]
    pub command: String,
    /// Results, one row per cut and tool.
    pub rows: Vec<PeerRow>,
    /// Checks of the areas against their expected values.
    #[serde(default)]
    pub checks: Vec<PeerCheck>,
}

impl PeerRecord {
    /// The format version that this program reads.
    pub const FORMAT: u32 = 1;
}

/// Check of an area: its error, the allowed error, and the result.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PeerCheck {
    /// Name of the mesh.
    pub mesh: String,
    /// The cut in words.
    pub cut: String,
    /// Tool that computed the area.
    pub tool: String,
    /// Error of the area, in the area's unit.
    pub off: f64,
    /// Largest error allowed.
    pub bound: f64,
    /// How the bound was determined.
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
    /// Number of triangles of the mesh.
    #[serde(default)]
    pub triangles: Option<u64>,
    /// The cut in words.
    pub cut: String,
    /// Tool that made the cut.
    pub tool: String,
    /// Area of the section or of the cap, if there is one.
    #[serde(default)]
    pub area: Option<f64>,
    /// Unit of the area.
    #[serde(default)]
    pub area_unit: Option<String>,
    /// Time, if it was measured.
    #[serde(default)]
    pub time_ms: Option<Samples>,
    /// Work that the time covers.
    #[serde(default)]
    pub clock: Option<String>,
    /// `done`, `refused` or `failed`.
    pub outcome: String,
    /// The tool's own message if it did not make the cut.
    #[serde(default)]
    pub reason: Option<String>,
    /// The command that repeats the cut.
    #[serde(default)]
    pub command: Option<String>,
}
