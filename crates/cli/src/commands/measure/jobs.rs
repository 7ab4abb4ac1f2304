//! Jobs to measure: the points of all requested runs in order, all checked before the first one begins.

use std::collections::BTreeSet;
use std::path::PathBuf;

use cutaway::error::did_you_mean;
use cutaway::gpu::AdapterReport;
use cutaway::scene::glob_matches;
use cutaway::{Error, Result};
use cutaway_io::document::Value;
use cutaway_io::load::{Assets, Disk};
use cutaway_lab::experiment::definition::{Asked, AskedCases, AskedSearch, DefinedRun, SceneRun};
use cutaway_lab::experiment::run::file_stem;
use cutaway_lab::experiment::sweep::Point;
use cutaway_lab::experiment::{Definition, Identity};
use cutaway_lab::hard_cases::check_ids;

use super::MeasureArgs;
use super::folder::OutputFolder;
use crate::judge::quoted;
use crate::writing::places::InputFiles;

/// One job to measure.
pub(super) struct Job<'a> {
    /// Experiment of the job.
    pub(super) definition: &'a Definition,
    /// Run of the job.
    pub(super) run: &'a DefinedRun,
    /// Task of the job.
    pub(super) task: Task<'a>,
}

/// Task to measure.
pub(super) enum Task<'a> {
    /// A point of a run; the flag is true if the point's pictures are kept.
    Point(&'a SceneRun, &'a Point, bool),
    /// Hard cases.
    Cases(&'a AskedCases),
    Search(&'a AskedSearch),
}

impl Job<'_> {
    /// Description of the job: `01-paper, crank, amplitude = 1%`.
    pub(super) fn place(&self) -> String {
        let mut place = format!("{}, {}", self.definition.name, self.run.name);
        if let Task::Point(_, point, _) = self.task {
            for (name, value) in &point.parameters {
                place.push_str(&format!(", {name} = {value}"));
            }
        }
        place
    }

    /// The name of the job's record, without an extension.
    pub(super) fn stem(&self) -> String {
        match self.task {
            Task::Point(_, point, _) => file_stem(&self.run.name, point),
            Task::Cases(_) | Task::Search(_) => format!("{}.cases", self.run.name),
        }
    }

    /// The job's name for `--only`: the run, a colon, and the stem of the point's file names.
    fn address(&self) -> String {
        match self.task {
            Task::Point(_, point, _) if !point.stem.is_empty() => {
                format!("{}:{}", self.run.name, point.stem)
            }
            _ => self.run.name.clone(),
        }
    }

    /// Returns true if `--only` selects the job: by a glob for the run and, after a colon, a glob for the point.
    fn is_meant(&self, only: &str) -> bool {
        let (run, point) = only.split_once(':').unwrap_or((only, "*"));
        let stem = match self.task {
            Task::Point(_, point, _) => point.stem.as_str(),
            Task::Cases(_) | Task::Search(_) => "",
        };
        glob_matches(run, &self.run.name) && glob_matches(point, stem)
    }

    /// Adds the job's description to an error.
    pub(super) fn place_error(&self, error: Error) -> Error {
        let place = format!(
            "{}: run `{}`",
            self.definition.path.display(),
            self.run.name
        );
        error.within(&place)
    }

    /// Number of rounds, if the job is measured.
    pub(super) fn rounds(&self, args: &MeasureArgs) -> usize {
        match self.task {
            Task::Point(run, ..) => args.rounds.map_or(run.rounds, |n| n as usize),
            Task::Cases(_) | Task::Search(_) => 0,
        }
    }

    /// Cost of the job in drawn pixels, to compare jobs: the frames of every round, plus the reference, which counts as several frames.
    fn cost(&self, args: &MeasureArgs) -> f64 {
        const REFERENCE_ROUNDS: f64 = 20.0;
        match self.task {
            Task::Point(_, point, _) => {
                let side = |i: usize| {
                    let size = point.scene.get("resolution").ok()?;
                    match &size.items().get(i)?.value {
                        Value::Number(number) => Some(number.value),
                        _ => None,
                    }
                };
                let pixels = side(0).unwrap_or(1024.0) * side(1).unwrap_or(768.0);
                let frames = (self.rounds(args) + 1) * (point.trials.len() + 1);
                pixels * (frames as f64 + REFERENCE_ROUNDS)
            }
            Task::Cases(asked) => 1e6 * asked.cases.len().max(1) as f64,
            Task::Search(asked) => 1e6 * asked.scenes as f64,
        }
    }

    /// Command line that measures the job again.
    pub(super) fn command(&self, args: &MeasureArgs) -> String {
        let mut again = vec![
            "measure".to_owned(),
            self.definition.path.display().to_string(),
            format!("--only={}", self.address()),
        ];
        again.extend(args.quick.then(|| "--quick".to_owned()));
        again.extend(args.rounds.map(|n| format!("--rounds={n}")));
        again.push("--out=target/again".to_owned());
        again.extend(
            args.device
                .adapter
                .as_ref()
                .map(|a| format!("--adapter={a}")),
        );
        quoted(again.into_iter())
    }

    /// Identity of the job's record.
    pub(super) fn identity(
        &self,
        program: &str,
        adapter: &AdapterReport,
        args: &MeasureArgs,
    ) -> String {
        let mut identity = Identity::default();
        identity.add(env!("CARGO_PKG_VERSION"));
        identity.add(program);
        identity.add(format!("{adapter:?} {}", args.quick));
        identity.add(&self.run.name);
        match self.task {
            Task::Point(run, point, keeps_pictures) => {
                identity.add_document(&point.scene);
                identity.add("truth");
                if let Some(truth) = &point.truth {
                    identity.add_document(truth);
                }
                for trial in &point.trials {
                    identity.add(format!("{} {:?}", trial.renderer, trial.families));
                }
                let rounds = self.rounds(args);
                identity.add(format!("{:?} {keeps_pictures} {rounds}", point.parameters));
                // Expectations are left out: if they change, the record is compared with them without measuring again.
                identity.add(format!("{:?}", run.drift));
            }
            Task::Cases(asked) => identity.add(format!("{asked:?}")),
            Task::Search(asked) => identity.add(format!("{asked:?}")),
        }
        identity.text()
    }
}

