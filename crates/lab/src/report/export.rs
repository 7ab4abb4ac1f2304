//! Machine-readable report: a CSV table of all figures, and a JSON file with all records.
//!
//! Spreadsheets execute cells that begin like a formula. A leading apostrophe makes such cells text, as OWASP recommends against CSV
//! injection. Numbers are left as they are. To read a text back, remove one leading apostrophe if one of [`MARKED`] follows it.

use std::collections::BTreeSet;

use serde::Serialize;

use super::derived::{
    Row, Situation, StrategyTotals, has_other_truth, ranked, rows, totals_of_strategies,
};
use super::recorded::{Experiment, Folder, PeerRecord, RecordedFolders};
use crate::experiment::{CaseRecords, Record, Run, Synopsis};

/// Version of the format that [`json`] writes.
const REPORT_FORMAT: u32 = 1;

/// One row for each point and strategy: first what identifies the row, then every figure by name. A figure that was not measured is empty.
pub(super) fn csv(recorded: &RecordedFolders) -> String {
    let mut all: Vec<(&Folder, Row<'_>)> = Vec::new();
    for folder in &recorded.folders {
        for record in folder.experiments.iter().flat_map(|e| &e.records) {
            all.extend(rows(record).into_iter().map(|row| (folder, row)));
        }
    }
    let of_all = || all.iter().map(|(_, row)| row);
    let names: BTreeSet<&String> = of_all().flat_map(|r| r.figures.keys()).collect();
    let parameters: BTreeSet<&String> = of_all()
        .flat_map(|r| {
            r.record.parameters.keys().chain(
                r.record.families[r.index]
                    .iter()
                    .flat_map(|m| m.parameters.keys()),
            )
        })
        .collect();
    const FIRST: [&str; 18] = [
        "folder",
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
        "rounds",
        "cap_px",
        "surface_px",
        "undecided_px",
        "judged_px",
        "truth",
    ];
    let heading = FIRST.iter().map(|f| (*f).to_owned());
    let heading = heading
        .chain(parameters.iter().map(|p| format!("{p}=")))
        .chain(names.iter().map(|n| (*n).clone()))
        .chain(["command".to_owned()]);
    let mut bytes = Vec::new();
    let mut table = csv::Writer::from_writer(&mut bytes);
    // Writing rows of equal length to memory cannot fail.
    let _ = table.write_record(heading.map(inert));
    for (folder, row) in &all {
        let (m, found) = (&row.record.measurement, row.found());
        let first = [
            folder.path.display().to_string(),
            row.record.experiment.clone(),
            row.record.run.clone(),
            found.name.clone(),
            found.outcome.name().to_owned(),
            found.reason.clone().unwrap_or_default(),
            m.adapter.name.clone(),
            m.adapter.software.to_string(),
            (folder.run.as_ref())
                .and_then(|run| run.commit.clone())
                .unwrap_or_default(),
            row.record.is_quick.to_string(),
            m.scene.clone(),
            format!("{}x{}", m.resolution[0], m.resolution[1]),
            m.rounds.to_string(),
            m.exact.cap_px.to_string(),
            m.exact.surface_px.to_string(),
            m.exact.undecided_px.to_string(),
            (m.exact.judged_px).map_or_else(String::new, |px| px.to_string()),
            (row.record.truth.as_ref())
                .map_or("own", |_| "other")
                .to_owned(),
        ];
        let values = parameters.iter().map(|p| {
            let mut own = row.record.families[row.index].iter();
            let own = own.find_map(|m| m.parameters.get(*p));
            let value = own.or(row.parameter(p));
            value.map_or_else(String::new, ToString::to_string)
        });
        let figures = names
            .iter()
            .map(|n| row.figures.get(*n).map_or_else(String::new, f64::to_string));
        let cells = first.into_iter().chain(values).chain(figures);
        let _ = table.write_record(cells.chain([m.command.clone()]).map(inert));
    }
    drop(table);
    String::from_utf8_lossy(&bytes).into_owned()
}

/// Characters that may begin a formula, and the apostrophe itself, so that the added apostrophe can always be told apart and removed.
const MARKED: [char; 7] = ['=', '+', '-', '@', '\t', '\r', '\''];

/// Changes a cell so that no spreadsheet takes it for a formula.
fn inert(cell: String) -> String {
    match cell.starts_with(MARKED) && !cell.parse().is_ok_and(f64::is_finite) {
        true => format!("'{cell}"),
        false => cell,
    }
}

#[derive(Serialize)]
struct JsonExport<'a> {
    format: u32,
    folders: Vec<JoinedFolder<'a>>,
    derived: Vec<DerivedPoint<'a>>,
    #[serde(rename = "standings")]
    totals_of_strategies: Vec<DerivedTotals>,
}

