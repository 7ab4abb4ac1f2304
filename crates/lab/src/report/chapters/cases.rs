//! Hard cases and the search through random scenes: the expected and the measured result of every strategy for every case.

use super::expectations::missed_notice;
use super::figures::counted;
use crate::experiment::{CaseRecord, CaseRecords, Reached};
use crate::report::derived::natural;
use crate::report::document::{Cell, Grid, ReportBlock, Tone};
use crate::report::recorded::{Experiment, RecordedFolders};

pub(super) fn chapter(recorded: &RecordedFolders) -> Vec<ReportBlock> {
    let mut blocks = Vec::new();
    for folder in &recorded.folders {
        for experiment in &folder.experiments {
            for cases in &experiment.cases {
                if blocks.is_empty() {
                    blocks.push(ReportBlock::Text(
                        "Scenes with a known answer. Each cell shows whether that method met its expectation: `✓`, met; `declared`, a failure or a bound that was \
                         stated beforehand with its reason, and occurred as stated; or `missed`, not met, which includes declared failures that pass. Cases with missed expectations come first."
                            .to_owned(),
                    ));
                }
                let place = match recorded.folders.len() {
                    1 => String::new(),
                    _ => (folder.run.as_ref())
                        .map_or_else(String::new, |run| format!(" · {}", run.adapter.name)),
                };
                blocks.push(ReportBlock::Heading(
                    4,
                    format!("{}, run {}{place}", cases.experiment, cases.run),
                ));
                if experiment.cases.first() == Some(cases) {
                    blocks.extend(asked(experiment));
                }
                blocks.extend(one(cases));
            }
        }
    }
    blocks
}

/// Question and analysis of an experiment without other records, which no other section shows.
fn asked(experiment: &Experiment) -> Vec<ReportBlock> {
    let synopsis = &experiment.synopsis;
    if !experiment.records.is_empty() {
        return Vec::new();
    }
    vec![
        ReportBlock::Heading(5, synopsis.question.clone()),
        ReportBlock::Prose(synopsis.analysis.clone()),
    ]
}

fn one(cases: &CaseRecords) -> Vec<ReportBlock> {
    let all = || cases.cases.iter().flat_map(|c| &c.expectations);
    let missed = || all().filter(|r| !r.holds);
    let declared = all().filter(|r| r.holds && r.expected.why.is_some());
    let sizes: Vec<String> = cases.sizes_px.iter().map(ToString::to_string).collect();
    let sizes = match sizes.is_empty() {
        true => String::new(),
        false => format!(", pictures with sides of {} px", sizes.join(" and ")),
    };
    let mut blocks = vec![ReportBlock::Text(format!(
        "{}{sizes}: {}, {} missed, {} declared.",
        counted(cases.cases.len(), "case"),
        counted(all().count(), "expectation"),
        missed().count(),
        declared.count(),
    ))];
    for case in &cases.cases {
        for reached in case.expectations.iter().filter(|r| !r.holds) {
            if let ReportBlock::Notice(tone, text) = missed_notice(reached) {
                let text = format!("Case {} ({}). {text}", case.id, case.name);
                blocks.push(ReportBlock::Notice(tone, text));
            }
        }
    }
    blocks.push(ReportBlock::Folded {
        summary: format!("{} by each method", counted(cases.cases.len(), "case")),
        open: missed().count() > 0,
        blocks: vec![ReportBlock::Grid(table(cases))],
    });
    blocks
}

fn table(cases: &CaseRecords) -> Grid {
    let mut strategies: Vec<&str> = Vec::new();
    for reached in cases.cases.iter().flat_map(|c| &c.expectations) {
        if !strategies.contains(&reached.strategy.as_str()) {
            strategies.push(&reached.strategy);
        }
    }
    let heading = ["case", "what it is"]
        .into_iter()
        .chain(strategies.iter().copied());
    let mut grid = Grid::new("hard cases", heading.chain(["checked by"]));
    let mut sorted: Vec<&CaseRecord> = cases.cases.iter().collect();
    let is_clean = |c: &CaseRecord| c.expectations.iter().all(|r| r.holds);
    sorted.sort_by(|a, b| is_clean(a).cmp(&is_clean(b)).then(natural(&a.id, &b.id)));
    for case in sorted {
        let of = |strategy: &&str| -> Cell {
            let of_it = case
                .expectations
                .iter()
                .filter(|r| r.strategy == **strategy);
            cell(&of_it.collect::<Vec<_>>())
        };
        let first = [Cell::from(case.id.as_str()), Cell::from(case.name.as_str())];
        let held_by = case.held_by.as_ref();
        let held_by = held_by.map_or_else(Cell::default, |h| Cell::from(format!("`{h}`")));
        let cells = strategies.iter().map(of);
        grid.row(first.into_iter().chain(cells).chain([held_by]));
    }
    grid
}

/// Cell with the worst result among a strategy's expectations for one case.
fn cell(reached: &[&Reached]) -> Cell {
    let story: Vec<String> = reached
        .iter()
        .map(|r| {
            let why = r.expected.why.as_ref();
            let why = why.map_or_else(String::new, |w| format!("; why: {w}"));
            format!("expected {}; found {}{why}", r.expected.what, r.found)
        })
        .collect();
    let (word, tone) = if reached.is_empty() {
        return Cell::default();
    } else if reached.iter().any(|r| !r.holds) {
        ("missed", Tone::Bad)
    } else if reached.iter().any(|r| r.expected.why.is_some()) {
        ("declared", Tone::Fair)
    } else {
        ("✓", Tone::Good)
    };
    Cell::from(word).toned(tone).titled(story.join(" | "))
}
