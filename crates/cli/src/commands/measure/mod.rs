//! `measure`: runs experiments and writes a record of each point.
//!
//! Files, names, strategies, values and outputs are checked before the first point is measured. A point with an up-to-date record
//! on disk is kept, so that an interrupted run, or an extended experiment, goes on where it stopped.

mod cases;
mod folder;
mod jobs;
mod machine;
mod tally;
mod watching;

use std::path::PathBuf;

use clap::Args;
use cutaway::Result;
use cutaway::gpu::Gpu;
use cutaway::session::Session;
use cutaway_lab::experiment::expect::judge_again;
use cutaway_lab::experiment::run::{Assignment, measure};
use cutaway_lab::experiment::{
    CaseRecords, Invocation, Machine, Reached, Record, Run, Stopwatch, Watcher,
};

use crate::console::{Console, ConsoleArgs};
use crate::input::args::AdapterArgs;
use crate::input::shard::Shard;
use crate::interrupt::Interrupt;
use crate::judge::command_line;
use crate::verdict::Verdict;
use crate::writing::output::write_stdout;
use folder::OutputFolder;
use jobs::{Job, Task};
use tally::JobTally;
use watching::Watching;

pub(crate) const EXAMPLES: &str = "\
Examples:
  cutaway measure experiments/curated/01-paper.toml
  cutaway measure experiments/curated/*.toml --quick --out target/measure
  cutaway measure experiments/curated/*.toml --dry-run
  cutaway measure mine.toml --only crank --rounds 25 --out target/mine
  cutaway measure mine.toml --shard auto/16 --out shared/mine        # a task of an array: experiments/cluster

Ctrl-C ends the command after the present round. Run the same command again to continue where it stopped.
Exit codes: 0 done; 1 done, but an expectation failed; 2 bad input or usage; 130 ended by Ctrl-C or SIGTERM.";

/// Options of `measure`.
#[derive(Args)]
pub(crate) struct MeasureArgs {
    /// Experiments (.toml)
    #[arg(required = true, value_name = "EXPERIMENT")]
    pub(crate) experiments: Vec<PathBuf>,
    /// Folder for the records and pictures
    #[arg(long, value_name = "DIR", default_value = "target/measure")]
    pub(crate) out: PathBuf,
    /// Use the smaller numbers of pixels, values and rounds that the experiments define for quick runs
    #[arg(long)]
    pub(crate) quick: bool,
    /// Measure points again that are already measured
    #[arg(long)]
    pub(crate) force: bool,
    /// Remove records of points that the experiments no longer contain
    #[arg(long)]
    pub(crate) prune: bool,
    /// Only list the points to measure; needs no graphics adapter
    #[arg(long)]
    pub(crate) dry_run: bool,
    /// Measure only runs with this name and, after a colon, only points with this file name; * matches anything
    #[arg(long, value_name = "RUN[:POINT]")]
    pub(crate) only: Option<String>,
    /// Number of measured rounds, after one warm-up round [default: as the experiments define]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=10_000))]
    pub(crate) rounds: Option<u32>,
    /// Measure only one share of the points, into a folder common to all shares: 0/8 to 7/8; auto takes the share from the array task (Slurm and others); use auto/8 if only some of 8 tasks are resubmitted
    #[arg(long, value_name = "I/N|auto", conflicts_with_all = ["prune"])]
    pub(crate) shard: Option<Shard>,
    #[command(flatten)]
    pub(crate) device: AdapterArgs,
    #[command(flatten)]
    pub(crate) console: ConsoleArgs,
}

/// Runs `measure`.
pub(crate) fn run(args: &MeasureArgs) -> Result<Verdict> {
    let definitions = jobs::load(&args.experiments)?;
    let jobs = jobs::jobs(&definitions, args)?;
    if args.dry_run {
        write_stdout(jobs::listed(&jobs, args).as_bytes())?;
        return Ok(Verdict::Done);
    }
    let folder = OutputFolder::checked(&args.out, args.shard)?;
    jobs::keep_inputs(&definitions, &jobs, &folder, args.quick)?;
    let machine = machine::machine();
    let gpu = args.device.open()?;
    let earlier = folder.earlier(gpu.report(), args.quick, args.force)?;
    let steps: usize = jobs.iter().map(|j| steps(j, args)).sum();
    let console = Console::new(args.console, steps);
    console.show_what_is_left();
    let run = run_of(&gpu, earlier, machine.clone(), args.quick);
    let mut work = InvocationState {
        invocation: Invocation {
            began: machine::now(),
            load: machine.load,
            command: run.command.clone(),
            adapter: Some(run.adapter.clone()),
            version: Some(run.version.clone()),
            commit: run.commit.clone(),
            ..machine::place(args.shard)
        },
        args,
        folder,
        run,
        machine,
        program: jobs::program(),
        interrupt: Interrupt::listen("measure", "round")?,
        watch: Stopwatch::start(),
        session: Session::new(gpu),
        console,
    };
    let took_before_s = work.run.took_s;
    let mut tally = JobTally::of(&jobs);
    let mut began: Vec<&str> = Vec::new();
    for job in &jobs {
        if !began.contains(&job.definition.name.as_str()) {
            began.push(&job.definition.name);
            work.begin(job)?;
        }
        let is_complete = work
            .do_job(job, &mut tally)
            .map_err(|e| job.place_error(e))?;
        work.run.took_s = took_before_s + work.watch.ms() / 1e3;
        work.folder.write_run(&work.run)?;
        if !is_complete {
            break;
        }
    }
    drop(work.console);
    write_stdout(tally.text(&jobs, args).as_bytes())?;
    Ok(tally.verdict(jobs.len()))
}

/// Number of progress steps of a job.
fn steps(job: &Job<'_>, args: &MeasureArgs) -> usize {
    match job.task {
        Task::Point(run, point, _) => run.steps(point, job.rounds(args)),
        Task::Cases(_) | Task::Search(_) => 1,
    }
}

/// Description of the run. A continued run keeps its start time.
fn run_of(gpu: &Gpu, earlier: Option<Run>, machine: Machine, is_quick: bool) -> Run {
    let (began, took_s) = match earlier {
        Some(run) => (run.began, run.took_s),
        None => (machine::now(), 0.0),
    };
    Run {
        format: Record::FORMAT,
        command: command_line(),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        commit: machine::commit(),
        began,
        took_s,
        is_quick,
        machine,
        adapter: gpu.report().clone(),
        limits: gpu.limits().by_name(),
    }
}

/// State of one invocation.
struct InvocationState<'a> {
    invocation: Invocation,
    args: &'a MeasureArgs,
    folder: OutputFolder,
    run: Run,
    machine: Machine,
    program: String,
    interrupt: Interrupt,
    watch: Stopwatch,
    session: Session,
    console: Console,
}

impl InvocationState<'_> {
    /// Begins an experiment.
    fn begin(&self, job: &Job<'_>) -> Result<()> {
        let definition = job.definition;
        self.folder.write_run(&self.run)?;
        let stems = jobs::stems(definition, self.args.quick);
        self.folder.write_definition(definition, &stems)?;
        if self.args.quick && !definition.runs.iter().any(|r| r.has_quick) {
            let name = &definition.name;
            let text = format!("{name}: --quick changes nothing: no run has a [run.quick]");
            self.console.note(text);
        }
        let others = self.folder.others(&definition.name, &stems);
        if others.is_empty() {
            return Ok(());
        }
        let (what, are) = match others.len() {
            1 => ("1 record of a point".to_owned(), "is"),
            n => (format!("{n} records of points"), "are"),
        };
        let name = &definition.name;
        if self.args.prune {
            others.iter().try_for_each(|files| folder::remove(files))?;
            let text = format!("{name}: removed {what} that it no longer has");
            self.console.note(text);
        } else {
            self.console.note(format!(
                "{name}: {what} that it no longer has {are} left as before\n  help: --prune removes records that no experiment asks for"
            ));
        }
        Ok(())
    }

    /// Measures a job, or keeps its record. Returns false if the work is to end.
    fn do_job(&mut self, job: &Job<'_>, tally: &mut JobTally) -> Result<bool> {
        if self.interrupt.is_wanted() {
            tally.interrupted = true;
            return Ok(false);
        }
        let identity = job.identity(&self.program, self.session.gpu().report(), self.args);
        let kept = (!self.args.force)
            .then(|| self.kept(job, &identity))
            .transpose()?
            .flatten();
        if let Some(reached) = kept {
            self.console.skip(steps(job, self.args));
            self.console.detail(format!("{}: kept", job.place()));
            let watching = Watching::of(job, &self.console, &self.interrupt);
            reached.iter().for_each(|r| watching.reached(r));
            tally.add(job, true, &reached);
            return Ok(true);
        }
        let reached = match job.task {
            Task::Point(..) => self.point(job, identity, tally)?,
            Task::Cases(_) | Task::Search(_) => self.cases(job, identity)?,
        };
        match reached {
            Some(reached) => {
                tally.add(job, false, &reached);
                self.say_how_far(job, tally);
            }
            None if self.interrupt.is_wanted() => tally.interrupted = true,
            None => tally.missing(job),
        }
        Ok(!tally.interrupted)
    }

    /// Prints a progress line after each point, for the log of an unattended run.
    fn say_how_far(&self, job: &Job<'_>, tally: &JobTally) {
        let (name, run) = (&job.definition.name, &job.run.name);
        let [complete, asked] = tally.of_run(job);
        let s = self.watch.ms() / 1e3;
        self.console.milestone(format!(
            "{name}, {run}: {complete} of {asked} points, {s:.0} s"
        ));
    }

    /// Checks the kept record of a job against the present expectations.
    fn kept(&self, job: &Job<'_>, identity: &str) -> Result<Option<Vec<Reached>>> {
        let experiment = &job.definition.name;
        let Task::Point(run, point, _) = job.task else {
            let record = self.folder.cases(experiment, &job.run.name, identity);
            let reached = |r: CaseRecords| r.cases.into_iter().flat_map(|c| c.expectations);
            return Ok(record.map(|r| reached(r).collect()));
        };
        let Some(mut record) = self.folder.record(experiment, &job.stem(), identity) else {
            return Ok(None);
        };
        if judge_again(run, point, &mut record) {
            self.folder.write_record(&job.stem(), &record)?;
        }
        Ok(Some(record.expectations))
    }

    fn point(
        &mut self,
        job: &Job<'_>,
        identity: String,
        tally: &mut JobTally,
    ) -> Result<Option<Vec<Reached>>> {
        let Task::Point(run, point, keeps_pictures) = job.task else {
            return Ok(None);
        };
        let assignment = Assignment {
            experiment: &job.definition.name,
            run_name: &job.run.name,
            run,
            point,
            rounds: job.rounds(self.args),
            is_quick: self.args.quick,
            keeps_pictures,
            identity,
            command: job.command(self.args),
            machine: &self.machine,
            invocation: &self.invocation,
        };
        self.console.detail(job.place());
        let watching = Watching::of(job, &self.console, &self.interrupt);
        let measured = measure(&mut self.session, &assignment, &watching)?;
        let Some(measured) = measured else {
            tally.lost = Some(watching.lost(steps(job, self.args), assignment.rounds));
            return Ok(None);
        };
        self.folder.write(&job.stem(), &measured)?;
        Ok(Some(measured.record.expectations))
    }

    fn cases(&mut self, job: &Job<'_>, identity: String) -> Result<Option<Vec<Reached>>> {
        self.console.step(job.place());
        let console = &self.console;
        let mut step = |what: String| console.detail(what);
        let interrupt = &self.interrupt;
        let goes_on = || !interrupt.is_wanted();
        let (cases, sizes_px) = match job.task {
            Task::Cases(asked) => {
                let cases = cases::cases(&mut self.session, asked, &mut step, &goes_on)?;
                (cases, cases::sizes_px(asked))
            }
            Task::Search(asked) => (
                cases::search(&mut self.session, asked, &mut step, &goes_on)?,
                Vec::new(),
            ),
            Task::Point(..) => return Ok(None),
        };
        self.session.forget();
        let Some(cases) = cases else {
            return Ok(None);
        };
        let record = CaseRecords {
            format: Record::FORMAT,
            experiment: job.definition.name.clone(),
            run: job.run.name.clone(),
            identity,
            sizes_px,
            cases,
            invocation: Some(self.invocation.clone()),
        };
        self.folder.write_cases(&record)?;
        let reached: Vec<Reached> = record
            .cases
            .into_iter()
            .flat_map(|c| c.expectations)
            .collect();
        let watching = Watching::of(job, &self.console, &self.interrupt);
        reached.iter().for_each(|r| watching.reached(r));
        Ok(Some(reached))
    }
}