#[derive(Serialize)]
struct JoinedFolder<'a> {
    folder: String,
    run: Option<&'a Run>,
    experiments: Vec<JoinedExperiment<'a>>,
    peers: &'a [PeerRecord],
}

#[derive(Serialize)]
struct JoinedExperiment<'a> {
    definition: &'a Synopsis,
    records: &'a [Record],
    cases: &'a [CaseRecords],
}

/// Values derived from one point.
#[derive(Serialize)]
struct DerivedPoint<'a> {
    folder: String,
    experiment: &'a str,
    run: &'a str,
    parameters: &'a crate::experiment::Parameters,
    adapter: &'a str,
    /// The fastest exact strategy that `cutaway render` accepts, when only the view moves, when the cut moves, and when the mesh moves.
    fastest_exact: [Option<String>; 3],
}

/// Totals of a strategy over the points of one folder and adapter, quick or full, that are judged by their own exact image.
#[derive(Serialize)]
struct DerivedTotals {
    folder: String,
    is_quick: bool,
    adapter: String,
    strategy: String,
    points: usize,
    drawn: usize,
    exact: usize,
    overflowed: usize,
    worst_decided_wrong_px: usize,
    /// Minimum, median and maximum of the frame time divided by the time to draw the uncut scene.
    ratio: Option<[f64; 3]>,
}

/// All records, and the values derived from them.
pub(super) fn json(recorded: &RecordedFolders) -> String {
    let records = |folder| experiments_of(folder).flat_map(|e| &e.records);
    let points = (recorded.folders.iter()).flat_map(|f| records(f).map(move |r| derived(f, r)));
    let folders = recorded.folders.iter().map(|folder| JoinedFolder {
        folder: folder.path.display().to_string(),
        run: folder.run.as_ref(),
        experiments: (folder.experiments.iter())
            .map(|e| JoinedExperiment {
                definition: &e.synopsis,
                records: &e.records,
                cases: &e.cases,
            })
            .collect(),
        peers: &folder.peers,
    });
    let joined = JsonExport {
        format: REPORT_FORMAT,
        folders: folders.collect(),
        derived: points.collect(),
        totals_of_strategies: (recorded.folders.iter())
            .flat_map(|f| totals_in(f, &records(f).collect::<Vec<_>>()))
            .collect(),
    };
    format!("{:#}\n", serde_json::json!(joined))
}

fn experiments_of(folder: &Folder) -> std::slice::Iter<'_, Experiment> {
    folder.experiments.iter()
}

fn derived<'a>(folder: &Folder, record: &'a Record) -> DerivedPoint<'a> {
    let m = &record.measurement;
    DerivedPoint {
        folder: folder.path.display().to_string(),
        experiment: &record.experiment,
        run: &record.run,
        parameters: &record.parameters,
        adapter: &m.adapter.name,
        fastest_exact: Situation::ALL.map(|s| {
            let first = ranked(&[record], s).into_iter().next();
            first.map(|r| r.name)
        }),
    }
}

fn totals_in(folder: &Folder, records: &[&Record]) -> Vec<DerivedTotals> {
    let setup = |r: &Record| (r.measurement.adapter.name.clone(), r.is_quick);
    let setups: BTreeSet<(String, bool)> = records.iter().map(|r| setup(r)).collect();
    let on = |of: &(String, bool)| -> Vec<StrategyTotals> {
        let of_it = records
            .iter()
            .filter(|r| setup(r) == *of && !has_other_truth(r));
        totals_of_strategies(&of_it.copied().collect::<Vec<_>>())
    };
    let all = setups
        .iter()
        .flat_map(|setup| on(setup).into_iter().map(move |s| (setup, s)));
    all.map(|((adapter, is_quick), s)| DerivedTotals {
        folder: folder.path.display().to_string(),
        is_quick: *is_quick,
        adapter: adapter.clone(),
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
    fn cells_are_no_formulas_and_numbers_stay() {
        for (cell, expected) in [
            ("=1+1", "'=1+1"),
            ("+x", "'+x"),
            ("-z=50%", "'-z=50%"),
            ("@a", "'@a"),
            ("\tx", "'\tx"),
            ("'=1", "''=1"),
            ("-1.5", "-1.5"),
            ("-2e-3", "-2e-3"),
            ("a=b", "a=b"),
        ] {
            assert_eq!(inert(cell.to_owned()), expected);
        }
    }
}
