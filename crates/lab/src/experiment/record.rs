//! Results of a run: one [`Record`] for each point of an experiment, and one [`Run`] with the machine and the program.
//!
//! A run's folder holds `run.json`, and for each experiment a folder with `experiment.json` (its definition) and one JSON file for each
//! point, next to its pictures. Each file is written as a whole, as soon as its contents are known: an interrupted run loses at most one
//! point, and continues from there. No record is computed from other records: a report computes whatever combines several records.

use std::collections::BTreeMap;
use std::path::{Component, Path};

use cutaway::gpu::AdapterReport;
use cutaway_io::document::Document;
use serde::{Deserialize, Serialize};

use super::{Measurement, Parameters};

/// Measurement of one point of an experiment.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// Version of the record format.
    pub format: u32,
    /// Name of the experiment: the stem of its file.
    pub experiment: String,
    /// Name of the run in the experiment.
    pub run: String,
    /// Values that the scene's sweep axes have at this point.
    pub parameters: Parameters,
    /// True if the point was measured with `--quick`: with fewer pixels, values and rounds.
    pub is_quick: bool,
    /// Hash of the point, its files, the program and the device: a point is not measured again if its hash would be the same.
    pub identity: String,
    /// The scene as a scene file; its paths are relative to the folder in which the command was run.
    #[serde(with = "as_text")]
    pub scene: Document,
    /// The scene whose exact image is the reference, if it is not the measured scene.
    #[serde(with = "as_text_if_any")]
    pub truth: Option<Document>,
    /// The measurements.
    pub measurement: Measurement,
    /// Sources of each strategy, in the order of the measurement. Each strategy has at least one, and several if several of the
    /// experiment's strategy texts give the same renderer.
    #[serde(rename = "makers")]
    pub families: Vec<Vec<FamilyMember>>,
    /// Figures that need more than one frame, by name, for each strategy in the order of the measurement.
    pub figures: Vec<BTreeMap<String, f64>>,
    /// The expectations and their results.
    pub expectations: Vec<Reached>,
    /// Warnings about the figures.
    pub warnings: Vec<Warning>,
    /// Pictures in the folder of the record.
    pub pictures: Vec<RecordedPicture>,
    /// The command that measured the point; `None` in records older than this field.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[serde(rename = "sitting")]
    pub invocation: Option<Invocation>,
}

/// Serialises a document as the text of its file.
mod as_text {
    use serde::{Deserialize, Deserializer, Serializer, de::Error};

    use super::Document;

    pub(super) fn serialize<S: Serializer>(document: &Document, to: S) -> Result<S::Ok, S::Error> {
        to.collect_str(document)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Document, D::Error> {
        let text = String::deserialize(from)?;
        Document::parse("scene.toml", &text).map_err(D::Error::custom)
    }
}

/// Serialises an optional document as the text of its file.
mod as_text_if_any {
    use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error};

    use super::Document;

    pub(super) fn serialize<S: Serializer>(
        document: &Option<Document>,
        to: S,
    ) -> Result<S::Ok, S::Error> {
        let text = document.as_ref().map(ToString::to_string);
        text.serialize(to)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(
        from: D,
    ) -> Result<Option<Document>, D::Error> {
        let text = Option::<String>::deserialize(from)?;
        let document = text.map(|text| Document::parse("scene.toml", &text));
        document.transpose().map_err(D::Error::custom)
    }
}

/// Source of a strategy in an experiment.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FamilyMember {
    /// Strategy text in the experiment, such as `grid:256+vds:{texels}`; the strategy's name if the text has no placeholders.
    pub family: String,
    /// The values that replaced the placeholders in the strategy text.
    pub parameters: Parameters,
}

impl Record {
    /// The format version that this program writes.
    pub const FORMAT: u32 = 2;
}

/// One command that measured points of a run; a run may be measured by several commands.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Invocation {
    /// Start time: RFC 3339, UTC.
    pub began: String,
    /// Load average of the machine over the minute before the command began, if known.
    pub load: Option<f64>,
    /// The command line.
    pub command: String,
    /// The device; `None` in records older than this field, whose runs have only one device.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub adapter: Option<AdapterReport>,
    /// The program's version; `None` in records older than this field, whose runs have only one version.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub version: Option<String>,
    /// The commit that the program was built from, if known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub commit: Option<String>,
    /// The shard that the command measured, such as `3/16`, if it did not measure the whole run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shard: Option<String>,
    /// The scheduler job that ran the command.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub job: Option<String>,
    /// Name of the machine, if the run may use several.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub node: Option<String>,
}

/// Bounds of an expected number.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Bound {
    /// Smallest allowed number.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub least: Option<f64>,
    /// Largest allowed number.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub most: Option<f64>,
}

impl Bound {
    /// Returns true if a number is within the bounds.
    pub fn holds(&self, number: f64) -> bool {
        self.least.is_none_or(|least| number >= least)
            && self.most.is_none_or(|most| number <= most)
    }
}

/// Expected result of a strategy.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Expectation {
    /// Short description: `0 decided wrong`, `refuses reliefs`.
    pub what: String,
    /// If the expectation declares a failure or a bound, the reason why the result cannot be better.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub why: Option<String>,
}

/// An expectation and its result.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Reached {
    /// Name of the strategy.
    pub strategy: String,
    /// The expectation.
    pub expected: Expectation,
    /// Measured result, in the same form.
    pub found: String,
    /// True if the result is as expected. If a declared failure passes, this is false.
    pub holds: bool,
}

/// A hard case: a scene with a known answer, and its results.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CaseRecord {
    /// Its number in the list, such as `38`; a letter and number such as `B8` if users of another project reported the case.
    pub id: String,
    /// Short description.
    pub name: String,
    /// The expectations of each strategy, and their results.
    pub expectations: Vec<Reached>,
    /// Arguments after `cargo test -p cutaway-tests` of the test that checks what the case's picture cannot show.
    pub held_by: Option<String>,
}

