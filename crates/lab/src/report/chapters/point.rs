//! The points of all folders, each with its experiment and setup.

use cutaway::gpu::AdapterReport;

use crate::experiment::{Record, RunSynopsis, Warning};
use crate::report::recorded::{Experiment, Folder, RecordedFolders};

/// A point of an experiment.
#[derive(Clone, Copy, Debug)]
pub(super) struct RecordedPoint<'a> {
    pub(super) folder: &'a Folder,
    pub(super) experiment: &'a Experiment,
    pub(super) record: &'a Record,
}

impl RecordedPoint<'_> {
    /// The point's parameters as text: `amplitude = 1%, size = 2 k`.
    pub(super) fn parameters(&self) -> String {
        let words: Vec<String> = (self.record.parameters.iter())
            .map(|(name, value)| format!("{name} = {value}"))
            .collect();
        words.join(", ")
    }

    /// Definition of the point's run in the experiment.
    pub(super) fn run(&self) -> Option<&RunSynopsis> {
        let mut runs = self.experiment.synopsis.runs.iter();
        runs.find(|r| r.name == self.record.run)
    }

    /// Name of the point: its run and its parameters.
    pub(super) fn name(&self) -> String {
        match self.record.parameters.is_empty() {
            true => self.record.run.clone(),
            false => format!("{}: {}", self.record.run, self.parameters()),
        }
    }
}

/// Properties that figures must have in common to be comparable: the folder, the adapter, and whether `--quick` was used.
#[derive(Clone, Copy, Debug)]
pub(super) struct Setup<'a> {
    folder: &'a Folder,
    adapter: &'a AdapterReport,
    is_quick: bool,
}

impl Setup<'_> {
    fn has(&self, point: &RecordedPoint<'_>) -> bool {
        std::ptr::eq(self.folder, point.folder)
            && *self.adapter == point.record.measurement.adapter
            && self.is_quick == point.record.is_quick
    }
}

/// All points, and the setups in which they were measured.
#[derive(Clone, Debug)]
pub(super) struct Points<'a> {
    pub(super) all: Vec<RecordedPoint<'a>>,
    setups: Vec<Setup<'a>>,
    /// For each folder, the warnings that all its points have.
    common: Vec<(&'a Folder, Vec<Warning>)>,
}

impl<'a> Points<'a> {
    pub(super) fn of(recorded: &'a RecordedFolders) -> Self {
        let mut all = Vec::new();
        let mut setups: Vec<Setup<'_>> = Vec::new();
        let mut common = Vec::new();
        for folder in &recorded.folders {
            let start = all.len();
            for experiment in &folder.experiments {
                all.extend(experiment.records.iter().map(|record| RecordedPoint {
                    folder,
                    experiment,
                    record,
                }));
            }
            common.push((folder, common_warnings(&all[start..])));
        }
        for point in &all {
            if !setups.iter().any(|b| b.has(point)) {
                setups.push(Setup {
                    folder: point.folder,
                    adapter: &point.record.measurement.adapter,
                    is_quick: point.record.is_quick,
                });
            }
        }
        Self {
            all,
            setups,
            common,
        }
    }

    /// Setups of the points, in the order of the folders.
    pub(super) fn setups(&self) -> impl Iterator<Item = &Setup<'a>> {
        self.setups.iter()
    }

    /// Points of a setup.
    pub(super) fn on(&self, setup: &Setup<'_>) -> Vec<RecordedPoint<'a>> {
        let all = self.all.iter();
        all.filter(|p| setup.has(p)).copied().collect()
    }

    /// A unique name for a setup: its adapter, its folder if there are several folders, and whether it was quick if only some
    /// setups were.
    pub(super) fn label(&self, setup: &Setup<'_>) -> String {
        let differ = |is_same: &dyn Fn(&Setup<'_>) -> bool| !self.setups.iter().all(is_same);
        let adapter = setup.adapter;
        let is_namesake = |b: &Setup<'_>| b.adapter.name == adapter.name && b.adapter != adapter;
        let mut words = Vec::new();
        if differ(&|b| std::ptr::eq(b.folder, setup.folder)) {
            words.push(setup.folder.path.display().to_string());
        }
        words.push(match self.setups.iter().any(is_namesake) {
            false => adapter.name.clone(),
            true => adapter.in_words(),
        });
        if differ(&|b| b.is_quick == setup.is_quick) {
            words.push(if setup.is_quick { "quick" } else { "in full" }.to_owned());
        }
        words.join(", ")
    }

    /// The name of a point's setup, preceded by a separator; empty if there is only one setup.
    pub(super) fn on_whom(&self, point: &RecordedPoint<'_>) -> String {
        match self.setups.iter().find(|b| b.has(point)) {
            Some(setup) if self.setups.len() > 1 => format!(" · {}", self.label(setup)),
            _ => String::new(),
        }
    }

    /// Warnings that concern a whole folder.
    pub(super) fn common(&self, folder: &Folder) -> &[Warning] {
        let found = self.common.iter().find(|(f, _)| std::ptr::eq(*f, folder));
        found.map_or(&[], |(_, warnings)| warnings)
    }

    /// Experiments by name, each with its points in all folders.
    pub(super) fn by_experiment(&self) -> Vec<(&'a str, Vec<RecordedPoint<'a>>)> {
        let mut names: Vec<&str> = self.all.iter().map(|p| name_of(p)).collect();
        names.sort_unstable();
        names.dedup();
        let of = |name: &str| {
            self.all
                .iter()
                .filter(|p| name_of(p) == name)
                .copied()
                .collect()
        };
        names.into_iter().map(|name| (name, of(name))).collect()
    }
}

fn name_of<'a>(point: &RecordedPoint<'a>) -> &'a str {
    &point.experiment.synopsis.name
}

/// Warnings that all points have identically and that concern no particular strategy.
fn common_warnings(points: &[RecordedPoint<'_>]) -> Vec<Warning> {
    let Some((first, others)) = points.split_first() else {
        return Vec::new();
    };
    let mut warnings = first.record.warnings.clone();
    warnings
        .retain(|w| w.concerns().is_none() && others.iter().all(|p| p.record.warnings.contains(w)));
    warnings
}
