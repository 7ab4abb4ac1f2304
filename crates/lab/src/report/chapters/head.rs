//! Notices about the whole report, placed at its beginning, and the list of runs with their machines.

use super::figures::counted;
use super::point::Points;
use super::{pictures, warnings};
use crate::experiment::Run;
use crate::report::document::{Cell, Grid, ReportBlock, Tone};
use crate::report::recorded::{Experiment, Folder, RecordedFolders};

/// The number of measurements, missing points, missed expectations, and warnings that concern all figures.
pub(super) fn notices(
    recorded: &RecordedFolders,
    points: &Points<'_>,
    pictures: &pictures::Galleries,
) -> Vec<ReportBlock> {
    let experiments = points.by_experiment().len();
    let strategies: usize = (points.all.iter())
        .map(|p| p.record.measurement.strategies.len())
        .sum();
    if points.all.is_empty() && recorded.folders.iter().all(|f| f.run.is_none()) {
        let peers = recorded.folders.iter().map(|f| f.peers.len()).sum();
        let mut blocks = vec![ReportBlock::Text(format!(
            "{} with other tools. The report has no measurements of our own other than those in the comparisons.",
            counted(peers, "comparison")
        ))];
        blocks.extend(reached(recorded));
        return blocks;
    }
    let mut blocks = vec![ReportBlock::Text(format!(
        "{} with {}; {} of strategies, each compared at every pixel with an exact reference in double precision, \
         and timed in the same rounds as the plain drawing of the uncut scene (\"draw only\"), to which all ratios refer.",
        counted(experiments, "experiment"),
        counted(points.all.len(), "point"),
        counted(strategies, "measurement"),
    ))];
    for folder in &recorded.folders {
        let lacking = folder.experiments.iter();
        blocks.extend(lacking.flat_map(|e| missing(folder, e)));
    }
    blocks.extend(reached(recorded));
    let runs: Vec<&Run> = recorded
        .folders
        .iter()
        .filter_map(|f| f.run.as_ref())
        .collect();
    let are_quick = runs.iter().filter(|run| run.is_quick).count();
    if are_quick > 0 {
        blocks.push(ReportBlock::Notice(
            Tone::Fair,
            format!(
                "{} with `--quick`: fewer pixels, values and rounds. Errors are those of the smaller pictures, and times scatter more.",
                if are_quick == runs.len() { "Measured" } else { "Partly measured" }
            ),
        ));
    }
    for folder in &recorded.folders {
        let place = match recorded.folders.len() {
            1 => String::new(),
            _ => format!(" ({})", folder.path.display()),
        };
        let common = warnings::notices(points.common(folder)).into_iter();
        blocks.extend(common.map(|block| match block {
            ReportBlock::Notice(tone, text) => {
                ReportBlock::Notice(tone, format!("All points{place}: {text}"))
            }
            other => other,
        }));
    }
    blocks.extend(pictures.gone());
    blocks
}

/// For each folder, the machine and the commands that produced its measurements.
pub(super) fn chapter(recorded: &RecordedFolders) -> Vec<ReportBlock> {
    if recorded.folders.iter().all(|f| f.run.is_none()) {
        return Vec::new();
    }
    vec![
        ReportBlock::Grid(facts(recorded)),
        ReportBlock::Text(
            "Points are counted for the command that measured them; hard cases are not counted. The last command may show 0 because all of its points had already been measured."
                .to_owned(),
        ),
        ReportBlock::Grid(commands(recorded)),
    ]
}

/// A row for each command of each folder.
fn commands(recorded: &RecordedFolders) -> Grid {
    let heading = ["folder", "began", "load before", "points", "command"];
    let mut grid = Grid::new("the commands that made the measurements", heading);
    for folder in &recorded.folders {
        for (invocation, points) in folder.invocations() {
            let load = invocation
                .load
                .map_or_else(Cell::default, |l| Cell::number(format!("{l:.2}"), l));
            grid.row([
                Cell::from(folder.path.display().to_string()),
                Cell::from(invocation.began),
                load,
                Cell::number(points.to_string(), points as f64),
                Cell::from(format!("`{}`", invocation.command)),
            ]);
        }
    }
    grid
}

