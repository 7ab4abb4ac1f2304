//! A folder that holds a whole run, shards of a run, or only outside baselines.

use std::path::{Path, PathBuf};

use cutaway::gpu::AdapterReport;
use cutaway::{Error, Result};

use super::{MISSING, PeerRecord, read_json, read_numbered};
use crate::experiment::{CaseRecords, Invocation, Record, Run, Synopsis};
use crate::report::derived::{invocations, natural};

/// A folder of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Folder {
    /// Path of the folder.
    pub path: PathBuf,
    /// Machine and program of the run; `None` if the folder holds only outside baselines.
    pub run: Option<Run>,
    /// The experiments, sorted by name.
    pub experiments: Vec<Experiment>,
    /// Outside baselines, sorted by file name.
    pub peers: Vec<PeerRecord>,
}

/// An experiment and its records.
#[derive(Clone, Debug, PartialEq)]
pub struct Experiment {
    /// Definition of the experiment.
    pub synopsis: Synopsis,
    /// Its points, in the order in which the definition lists the runs and the points of each run. In each run, points that the definition
    /// does not list come last, sorted by their parameters.
    pub records: Vec<Record>,
    /// Results of hard cases and searches.
    pub cases: Vec<CaseRecords>,
    /// Names of points that the definition lists but that have no record.
    pub missing: Vec<String>,
}

/// File whose presence marks a folder as that of an experiment.
const EXPERIMENT_FILE: &str = "experiment.json";
/// The folder of outside baselines.
const PEERS_FOLDER: &str = "peers";

impl Folder {
    /// Reads a folder into one [`Folder`] for each combination of device and program that measured it, as its shards may have run on
    /// several devices and with several programs.
    pub(super) fn read(path: &Path) -> Result<Vec<Self>> {
        if path.is_file() {
            return Err(Error::file(path, "it is a file, not a folder", MISSING));
        }
        if !path.is_dir() {
            return Err(Error::file(path, "there is no such folder", MISSING));
        }
        let runs = runs(path)?;
        if runs.is_empty() {
            let peers = peers_alone(path)?;
            if !peers.is_empty() {
                return Ok(vec![Self {
                    path: path.to_owned(),
                    run: None,
                    experiments: Vec::new(),
                    peers,
                }]);
            }
            let what = format!(
                "there is no run in this folder: {} is missing, and there are no outside baselines",
                path.join(Run::FILE).display()
            );
            return Err(Error::file(path, what, MISSING));
        }
        let mut experiments = Vec::new();
        let mut peers = Vec::new();
        for entry in entries(path)?.into_iter().filter(|e| e.is_dir()) {
            if entry.file_name().is_some_and(|n| n == PEERS_FOLDER) {
                peers.extend(peers_in(&entry)?);
                continue;
            }
            // Other folders hold something else, such as another report.
            if !entry.join(EXPERIMENT_FILE).is_file() {
                continue;
            }
            experiments.push(Experiment::read(&entry, &runs)?);
        }
        experiments.sort_by(|a, b| a.synopsis.name.cmp(&b.synopsis.name));
        let several = runs.len() > 1;
        let folder = |(index, run): (usize, Run)| {
            let is_of = |invocation: &Option<Invocation>| {
                let maker = invocation.as_ref().and_then(Maker::of_invocation);
                !several || maker.map_or(index == 0, |maker| maker == Maker::of_run(&run))
            };
            let own = experiments.iter().map(|all| Experiment {
                synopsis: all.synopsis.clone(),
                records: (all.records.iter())
                    .filter(|r| is_of(&r.invocation))
                    .cloned()
                    .collect(),
                cases: (all.cases.iter())
                    .filter(|c| is_of(&c.invocation))
                    .cloned()
                    .collect(),
                missing: all.missing.clone(),
            });
            Self {
                path: path.to_owned(),
                experiments: own.collect(),
                peers: match index {
                    0 => peers.clone(),
                    _ => Vec::new(),
                },
                run: Some(run),
            }
        };
        Ok(runs.into_iter().enumerate().map(folder).collect())
    }

