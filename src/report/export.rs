//! A report for machines: a table of every figure, and all records joined.

use std::collections::BTreeSet;

use serde::Serialize;

use super::derived::{Row, Situation, Standing, has_other_truth, rows, standings, winner};
use super::recorded::{Definition, PeerRecord, Recorded};
use crate::experiment::{CaseRecords, Record, Run};

/// Version of the form of [`json`].
const REPORT_FORMAT: u32 = 1;

/// One row for each point and strategy: what it is, then every figure by name; what was not measured is empty.
pub(super) fn csv(recorded: &Recorded) -> String {
    let mut all: Vec<(&Run, Row<'_>)> = Vec::new();
    for folder in &recorded.folders {
        for record in folder.experiments.iter().flat_map(|e| &e.records) {
            all.extend(rows(record).into_iter().map(|row| (&folder.run, row)));
        }
    }
    let of_all = || all.iter().map(|(_, row)| row);
    let names: BTreeSet<&String> = of_all().flat_map(|r| r.figures.keys()).collect();
    let parameters: BTreeSet<&String> = of_all()
        .flat_map(|r| {
            r.record.parameters.keys().chain(
                r.record.makers[r.index]
                    .iter()
                    .flat_map(|m| m.parameters.keys()),
            )
        })
        .collect();
    const FIRST: [&str; 11] = [
        "experiment",
        "run",
        "strategy",
        "outcome",
        "reason",
        "adapter",
        "software",
        "commit",
        "quick",
        "scene",
        "resolution",
    ];
    let heading = FIRST.iter().map(|f| (*f).to_owned());
    let heading = heading
        .chain(parameters.iter().map(|p| format!("{p}=")))
        .chain(names.iter().map(|n| (*n).clone()))
        .chain(["command".to_owned()]);
    let mut text = line(heading);
    for (run, row) in &all {
        let (m, found) = (&row.record.measurement, row.found());
        let first = [
            row.record.experiment.clone(),
            row.record.run.clone(),
            found.name.clone(),
            found.outcome.name().to_owned(),
            found.reason.clone().unwrap_or_default(),
            m.adapter.name.clone(),
            m.adapter.software.to_string(),
            run.commit.clone().unwrap_or_default(),
            row.record.is_quick.to_string(),
            m.scene.clone(),
            format!("{}x{}", m.resolution[0], m.resolution[1]),
        ];
        let values = parameters.iter().map(|p| {
            let mut own = row.record.makers[row.index].iter();
            let own = own.find_map(|m| m.parameters.get(*p).map(String::as_str));
            own.or(row.parameter(p)).unwrap_or_default().to_owned()
        });
        let figures = names
            .iter()
            .map(|n| row.figures.get(*n).map_or_else(String::new, f64::to_string));
        let cells = first.into_iter().chain(values).chain(figures);
        text.push_str(&line(cells.chain([m.command.clone()])));
    }
    text
}

/// RFC 4180, with line feeds alone.
fn line(cells: impl Iterator<Item = String>) -> String {
    let cells: Vec<String> = cells
        .map(|cell| match cell.contains([',', '"', '\n', '\r']) {
            true => format!("\"{}\"", cell.replace('"', "\"\"")),
            false => cell,
        })
        .collect();
    format!("{}\n", cells.join(","))
}

#[derive(Serialize)]
struct Joined<'a> {
    format: u32,
    folders: Vec<JoinedFolder<'a>>,
    derived: Vec<DerivedPoint<'a>>,
    standings: Vec<DerivedStanding>,
}

#[derive(Serialize)]
struct JoinedFolder<'a> {
    folder: String,
    run: &'a Run,
    experiments: Vec<JoinedExperiment<'a>>,
    peers: &'a [PeerRecord],
}

#[derive(Serialize)]
struct JoinedExperiment<'a> {
    definition: &'a Definition,
    records: &'a [Record],
    cases: &'a [CaseRecords],
}

/// What is worked out of one point.
#[derive(Serialize)]
struct DerivedPoint<'a> {
    experiment: &'a str,
    run: &'a str,
    parameters: &'a crate::experiment::Parameters,
    adapter: &'a str,
    /// The fastest exact strategy when only the view, the cut, or the mesh moves.
    fastest_exact: [Option<&'a str>; 3],
}

/// A strategy over all points of one adapter that are judged by their own exact image.
#[derive(Serialize)]
struct DerivedStanding {
    adapter: String,
    strategy: String,
    points: usize,
    drawn: usize,
    exact: usize,
    overflowed: usize,
    worst_decided_wrong_px: usize,
    /// Least, median, greatest ratio of the frame to draw only.
    ratio: Option<[f64; 3]>,
}

/// All records, and what is worked out of them.
pub(super) fn json(recorded: &Recorded) -> String {
    let records: Vec<&Record> = (recorded.folders.iter())
        .flat_map(|f| f.experiments.iter().flat_map(|e| &e.records))
        .collect();
    let folders = recorded.folders.iter().map(|folder| JoinedFolder {
        folder: folder.path.display().to_string(),
        run: &folder.run,
        experiments: (folder.experiments.iter())
            .map(|e| JoinedExperiment {
                definition: &e.definition,
                records: &e.records,
                cases: &e.cases,
            })
            .collect(),
        peers: &folder.peers,
    });
    let joined = Joined {
        format: REPORT_FORMAT,
        folders: folders.collect(),
        derived: records.iter().map(|r| derived(r)).collect(),
        standings: all_standings(&records),
    };
    format!("{:#}\n", serde_json::json!(joined))
}

fn derived(record: &Record) -> DerivedPoint<'_> {
    let m = &record.measurement;
    DerivedPoint {
        experiment: &record.experiment,
        run: &record.run,
        parameters: &record.parameters,
        adapter: &m.adapter.name,
        fastest_exact: Situation::ALL
            .map(|s| winner(record, s).map(|i| m.strategies[i].name.as_str())),
    }
}

fn all_standings(records: &[&Record]) -> Vec<DerivedStanding> {
    let mut adapters: Vec<&str> = records
        .iter()
        .map(|r| r.measurement.adapter.name.as_str())
        .collect();
    adapters.sort_unstable();
    adapters.dedup();
    let on = |adapter: &str| -> Vec<Standing> {
        let of_it = records
            .iter()
            .filter(|r| r.measurement.adapter.name == adapter && !has_other_truth(r));
        standings(&of_it.copied().collect::<Vec<_>>())
    };
    let all = adapters
        .into_iter()
        .flat_map(|adapter| on(adapter).into_iter().map(move |s| (adapter, s)));
    all.map(|(adapter, s)| DerivedStanding {
        adapter: adapter.to_owned(),
        points: s.asked,
        drawn: s.drawn,
        exact: s.exact,
        overflowed: s.overflowed,
        worst_decided_wrong_px: s.worst_px,
        ratio: s.ratio.map(|r| [r.least, r.median, r.most]),
        strategy: s.name,
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_quoted_where_they_must_be() {
        let cells = ["a", "b,c", "d \"e\"", "f\ng", ""].map(str::to_owned);
        assert_eq!(
            line(cells.into_iter()),
            "a,\"b,c\",\"d \"\"e\"\"\",\"f\ng\",\n"
        );
    }
}