/// Notice of how many expectations were reached: at points, in hard cases, and for areas of outside baselines. `None` if there are none
/// so far and points are still missing.
fn reached(recorded: &RecordedFolders) -> Option<ReportBlock> {
    let experiments = || recorded.folders.iter().flat_map(|f| &f.experiments);
    let of_points = experiments().flat_map(|e| e.records.iter().flat_map(|r| &r.expectations));
    let of_cases = experiments()
        .flat_map(|e| &e.cases)
        .flat_map(|c| c.cases.iter().flat_map(|c| &c.expectations));
    let (mut all, mut missed) = (0, 0);
    let of_peers = (recorded.folders.iter())
        .flat_map(|f| &f.peers)
        .flat_map(|p| p.checks.iter().map(|c| c.holds));
    let of_ours = of_points.chain(of_cases).map(|r| r.holds);
    for holds in of_ours.chain(of_peers) {
        all += 1;
        missed += usize::from(!holds);
    }
    let is_whole = experiments().all(|e| e.missing.is_empty());
    let block = match (all, missed) {
        (0, _) if !is_whole => return None,
        (0, _) => ReportBlock::Notice(
            Tone::Plain,
            "Nothing was expected of these measurements.".to_owned(),
        ),
        (all, 0) => {
            ReportBlock::Notice(Tone::Good, format!("All {all} expectations were reached."))
        }
        (all, missed) => ReportBlock::Notice(
            Tone::Bad,
            format!(
                "{missed} of {all} expectations were missed; each is marked at its point or case."
            ),
        ),
    };
    Some(block)
}

/// The points of an experiment in a folder that are not measured yet, and the commands that measure them; empty if all are measured.
pub(super) fn missing(folder: &Folder, experiment: &Experiment) -> Vec<ReportBlock> {
    let lacking = &experiment.missing;
    if lacking.is_empty() {
        return Vec::new();
    }
    let asked = experiment.synopsis.points.len();
    let text = format!(
        "{} of {} of {} missing in {}: {}. The figures here are therefore incomplete. To measure the rest:",
        lacking.len(),
        counted(asked, "point"),
        match lacking.len() {
            1 => format!("{} is", experiment.synopsis.name),
            _ => format!("{} are", experiment.synopsis.name),
        },
        folder.path.display(),
        lacking.join(", ")
    );
    let commands = folder.invocations().into_iter();
    let commands = commands.map(|(invocation, _)| ReportBlock::Command(invocation.command));
    std::iter::once(ReportBlock::Notice(Tone::Bad, text))
        .chain(commands)
        .collect()
}

/// Table of the runs' machines and settings, with a column for each folder.
fn facts(recorded: &RecordedFolders) -> Grid {
    type Fact = (&'static str, fn(&Run) -> String);
    const FACTS: [Fact; 11] = [
        ("began", |run| run.began.clone()),
        ("took, all commands together", |run| {
            format!("{:.0} s", run.took_s)
        }),
        ("measured", |run| {
            if run.is_quick { "quick" } else { "in full" }.to_owned()
        }),
        ("version", |run| run.version.clone()),
        ("commit", |run| {
            run.commit.clone().unwrap_or_else(|| "not known".to_owned())
        }),
        ("adapter", |run| {
            let software = if run.adapter.software {
                ", software"
            } else {
                ""
            };
            format!("{}{software}", run.adapter.name)
        }),
        ("driver", |run| {
            format!("{}, {}", run.adapter.backend, run.adapter.driver)
        }),
        ("system", |run| run.machine.system.clone()),
        ("processor", |run| run.machine.processor.clone()),
        ("cores", |run| run.machine.cores.to_string()),
        ("memory", |run| {
            let gib = |bytes: u64| format!("{:.1} GiB", bytes as f64 / 1_073_741_824.0);
            run.machine
                .memory
                .map_or_else(|| "not known".to_owned(), gib)
        }),
    ];
    let with_run = || (recorded.folders.iter()).filter_map(|f| Some((f, f.run.as_ref()?)));
    let paths = with_run().map(|(f, _)| f.path.display().to_string());
    let heading = std::iter::once("folder".to_owned()).chain(paths);
    let mut grid = Grid::new("what was run", heading);
    for (name, fact) in FACTS {
        let cells = with_run().map(|(_, run)| Cell::from(fact(run)));
        grid.row(std::iter::once(Cell::from(name)).chain(cells));
    }
    grid
}