/// Rejects a folder where records would replace the experiments' own files, or files that their points refer to.
pub(super) fn keep_inputs(
    definitions: &[Definition],
    jobs: &[Job<'_>],
    folder: &OutputFolder,
    is_quick: bool,
) -> Result<()> {
    let files = InputFiles::default();
    files.add(definitions.iter().map(|d| d.path.clone()));
    for job in jobs {
        if let Task::Point(_, point, _) = job.task {
            let scenes = std::iter::once(&point.scene).chain(&point.truth);
            scenes.for_each(|scene| files.add(scene.files(&Disk)));
        }
    }
    for definition in definitions {
        let stems = stems(definition, is_quick);
        let replaced = folder.replaced(&definition.name, &stems).into_iter();
        files.keep_from(replaced.map(|path| ("--out", path)))?;
    }
    Ok(())
}

/// Reads the experiments from files; rejects duplicate names.
pub(super) fn load(paths: &[PathBuf]) -> Result<Vec<Definition>> {
    let mut names = BTreeSet::new();
    let mut all = Vec::new();
    for path in paths {
        let definition = Definition::load(path)?;
        if !names.insert(definition.name.clone()) {
            return Err(Error::file(
                path,
                format!("another experiment is called `{}`", definition.name),
                "rename one of the files: records are stored under the file's name",
            ));
        }
        all.push(definition);
    }
    Ok(all)
}

/// All jobs of some experiments; an error if a scene names something that does not exist.
pub(super) fn jobs<'a>(definitions: &'a [Definition], args: &MeasureArgs) -> Result<Vec<Job<'a>>> {
    let mut jobs: Vec<Job<'_>> = definitions
        .iter()
        .flat_map(|d| d.runs.iter().flat_map(|r| of_run(d, r, args.quick)))
        .collect();
    if let Some(only) = &args.only {
        must_mean_a_job(only, &jobs)?;
        jobs.retain(|j| j.is_meant(only));
    }
    if let Some(shard) = args.shard {
        let costs: Vec<f64> = jobs.iter().map(|j| j.cost(args)).collect();
        let own = shard.of_costs(&costs);
        let mut index = 0;
        jobs.retain(|_| {
            index += 1;
            own.binary_search(&(index - 1)).is_ok()
        });
    }
    let assets = Assets::default();
    for job in &jobs {
        let checked = match job.task {
            Task::Point(_, point, _) => {
                let mut all = std::iter::once(&point.scene).chain(&point.truth);
                all.try_for_each(|scene| scene.check(&assets))
            }
            Task::Cases(asked) => check_ids(&asked.cases),
            Task::Search(_) => Ok(()),
        };
        checked.map_err(|e| job.place_error(e))?;
    }
    Ok(jobs)
}

