//! What other tools found of the same cuts, and what ours found beside them: `peers/*.json`.

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
    /// What was found.
    pub rows: Vec<PeerRow>,
    /// What the areas had to be.
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
    /// Whose area.
    pub tool: String,
    /// How far it is off, in the unit of the area.
    pub off: f64,
    /// How far it may be.
    pub bound: f64,
    /// Where the bound comes from.
    #[serde(default)]
    pub bound_is: String,
    /// Whether it is within.
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
    /// Who cut.
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
    /// What the time covers.
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
