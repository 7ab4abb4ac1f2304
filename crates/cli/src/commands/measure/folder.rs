//! The folder of a run: existing records are read and new ones are written, each file completely or not at all.

use std::path::{Path, PathBuf};

use cutaway::gpu::AdapterReport;
use cutaway::{Error, Result};
use cutaway_lab::experiment::picture;
use cutaway_lab::experiment::run::Measured;
use cutaway_lab::experiment::{CaseRecords, Definition, Record, RecordedPicture, Run, Synopsis};
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::input::shard::Shard;
use crate::writing::output::{checked_folder, write_file};

const OTHER_FOLDER: &str = "choose another folder with --out, or measure all again with --force";

/// The folder of a run.
pub(super) struct OutputFolder {
    path: PathBuf,
    /// Name of the file that describes the run; each shard has its own, so that no two write the same file.
    run_file: String,
}

impl OutputFolder {
    /// Opens a folder, which must be writable.
    pub(super) fn checked(path: &Path, shard: Option<Shard>) -> Result<Self> {
        checked_folder("--out", path)?;
        Ok(Self {
            path: path.to_owned(),
            run_file: match shard {
                Some(Shard { index, count }) => Run::file_of_shard(index, count),
                None => Run::FILE.to_owned(),
            },
        })
    }

    /// The existing files that a run of an experiment replaces: the experiment's definition, and the records with these names,
    /// with their pictures.
    pub(super) fn replaced(&self, experiment: &str, stems: &[String]) -> Vec<PathBuf> {
        let is_replaced = |name: &str| {
            let of_stem = |stem: &String| {
                let rest = name.strip_prefix(stem.as_str());
                rest.is_some_and(|r| r == ".json" || (r.starts_with('.') && r.ends_with(".png")))
            };
            name == "experiment.json" || stems.iter().any(of_stem)
        };
        let entries = std::fs::read_dir(self.of(experiment)).into_iter().flatten();
        let files = entries.flatten();
        let files = files.filter(|e| is_replaced(&e.file_name().to_string_lossy()));
        files
            .map(|e| e.path())
            .chain([self.path.join(&self.run_file)])
            .collect()
    }

    /// The existing run, if any. This run must not be mixed with a run on another device, nor a quick run with a full one: such a run is
    /// an error unless everything is measured again. Shards of a run may use several devices, but a shard replaces only its own points, so
    /// `force` does not allow a full run next to a quick one, or the reverse.
    pub(super) fn earlier(
        &self,
        adapter: &AdapterReport,
        is_quick: bool,
        force: bool,
    ) -> Result<Option<Run>> {
        let own = self.path.join(&self.run_file);
        let is_shard = self.run_file != Run::FILE;
        let replaces_all = force && !is_shard;
        for path in self.run_files().filter(|path| *path != own) {
            // Files are never incomplete; a file that does not describe a run is ignored.
            let Some(run) = read::<Run>(&path) else {
                continue;
            };
            let is_of_shards = is_shard && !path.ends_with(Run::FILE);
            let is_other_device = run.adapter != *adapter && !is_of_shards;
            if !replaces_all && (run.is_quick != is_quick || is_other_device) {
                let help = match is_shard {
                    true => "choose another folder with --out",
                    false => OTHER_FOLDER,
                };
                return Err(mixed(&path, &run, (adapter, is_quick), help));
            }
        }
        if !own.exists() {
            return Ok(None);
        }
        let Some(run) = read::<Run>(&own) else {
            return if force {
                Ok(None)
            } else {
                let help = "remove the file and measure again: points that are whole are kept";
                Err(Error::file(&own, "it is no complete record of a run", help))
            };
        };
        if force {
            return Ok(None);
        }
        if run.adapter != *adapter || run.is_quick != is_quick {
            return Err(mixed(&own, &run, (adapter, is_quick), OTHER_FOLDER));
        }
        Ok(Some(run))
    }

    /// The files that describe the run in the folder.
    fn run_files(&self) -> impl Iterator<Item = PathBuf> {
        let entries = std::fs::read_dir(&self.path).into_iter().flatten();
        let files = entries.flatten().map(|entry| entry.path());
        files.filter(|path| Run::is_file(path))
    }

    /// Writes the description of the run.
    pub(super) fn write_run(&self, run: &Run) -> Result<()> {
        write_json(&self.path.join(&self.run_file), run)
    }

    /// Writes the definition. Its `points` are the names of all records in the experiment's order, so that a reader of the
    /// folder can find missing and outdated records.
    pub(super) fn write_definition(&self, definition: &Definition, stems: &[String]) -> Result<()> {
        let synopsis = Synopsis {
            points: stems.to_vec(),
            ..definition.synopsis.clone()
        };
        let path = self.of(&definition.name).join("experiment.json");
        // All shards of a run would write the same.
        match read::<Synopsis>(&path) {
            Some(there) if there == synopsis => Ok(()),
            _ => write_json(&path, &synopsis),
        }
    }