/// The hard cases of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CaseRecords {
    /// Version of the format, [`Record::FORMAT`].
    pub format: u32,
    /// Name of the experiment: the stem of its file.
    pub experiment: String,
    /// Name of the run in the experiment.
    pub run: String,
    /// See [`Record::identity`].
    pub identity: String,
    /// Side lengths of the pictures in pixels.
    pub sizes_px: Vec<u32>,
    /// The cases.
    pub cases: Vec<CaseRecord>,
    /// The command that measured the cases; `None` in records older than this field.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub invocation: Option<Invocation>,
}

/// Warning about a figure. Warnings come from a closed set of kinds, so that each kind can have a remedy.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Warning {
    /// The adapter runs on the CPU, so its times do not apply to graphics cards.
    SoftwareAdapter {
        /// Name of the adapter.
        adapter: String,
    },
    /// Times were taken by the wall clock around each pass.
    WallTimes,
    /// The machine did other work before the run began.
    Busy {
        /// Load average over the minute before the run.
        load: f64,
        /// Number of processors.
        cores: usize,
    },
    /// The times of a strategy scatter.
    Noisy {
        /// Name of the strategy.
        strategy: String,
        /// Median absolute deviation of the frame time, divided by the median frame time.
        spread: f64,
    },
    /// The times of the plain drawing scatter, and so does every ratio that is relative to them.
    NoisyDrawOnly {
        /// Median absolute deviation of these times, divided by their median.
        spread: f64,
    },
    /// Opening the scene printed a remark, for example that a section misses the model or that a mesh was repaired.
    Opening {
        /// Text of the remark.
        text: String,
        /// Suggested remedy; empty if none was given. In records of 2026-11-21 the field is named `mend`.
        #[serde(alias = "mend")]
        help: String,
    },
    /// The machine slowed down from round to round.
    Throttled {
        /// Time of plain drawing in the last third of the rounds, divided by its time in the first third.
        slowdown: f64,
    },
    /// A bounded buffer was too small.
    Overflowed {
        /// Name of the strategy.
        strategy: String,
        /// The name of the buffer, and by how much its size was exceeded.
        reason: String,
    },
    /// The reference leaves many pixels undecided.
    Undecided {
        /// Number of undecided pixels divided by that of covered pixels.
        share: f64,
    },
    /// Too few rounds for a spread to mean anything.
    FewRounds {
        /// Number of rounds.
        rounds: usize,
        /// True if `--quick` is the cause.
        #[serde(default)]
        is_quick: bool,
    },
}

/// A picture in the folder of a record.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct RecordedPicture {
    /// Name of the strategy that drew it, or `exact`.
    pub drawer: String,
    /// File of the picture, in the record's folder.
    pub file: String,
    /// File of the heat map, which shows where the picture differs from exact.
    pub heatmap: Option<String>,
}

impl RecordedPicture {
    /// The picture's files.
    pub fn files(&self) -> impl Iterator<Item = &str> {
        std::iter::once(self.file.as_str()).chain(self.heatmap.as_deref())
    }

    /// Returns true if the picture's files are in the record's folder: a record from another source must not cause files in other
    /// folders to be read or removed.
    pub fn is_beside(&self) -> bool {
        let is_bare = |file: &str| {
            let mut parts = Path::new(file).components();
            matches!(
                (parts.next(), parts.next()),
                (Some(Component::Normal(_)), None)
            )
        };
        self.files().all(is_bare)
    }
}

/// Description of a machine.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Machine {
    /// Operating system and architecture.
    pub system: String,
    /// Name of the processor.
    pub processor: String,
    /// Number of processors that this process may use.
    pub cores: usize,
    /// Memory in bytes, if known.
    pub memory: Option<u64>,
    /// Load average over the minute before the run began, if known.
    pub load: Option<f64>,
}

/// Machine and program of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Run {
    /// Version of the format, [`Record::FORMAT`].
    pub format: u32,
    /// The command line of the last invocation.
    pub command: String,
    /// Version of cutaway.
    pub version: String,
    /// Commit of the program's sources, followed by `+` if there were uncommitted changes; `None` if unknown.
    pub commit: Option<String>,
    /// Start time: RFC 3339, UTC.
    pub began: String,
    /// Time spent measuring, in seconds, summed over all invocations.
    pub took_s: f64,
    /// True if fewer pixels, values and rounds were requested.
    pub is_quick: bool,
    /// The machine.
    pub machine: Machine,
    /// The device.
    pub adapter: AdapterReport,
    /// Device limits that plans must respect, by name.
    pub limits: BTreeMap<String, u64>,
}

impl Run {
    /// File name of a run that is not divided into shards.
    pub const FILE: &str = "run.json";

    /// File name of shard `index` of `count`.
    pub fn file_of_shard(index: u32, count: u32) -> String {
        format!("run.{index}-of-{count}.json")
    }

    /// Returns true if a path has the file name of a run or of a shard.
    pub fn is_file(path: &Path) -> bool {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        name.starts_with("run.") && name.ends_with(".json")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_are_beside_their_record_or_nowhere() {
        let picture = |file: &str, heatmap: Option<&str>| RecordedPicture {
            drawer: "exact".to_owned(),
            file: file.to_owned(),
            heatmap: heatmap.map(str::to_owned),
        };
        assert!(picture("a.png", Some("b.png")).is_beside());
        for stray in ["/etc/passwd", "../a.png", "a/b.png", "", ".."] {
            assert!(!picture(stray, None).is_beside(), "{stray}");
            assert!(!picture("a.png", Some(stray)).is_beside(), "{stray}");
        }
    }
}