    /// The commands that measured the folder, the earliest first, each with the number of points it measured.
    pub(in crate::report) fn invocations(&self) -> Vec<(Invocation, usize)> {
        let records = self.experiments.iter().flat_map(|e| &e.records);
        let run = self.run.as_ref();
        run.map_or_else(Vec::new, |run| invocations(run, records))
    }

    /// The folder of an experiment's pictures.
    pub fn pictures(&self, experiment: &Experiment) -> PathBuf {
        self.path.join(&experiment.synopsis.name)
    }
}

/// Device and program that measured figures; figures of different makers are never combined.
#[derive(PartialEq)]
struct Maker<'a> {
    adapter: &'a AdapterReport,
    version: &'a str,
    commit: Option<&'a str>,
}

impl<'a> Maker<'a> {
    fn of_run(run: &'a Run) -> Self {
        Self {
            adapter: &run.adapter,
            version: &run.version,
            commit: run.commit.as_deref(),
        }
    }

    /// The device and program of a command; `None` if its record is older than the fields that hold them.
    fn of_invocation(invocation: &'a Invocation) -> Option<Self> {
        Some(Self {
            adapter: invocation.adapter.as_ref()?,
            version: invocation.version.as_deref()?,
            commit: invocation.commit.as_deref(),
        })
    }
}

/// Reads all outside baselines in a folder.
fn peers_in(folder: &Path) -> Result<Vec<PeerRecord>> {
    let files = json_files(folder)?;
    let read = files.iter().map(|f| read_numbered(f, PeerRecord::FORMAT));
    read.collect()
}

/// The outside baselines of a folder without a run: those in its subfolder `peers`, or else those in the folder itself. If the folder has
/// experiments, `run.json` is lost: then nothing is returned, so that the missing run is reported.
fn peers_alone(path: &Path) -> Result<Vec<PeerRecord>> {
    let has_points = |entry: &PathBuf| entry.join(EXPERIMENT_FILE).is_file();
    if entries(path)?.iter().any(has_points) {
        return Ok(Vec::new());
    }
    let below = path.join(PEERS_FOLDER);
    if below.is_dir() {
        return peers_in(&below);
    }
    let is_baseline = |file: &PathBuf| {
        let value = read_json::<serde_json::Value>(file);
        value.is_ok_and(|v| v.get("what").is_some() && v.get("rows").is_some())
    };
    let files = json_files(path)?.into_iter().filter(is_baseline);
    files
        .map(|f| read_numbered(&f, PeerRecord::FORMAT))
        .collect()
}

/// The runs of a folder, read from `run.json` or from the file of each shard. Runs with the same device and program are merged.
fn runs(path: &Path) -> Result<Vec<Run>> {
    let mut runs: Vec<Run> = Vec::new();
    for file in json_files(path)?.iter().filter(|file| Run::is_file(file)) {
        let run: Run = read_numbered(file, Record::FORMAT)?;
        match runs
            .iter_mut()
            .find(|r| Maker::of_run(r) == Maker::of_run(&run))
        {
            Some(same) => {
                same.took_s += run.took_s;
                same.is_quick |= run.is_quick;
                if run.began < same.began {
                    same.began = run.began;
                }
            }
            None => runs.push(run),
        }
    }
    Ok(runs)
}

