//! Reads complete folders of runs, and checks them before they are used.
//!
//! `cutaway measure` and the outside baselines write such a folder: `run.json`, a folder for each experiment with `experiment.json` and
//! one file for each point, and `peers/*.json`. Folders in it without `experiment.json` are skipped, and so are files that are not JSON.
//! Incomplete files, unknown formats and inconsistent contents are rejected with an error that names the file. Nothing is derived here.

mod folder;
mod peers;

pub use folder::{Experiment, Folder};
pub use peers::{PeerCheck, PeerRecord, PeerRow};

use std::path::{Path, PathBuf};

use cutaway::{Error, Result};

/// The folders of a report.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordedFolders {
    /// The folders in the order given; a folder has one entry for each combination of device and program that measured it.
    pub folders: Vec<Folder>,
}

impl RecordedFolders {
    /// Reads folders of runs.
    ///
    /// # Errors
    ///
    /// Fails if a file is missing, incomplete, or in an unknown format; the error names the file.
    pub fn read(folders: &[PathBuf]) -> Result<Self> {
        let mut seen: Vec<PathBuf> = Vec::new();
        let mut read = Vec::new();
        for folder in folders {
            let place = std::fs::canonicalize(folder).unwrap_or_else(|_| folder.clone());
            if !seen.contains(&place) {
                seen.push(place);
                read.extend(Folder::read(folder)?);
            }
        }
        Ok(Self { folders: read })
    }

    /// Number of measured points, number of all points of the experiments, and the missing points as `experiment/point`.
    pub fn completeness(&self) -> (usize, usize, Vec<String>) {
        let mut seen: Vec<(&Path, &str)> = Vec::new();
        let (mut asked, mut missing) = (0, Vec::new());
        for folder in &self.folders {
            for experiment in &folder.experiments {
                let name = experiment.synopsis.name.as_str();
                if !seen.contains(&(&*folder.path, name)) {
                    seen.push((&folder.path, name));
                    asked += experiment.synopsis.points.len();
                    missing.extend(experiment.missing.iter().map(|p| format!("{name}/{p}")));
                }
            }
        }
        (asked - missing.len(), asked, missing)
    }
}

/// Reads a JSON file whose format has a version number, which must be `known`.
fn read_numbered<T: serde::de::DeserializeOwned>(path: &Path, known: u32) -> Result<T> {
    let value: serde_json::Value = read_json(path)?;
    match value.get("format").and_then(serde_json::Value::as_u64) {
        Some(format) if format == u64::from(known) => {}
        Some(format) => {
            return Err(Error::file(
                path,
                format!("it has format {format}, and this version reads format {known}"),
                "make the report with the version that measured it, or measure again with this version",
            ));
        }
        None => {
            return Err(Error::file(
                path,
                "it does not state which format it has (`format`)",
                "move files that are not records out of the folder, or measure again",
            ));
        }
    }
    serde_json::from_value(value).map_err(|e| misread(path, &e))
}

fn read_json<T: serde::de::DeserializeOwned>(path: &Path) -> Result<T> {
    let text = std::fs::read_to_string(path)
        .map_err(|e| Error::file(path, format!("cannot be read: {e}"), MISSING))?;
    serde_json::from_str(&text).map_err(|e| misread(path, &e))
}

const MISSING: &str =
    "name the folder that `cutaway measure` wrote with --out, or measure into it again";

fn misread(path: &Path, e: &serde_json::Error) -> Error {
    let help = "remove the file and measure again: points that are whole are kept";
    let what = format!("it is incomplete or invalid: {e}");
    match e.line() {
        0 => Error::file(path, what, help),
        line => Error::file_line(path, line, what, help),
    }
}
