//! Parser of `[[chart]]`: the charts that a report draws from an experiment's records.

use std::collections::BTreeSet;

use cutaway::Result;
use cutaway::error::did_you_mean;
use cutaway_io::document::reader::{Entry, Table};

use super::{Asked, DefinedRun};
use crate::experiment::ChartSynopsis;
use crate::experiment::figures::{OF_DRIFT, OF_PICTURES, OF_SIZE, OF_TIME, of_error};

/// Reads a chart, and checks that the runs it shows have the values of its axes.
pub(super) fn read(entry: &Entry<'_>, runs: &[DefinedRun]) -> Result<ChartSynopsis> {
    let table = entry.table(&["title", "runs", "x", "y", "log", "pareto", "note"])?;
    let of_scenes = |run: &&DefinedRun| matches!(run.full, Asked::Scenes(_));
    let names: Vec<&str> = (runs.iter().filter(of_scenes))
        .map(|r| r.name.as_str())
        .collect();
    let shown = match table.get("runs") {
        Some(entry) => named(&entry, &names)?,
        None => names.iter().map(|n| (*n).to_owned()).collect(),
    };
    let mut figures = of_error();
    figures.extend(
        OF_DRIFT
            .iter()
            .chain(&OF_PICTURES)
            .chain(&OF_SIZE)
            .chain(&OF_TIME)
            .map(|n| (*n).to_owned()),
    );
    let mut values = BTreeSet::new();
    for run in runs.iter().filter(|r| shown.contains(&r.name)) {
        if let Asked::Scenes(run) = &run.full {
            values.extend(run.axes.names());
        }
    }
    let figures: Vec<&str> = figures.iter().map(String::as_str).collect();
    let all: Vec<&str> = values
        .iter()
        .copied()
        .chain(figures.iter().copied())
        .collect();
    let note = table.get("note");
    Ok(ChartSynopsis {
        title: table.need("title", "\"The gap falls\"")?.text()?.to_owned(),
        runs: shown,
        x: one_of(&table.need("x", "\"ratio\"")?, &all)?,
        y: one_of(&table.need("y", "\"crack_px\"")?, &figures)?,
        log: axes(&table)?,
        pareto: table.get("pareto").map_or(Ok(false), |e| e.flag())?,
        note: note.map(|e| e.text().map(str::to_owned)).transpose()?,
    })
}

fn named(entry: &Entry<'_>, names: &[&str]) -> Result<Vec<String>> {
    let wanted = super::scenes::some_texts(entry)?;
    match wanted.iter().find(|w| !names.contains(&w.as_str())) {
        Some(stray) => {
            let what = format!("no run of scenes has the name `{stray}`");
            Err(entry.fault(what, did_you_mean(stray, names.iter().copied())))
        }
        None => Ok(wanted),
    }
}

fn one_of(entry: &Entry<'_>, known: &[&str]) -> Result<String> {
    let word = entry.text()?;
    if known.contains(&word) {
        return Ok(word.to_owned());
    }
    let what = format!("`{word}` is neither a figure nor a sweep axis");
    Err(entry.fault(what, did_you_mean(word, known.iter().copied())))
}

/// Reads which axes are logarithmic.
fn axes(table: &Table<'_>) -> Result<Vec<String>> {
    let Some(log) = table.get("log") else {
        return Ok(Vec::new());
    };
    let axes = log.texts()?;
    match axes.iter().find(|a| *a != "x" && *a != "y") {
        Some(stray) => {
            let help = "write `log = [\"x\"]`, `log = [\"y\"]` or `log = [\"x\", \"y\"]`";
            Err(log.fault(format_args!("`{stray}` is no axis"), help))
        }
        None => Ok(axes),
    }
}
