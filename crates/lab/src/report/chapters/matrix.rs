//! Table of runs by methods: each cell summarises a method over the points of a run.

use super::figures::{times, tone_of};
use super::point::{Points, RecordedPoint};
use crate::experiment::Record;
use crate::report::derived::{StrategyTotals, totals_of_strategies};
use crate::report::document::{Cell, Grid, ReportBlock, Tone};

pub(super) fn chapter(points: &Points<'_>) -> Vec<ReportBlock> {
    // A single point has its own table elsewhere.
    if points.all.len() < 2 {
        return Vec::new();
    }
    let mut blocks = vec![ReportBlock::Text(
        "One row for each run of an experiment, one column for each method. A cell has the median of the frame time divided by the time of drawing uncut, and, if \
         any point has decided wrong pixels, their maximum; `!` marks a bounded buffer that overflowed. The tooltip of a cell has the range over the points."
            .to_owned(),
    )];
    for setup in points.setups() {
        if points.setups().count() > 1 {
            blocks.push(ReportBlock::Heading(5, points.label(setup)));
        }
        blocks.push(ReportBlock::Folded {
            summary: "The whole table".to_owned(),
            open: false,
            blocks: vec![ReportBlock::Grid(matrix(&points.on(setup)))],
        });
    }
    blocks
}

fn matrix(points: &[RecordedPoint<'_>]) -> Grid {
    let mut runs: Vec<(&str, &str)> = Vec::new();
    for point in points {
        let run = (point.record.experiment.as_str(), point.record.run.as_str());
        if !runs.contains(&run) {
            runs.push(run);
        }
    }
    let records: Vec<&Record> = points.iter().map(|p| p.record).collect();
    let totals = totals_of_strategies(&records);
    let names: Vec<&str> = totals.iter().map(|t| t.name.as_str()).collect();
    let heading = std::iter::once("run").chain(names.iter().copied());
    let mut grid = Grid::new("scenes by methods", heading);
    for (experiment, run) in runs {
        let of_run = records.iter().copied();
        let of_run = of_run.filter(|r| r.experiment == experiment && r.run == run);
        let of_run: Vec<&Record> = of_run.collect();
        let number = experiment.split('-').next().unwrap_or(experiment);
        let first =
            Cell::from(format!("{number} {run}")).titled(format!("{experiment}, run {run}"));
        let cells =
            (names.iter()).map(|name| cell(&StrategyTotals::of(name, of_run.iter().copied())));
        grid.row(std::iter::once(first).chain(cells));
    }
    grid
}

fn cell(totals: &StrategyTotals) -> Cell {
    if totals.asked == 0 {
        return Cell::default();
    }
    let reasons: Vec<&str> = totals.refusals.keys().map(String::as_str).collect();
    if totals.drawn == 0 {
        let refused = Cell::from("refused").toned(Tone::Faint);
        return refused.titled(reasons.join("; "));
    }
    let ratio = totals
        .ratio
        .map_or_else(|| "drawn".to_owned(), |r| times(r.median));
    let wrong = match totals.worst_px {
        0 => String::new(),
        px => format!(", {px}\u{a0}px"),
    };
    let mark = if totals.overflowed > 0 { " !" } else { "" };
    let mut lines = vec![format!(
        "exact at {} of {} points",
        totals.exact, totals.asked
    )];
    if let Some(r) = totals.ratio {
        lines.push(format!(
            "ratio from {} to {}",
            times(r.least),
            times(r.most)
        ));
    }
    if totals.overflowed > 0 {
        lines.push(format!("overflowed at {}", totals.overflowed));
    }
    if totals.refused() > 0 {
        lines.push(format!(
            "refused at {}: {}",
            totals.refused(),
            reasons.join("; ")
        ));
    }
    let tone = match (totals.worst_px, totals.is_exact()) {
        (0, false) => Tone::Fair,
        (px, _) => tone_of(px),
    };
    let text = format!("{ratio}{wrong}{mark}");
    Cell::from(text).toned(tone).titled(lines.join("; "))
}