/// Rejects an `--only` value that matches no job.
fn must_mean_a_job(only: &str, jobs: &[Job<'_>]) -> Result<()> {
    if jobs.iter().any(|j| j.is_meant(only)) {
        return Ok(());
    }
    let (run, point) = only.split_once(':').unwrap_or((only, "*"));
    let of_run: Vec<&Job<'_>> = (jobs.iter())
        .filter(|j| glob_matches(run, &j.run.name))
        .collect();
    let fault = |what: &str, help: String| Error::input(format!("--only {only}"), what, help);
    if of_run.is_empty() {
        let names: BTreeSet<&str> = jobs.iter().map(|j| j.run.name.as_str()).collect();
        return Err(fault("no run has that name", did_you_mean(run, names)));
    }
    let addresses: BTreeSet<String> = of_run.iter().map(|j| j.address()).collect();
    let stems = addresses
        .iter()
        .map(|a| a.split_once(':').map_or("*", |(_, stem)| stem));
    let help = did_you_mean(point, stems);
    Err(fault(
        "no point of the run has a file name that matches",
        help,
    ))
}

/// All jobs of a run.
pub(super) fn of_run<'a>(
    definition: &'a Definition,
    run: &'a DefinedRun,
    is_quick: bool,
) -> Vec<Job<'a>> {
    let tasks: Vec<Task<'_>> = match run.asked(is_quick) {
        Asked::Scenes(scenes) => (scenes.points.iter().enumerate())
            .map(|(i, point)| {
                let keeps_pictures = scenes.pictures.are_kept(i, scenes.points.len());
                Task::Point(scenes, point, keeps_pictures)
            })
            .collect(),
        Asked::Cases(asked) => vec![Task::Cases(asked)],
        Asked::Search(asked) => vec![Task::Search(asked)],
    };
    let job = |task| Job {
        definition,
        run,
        task,
    };
    tasks.into_iter().map(job).collect()
}

/// Identity of this program: a hash of its executable.
pub(super) fn program() -> String {
    let mut identity = Identity::default();
    match std::env::current_exe() {
        Ok(path) => identity.add_file(&path),
        Err(_) => identity.add(""),
    }
    identity.text()
}

/// Descriptions of jobs, one line each, with their methods.
pub(super) fn listed(jobs: &[Job<'_>], args: &MeasureArgs) -> String {
    let mut text = String::new();
    for job in jobs {
        text.push_str(&job.place());
        match job.task {
            Task::Point(_, point, _) => {
                let names: Vec<String> = point
                    .trials
                    .iter()
                    .map(|e| e.renderer.to_string())
                    .collect();
                text.push_str(&format!(
                    ": {} rounds of {}\n  {}\n",
                    job.rounds(args),
                    names.join(", "),
                    job.command(args)
                ));
            }
            Task::Cases(asked) => {
                text.push_str(&format!(": hard cases {}\n", asked.cases.join(", ")))
            }
            Task::Search(asked) => text.push_str(&format!(": {} random scenes\n", asked.scenes)),
        }
    }
    text
}

/// Names of all records that an experiment requests, in its order.
pub(super) fn stems(definition: &Definition, is_quick: bool) -> Vec<String> {
    let jobs = definition
        .runs
        .iter()
        .flat_map(|r| of_run(definition, r, is_quick));
    jobs.map(|j| j.stem()).collect()
}
