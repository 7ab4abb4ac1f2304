//! The points of all folders, each with what it belongs to.

use crate::experiment::{Record, Warning};
use crate::gpu::AdapterReport;
use crate::report::recorded::{Experiment, Folder, Recorded, RunDefinition};

/// A point of an experiment.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point<'a> {
    pub(super) folder: &'a Folder,
    pub(super) experiment: &'a Experiment,
    pub(super) record: &'a Record,
}

impl Point<'_> {
    /// Its parameters: `amplitude = 1%, size = 2 k`.
    pub(super) fn parameters(&self) -> String {
        let words: Vec<String> = (self.record.parameters.iter())
            .map(|(name, value)| format!("{name} = {value}"))
            .collect();
        words.join(", ")
    }

    /// The run that it is of, as it was asked.
    pub(super) fn run(&self) -> Option<&RunDefinition> {
        let mut runs = self.experiment.definition.runs.iter();
        runs.find(|r| r.name == self.record.run)
    }

    /// Run and parameters.
    pub(super) fn name(&self) -> String {
        match self.record.parameters.is_empty() {
            true => self.record.run.clone(),
            false => format!("{}: {}", self.record.run, self.parameters()),
        }
    }
}

/// All points, and the adapters they were measured on.
#[derive(Clone, Debug)]
pub(super) struct Points<'a> {
    pub(super) all: Vec<Point<'a>>,
    adapters: Vec<&'a AdapterReport>,
    /// Warnings that every point of a folder has.
    common: Vec<(&'a Folder, Vec<Warning>)>,
}

impl<'a> Points<'a> {
    pub(super) fn of(recorded: &'a Recorded) -> Self {
        let mut all = Vec::new();
        let mut adapters: Vec<&AdapterReport> = Vec::new();
        let mut common = Vec::new();
        for folder in &recorded.folders {
            let start = all.len();
            for experiment in &folder.experiments {
                all.extend(experiment.records.iter().map(|record| Point {
                    folder,
                    experiment,
                    record,
                }));
            }
            common.push((folder, common_warnings(&all[start..])));
        }
        for adapter in all.iter().map(|p| &p.record.measurement.adapter) {
            if !adapters.contains(&adapter) {
                adapters.push(adapter);
            }
        }
        Self {
            all,
            adapters,
            common,
        }
    }

    /// Adapters, in the order of the folders.
    pub(super) fn adapters(&self) -> impl Iterator<Item = &'a AdapterReport> {
        self.adapters.iter().copied()
    }

    /// Points on an adapter.
    pub(super) fn on(&self, adapter: &AdapterReport) -> Vec<Point<'a>> {
        let all = self.all.iter();
        all.filter(|p| p.record.measurement.adapter == *adapter)
            .copied()
            .collect()
    }

    /// A name for an adapter that no other has.
    pub(super) fn label(&self, adapter: &AdapterReport) -> String {
        let named = self.adapters.iter().filter(|a| a.name == adapter.name);
        match named.count() {
            0 | 1 => adapter.name.clone(),
            _ => format!("{} ({}, {})", adapter.name, adapter.backend, adapter.driver),
        }
    }

    /// The name of a point's adapter after a separator, where there are several adapters.
    pub(super) fn on_whom(&self, point: &Point<'_>) -> String {
        match self.adapters.len() {
            0 | 1 => String::new(),
            _ => format!(" · {}", self.label(&point.record.measurement.adapter)),
        }
    }

    /// Warnings that concern all of a folder.
    pub(super) fn common(&self, folder: &Folder) -> &[Warning] {
        let found = self.common.iter().find(|(f, _)| std::ptr::eq(*f, folder));
        found.map_or(&[], |(_, warnings)| warnings)
    }

    /// Experiments by name, each with its points in all folders.
    pub(super) fn by_experiment(&self) -> Vec<(&'a str, Vec<Point<'a>>)> {
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

fn name_of<'a>(point: &Point<'a>) -> &'a str {
    &point.experiment.definition.name
}

/// Warnings of no strategy in particular that all points share, word for word.
fn common_warnings(points: &[Point<'_>]) -> Vec<Warning> {
    let Some((first, others)) = points.split_first() else {
        return Vec::new();
    };
    let mut warnings = first.record.warnings.clone();
    warnings
        .retain(|w| w.concerns().is_none() && others.iter().all(|p| p.record.warnings.contains(w)));
    warnings
}