    /// The record with this file name, if it has this identity and its pictures exist.
    pub(super) fn record(&self, experiment: &str, stem: &str, identity: &str) -> Option<Record> {
        let folder = self.of(experiment);
        let record: Record = read(&folder.join(format!("{stem}.json")))?;
        let is_there =
            |p: &RecordedPicture| p.is_beside() && p.files().all(|f| folder.join(f).is_file());
        let is_whole = record.pictures.iter().all(is_there);
        (record.format == Record::FORMAT && record.identity == identity && is_whole)
            .then_some(record)
    }

    /// Writes a point: first its pictures, then its record, so that no record names a missing picture.
    pub(super) fn write(&self, stem: &str, measured: &Measured) -> Result<()> {
        let folder = self.of(&measured.record.experiment);
        for (file, image) in &measured.pictures {
            write_file(&folder.join(file), &picture::png(image)?)?;
        }
        self.write_record(stem, &measured.record)
    }

    /// Writes the record of a point whose pictures are already written.
    pub(super) fn write_record(&self, stem: &str, record: &Record) -> Result<()> {
        let path = self.of(&record.experiment).join(format!("{stem}.json"));
        write_json(&path, record)
    }

    /// The record of hard cases, if it has this identity.
    pub(super) fn cases(&self, experiment: &str, run: &str, identity: &str) -> Option<CaseRecords> {
        let record: CaseRecords = read(&self.of(experiment).join(format!("{run}.cases.json")))?;
        (record.format == Record::FORMAT && record.identity == identity).then_some(record)
    }

    /// Writes the record of hard cases.
    pub(super) fn write_cases(&self, record: &CaseRecords) -> Result<()> {
        let path = self
            .of(&record.experiment)
            .join(format!("{}.cases.json", record.run));
        write_json(&path, record)
    }

    /// Records that this experiment no longer requests, each with its picture files. Files that are not records are
    /// skipped.
    pub(super) fn others(&self, experiment: &str, stems: &[String]) -> Vec<Vec<PathBuf>> {
        let folder = self.of(experiment);
        let entries = std::fs::read_dir(&folder).into_iter().flatten().flatten();
        let mut others = Vec::new();
        for path in entries.map(|e| e.path()) {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            let Some(stem) = name.strip_suffix(".json") else {
                continue;
            };
            if stems.iter().any(|s| s == stem) || stem == "experiment" {
                continue;
            }
            let pictures = match (read::<Record>(&path), read::<CaseRecords>(&path)) {
                (Some(record), _) => record.pictures,
                (None, Some(_)) => Vec::new(),
                (None, None) => continue,
            };
            let beside = pictures.iter().filter(|p| p.is_beside());
            let files = beside
                .flat_map(RecordedPicture::files)
                .map(|f| folder.join(f));
            others.push(files.chain([path.clone()]).collect());
        }
        others
    }

    fn of(&self, experiment: &str) -> PathBuf {
        self.path.join(experiment)
    }
}

/// Error for a run that must not be mixed with an existing one, because the adapter differs, or one is quick and the other full.
fn mixed(path: &Path, run: &Run, (adapter, is_quick): (&AdapterReport, bool), help: &str) -> Error {
    let word = |is_quick| if is_quick { "quick" } else { "in full" };
    let what = format!(
        "the folder holds a run on {} ({}), {}; this one is on {} ({}), {}",
        run.adapter.name,
        run.adapter.driver,
        word(run.is_quick),
        adapter.name,
        adapter.driver,
        word(is_quick)
    );
    Error::file(path, what, help)
}

/// Removes files; missing ones are ignored.
pub(super) fn remove(files: &[PathBuf]) -> Result<()> {
    for file in files {
        match std::fs::remove_file(file) {
            Err(e) if e.kind() != std::io::ErrorKind::NotFound => {
                let help = "check the folder's permissions";
                return Err(Error::file(file, format!("cannot be removed: {e}"), help));
            }
            _ => {}
        }
    }
    Ok(())
}

/// Content of a file, if it can be parsed.
fn read<T: DeserializeOwned>(path: &Path) -> Option<T> {
    let bytes = std::fs::read(path).ok()?;
    serde_json::from_slice(&bytes).ok()
}

fn write_json(path: &Path, value: &impl Serialize) -> Result<()> {
    let text = serde_json::to_string_pretty(value).map_err(|e| {
        Error::file(
            path,
            format!("cannot be written as JSON: {e}"),
            "report this",
        )
    })?;
    write_file(path, format!("{text}\n").as_bytes())
}
