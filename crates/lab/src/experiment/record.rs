//! Results of a run: one [`Record`] for each point of an experiment, and one [`Run`] with the machine and the program.
//!
//! A folder of a run holds `run.json`, and for each experiment a folder with `experiment.json` (its definition) and one JSON file for each
//! point, next to its pictures. Each file is written whole, as soon as it is known: a run that is interrupted loses one point, and
//! continues from the next. Nothing in a record is computed from other records: a report recomputes whatever combines several.

use std::collections::BTreeMap;
use std::path::{Component, Path};

use cutaway::gpu::AdapterReport;
use cutaway_io::document::Document;
use serde::{Deserialize, Serialize};

use super::{Measurement, Parameters};

/// A point of an experiment, measured.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// Version of this form.
    pub format: u32,
    /// Name of the experiment: the stem of its file.
    pub experiment: String,
    /// Name of the run in it.
    pub run: String,
    /// Values of what is varied of its scene.
    pub parameters: Parameters,
    /// True if it was measured with fewer pixels, values and rounds.
    pub is_quick: bool,
    /// Says what was measured and by what: a point is not measured again if this is what it would be.
    pub identity: String,
    /// The scene, as a scene file in the folder that the command was run in would have it.
    #[serde(with = "as_text")]
    pub scene: Document,
    /// The scene whose exact image is the truth, where that is another.
    #[serde(with = "as_text_if_any")]
    pub truth: Option<Document>,
    /// The measurements.
    pub measurement: Measurement,
    /// Sources of each strategy, in the order of the measurement: at least one, and more where several strategy texts of the experiment
    /// give the same renderer.
    #[serde(rename = "makers")]
    pub families: Vec<Vec<FamilyMember>>,
    /// More figures of each strategy than one frame has, by name, in the order of the measurement.
    pub figures: Vec<BTreeMap<String, f64>>,
    /// The expectations and their results.
    pub expectations: Vec<Reached>,
    /// Warnings about the figures.
    pub warnings: Vec<Warning>,
    /// Pictures in the folder of the record.
    pub pictures: Vec<RecordedPicture>,
    /// The command that measured it; none in records that are older than this.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[serde(rename = "sitting")]
    pub invocation: Option<Invocation>,
}

/// A document as the text of its file.
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

/// A document that may be missing.
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
    /// Strategy text in the experiment: `grid:256+vds:{texels}`; the strategy's name, where nothing in the text is swept.
    pub family: String,
    /// The values that took the places of the placeholders.
    pub parameters: Parameters,
}

impl Record {
    /// The version that is written.
    pub const FORMAT: u32 = 2;
}

/// One command that measured points: a run may take several.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Invocation {
    /// When it began: RFC 3339, UTC.
    pub began: String,
    /// Processes that wanted to run before it began, in the mean over the last minute, where it is known.
    pub load: Option<f64>,
    /// The command line.
    pub command: String,
    /// The device; none in records that are older than this, whose run has but one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub adapter: Option<AdapterReport>,
    /// The version of the program; none in records that are older than this, whose run has but one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub version: Option<String>,
    /// The commit that the program was built from, where it is known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub commit: Option<String>,
    /// The share of the work that it was, `3/16`, where it was not all.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shard: Option<String>,
    /// The job of a scheduler that it was.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub job: Option<String>,
    /// The machine, by its name, where there may be several.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub node: Option<String>,
}

/// A number as it is expected.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Bound {
    /// The least that is allowed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub least: Option<f64>,
    /// The most that is allowed.
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
    /// Why it cannot be better, where it is a failure or a bound that is declared.
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
    /// True if the result is as expected. A declared failure that passes is not.
    pub holds: bool,
}

/// A hard case: a scene with a known answer, and its results.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CaseRecord {
    /// Its number in the list, or its letter and number where it comes from another project's users: `38`, `B8`.
    pub id: String,
    /// Short description.
    pub name: String,
    /// Expectations of each strategy, and their results.
    pub expectations: Vec<Reached>,
    /// Test of the properties that its picture cannot show, as its name is typed after `cargo test -p cutaway-tests`.
    pub held_by: Option<String>,
}