impl Experiment {
    /// Reads the part of an experiment that the given runs measured. If there are several runs, points that none of them measured count
    /// as missing, for example because the file of their run was overwritten.
    fn read(path: &Path, runs: &[Run]) -> Result<Self> {
        let is_of_a_run = |invocation: &Option<Invocation>| {
            let maker = invocation.as_ref().and_then(Maker::of_invocation);
            let mut makers = runs.iter().map(Maker::of_run);
            runs.len() == 1 || maker.is_none_or(|maker| makers.any(|run| run == maker))
        };
        let synopsis: Synopsis = read_json(&path.join(EXPERIMENT_FILE))?;
        let mut records: Vec<(usize, Record)> = Vec::new();
        let mut cases: Vec<CaseRecords> = Vec::new();
        let mut missing = synopsis.points.clone();
        for file in json_files(path)? {
            let stem = file.file_stem().unwrap_or_default().to_string_lossy();
            let place = synopsis.points.iter().position(|point| *point == stem);
            let name = file.file_name().unwrap_or_default().to_string_lossy();
            if name == EXPERIMENT_FILE {
                continue;
            }
            let experiment = if name.ends_with(".cases.json") {
                let found: CaseRecords = read_numbered(&file, Record::FORMAT)?;
                if !is_of_a_run(&found.invocation) {
                    continue;
                }
                missing.retain(|point| *point != stem);
                cases.push(found);
                cases.last().map(|c| &c.experiment)
            } else {
                let record: Record = read_numbered(&file, Record::FORMAT)?;
                if !is_of_a_run(&record.invocation) {
                    continue;
                }
                missing.retain(|point| *point != stem);
                is_at_one(&file, &record)?;
                records.push((place.unwrap_or(synopsis.points.len()), record));
                records.last().map(|(_, r)| &r.experiment)
            };
            if experiment != Some(&synopsis.name) {
                return Err(Error::file(
                    &file,
                    format!(
                        "it belongs to experiment `{}`, but is in the folder of `{}`",
                        experiment.map_or("", String::as_str),
                        synopsis.name
                    ),
                    "move it to its experiment's folder, or measure again",
                ));
            }
        }
        records.sort_by(|(a_place, a), (b_place, b)| {
            let of_run = |r: &Record| synopsis.place_of(&r.run);
            let values = a.parameters.values().zip(b.parameters.values());
            let by_values = values.map(|(a, b)| natural(&a.to_string(), &b.to_string()));
            (of_run(a).cmp(&of_run(b)))
                .then_with(|| a.run.cmp(&b.run))
                .then(a_place.cmp(b_place))
                .then_with(|| by_values.fold(std::cmp::Ordering::Equal, |o, by| o.then(by)))
        });
        cases.sort_by_key(|c| synopsis.place_of(&c.run));
        Ok(Self {
            synopsis,
            records: records.into_iter().map(|(_, record)| record).collect(),
            cases,
            missing,
        })
    }
}

/// Checks that each list of a record has one entry per strategy, and that its pictures are in the record's folder.
fn is_at_one(file: &Path, record: &Record) -> Result<()> {
    if let Some(stray) = record.pictures.iter().find(|p| !p.is_beside()) {
        return Err(Error::file(
            file,
            format!("the picture `{}` is not in the record's folder", stray.file),
            "remove the file and measure again: points that are whole are kept",
        ));
    }
    let strategies = record.measurement.strategies.len();
    for (what, count) in [
        (
            "makers",
            record.families.iter().filter(|m| !m.is_empty()).count(),
        ),
        ("figures", record.figures.len()),
    ] {
        if count != strategies {
            return Err(Error::file(
                file,
                format!("`{what}` has {count} entries for {strategies} strategies"),
                "remove the file and measure again: points that are whole are kept",
            ));
        }
    }
    Ok(())
}

/// Entries of a folder, sorted by name. Hidden files are left out, as unfinished files are hidden.
fn entries(folder: &Path) -> Result<Vec<PathBuf>> {
    let unreadable = |e: std::io::Error| {
        Error::file(
            folder,
            format!("cannot be read: {e}"),
            "check the folder's permissions",
        )
    };
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(unreadable)? {
        let entry = entry.map_err(unreadable)?;
        if !entry.file_name().to_string_lossy().starts_with('.') {
            found.push(entry.path());
        }
    }
    found.sort();
    Ok(found)
}

fn json_files(folder: &Path) -> Result<Vec<PathBuf>> {
    let mut files = entries(folder)?;
    files.retain(|f| f.is_file() && f.extension().is_some_and(|e| e == "json"));
    Ok(files)
}