/// The hard cases of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CaseRecords {
    /// Version of this form, [`Record::FORMAT`].
    pub format: u32,
    /// Name of the experiment: the stem of its file.
    pub experiment: String,
    /// Name of the run in it.
    pub run: String,
    /// As [`Record::identity`].
    pub identity: String,
    /// Pixels along the sides of the pictures.
    pub sizes_px: Vec<u32>,
    /// The cases.
    pub cases: Vec<CaseRecord>,
    /// The command that measured them; none in records that are older than this.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub invocation: Option<Invocation>,
}

/// Warning about a figure. A closed list, so that each has its remedy.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Warning {
    /// The adapter runs on the CPU: times say nothing about graphics cards.
    SoftwareAdapter {
        /// Its name.
        adapter: String,
    },
    /// Times were taken by the clock of the wall, around each pass.
    WallTimes,
    /// Other work was on the machine before the run began.
    Busy {
        /// Processes that wanted to run, in the mean over the last minute.
        load: f64,
        /// Processors there are.
        cores: usize,
    },
    /// Times of a strategy scatter.
    Noisy {
        /// Whose.
        strategy: String,
        /// Median absolute deviation over median, of the frame's time.
        spread: f64,
    },
    /// Times of the plain drawing scatter, and every ratio with them.
    NoisyDrawOnly {
        /// Median absolute deviation over median.
        spread: f64,
    },
    /// Something was said when the scene was opened: a section misses the model, a mesh was mended.
    Opening {
        /// Text of the remark.
        text: String,
        /// Suggested remedy; empty where none was given. Records of 2026-11-21 call it `mend`.
        #[serde(alias = "mend")]
        help: String,
    },
    /// The machine slowed down from round to round.
    Throttled {
        /// Plain drawing in the last third of the rounds over that in the first.
        slowdown: f64,
    },
    /// A bounded buffer was too small.
    Overflowed {
        /// Whose.
        strategy: String,
        /// The buffer, and the excess.
        reason: String,
    },
    /// The reference leaves many pixels undecided.
    Undecided {
        /// Undecided pixels over covered ones.
        share: f64,
    },
    /// Too few rounds for a spread to mean anything.
    FewRounds {
        /// Number of rounds.
        rounds: usize,
        /// True if `--quick` caused it.
        #[serde(default)]
        is_quick: bool,
    },
}

/// A picture in the folder of a record.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct RecordedPicture {
    /// Name of the strategy that drew it, or `exact`.
    pub drawer: String,
    /// File of what was drawn, in the folder of the record.
    pub file: String,
    /// File that shows where it differs from exact.
    pub heatmap: Option<String>,
}

impl RecordedPicture {
    /// Its files.
    pub fn files(&self) -> impl Iterator<Item = &str> {
        std::iter::once(self.file.as_str()).chain(self.heatmap.as_deref())
    }

    /// Returns true if its files are in the folder of the record: a record from elsewhere must not cause files in other places to be read
    /// or removed.
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
    /// Processors that this process may use.
    pub cores: usize,
    /// Memory in bytes, where it is known.
    pub memory: Option<u64>,
    /// Processes that wanted to run before the run began, in the mean over the last minute, where it is known.
    pub load: Option<f64>,
}

/// Machine and program of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Run {
    /// Version of this form, [`Record::FORMAT`].
    pub format: u32,
    /// The command line.
    pub command: String,
    /// Version of cutaway.
    pub version: String,
    /// Commit of its sources, with `+` where they differ from it; none where that is not known.
    pub commit: Option<String>,
    /// When it began: RFC 3339, UTC.
    pub began: String,
    /// Seconds of measuring, over all invocations.
    pub took_s: f64,
    /// True if fewer pixels, values and rounds were requested.
    pub is_quick: bool,
    /// The machine.
    pub machine: Machine,
    /// The device.
    pub adapter: AdapterReport,
    /// Limits of the device that plans are made for, by name.
    pub limits: BTreeMap<String, u64>,
}

impl Run {
    /// The file of a run that is not divided into shards.
    pub const FILE: &str = "run.json";

    /// File name of shard `index` of `count`.
    pub fn file_of_shard(index: u32, count: u32) -> String {
        format!("run.{index}-of-{count}.json")
    }

    /// Returns true if a file name is that of a run or of a shard.
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
