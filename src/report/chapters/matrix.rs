//! Strategies by scenes: one cell for each strategy over the points of a run.

use super::figures::{times, tone_of};
use super::point::{Point, Points};
use crate::experiment::Record;
use crate::report::derived::{StrategyTotals, totals_of_strategies};
use crate::report::document::{Block, Cell, Grid, Tone};

pub(super) fn chapter(points: &Points<'_>) -> Vec<Block> {
    if points.all.is_empty() {
        return Vec::new();
    }
    let mut blocks = vec![Block::Text(
        "A column for each run of an experiment. A cell says `exact`, or the most wrong pixels of a point that the reference is sure of, then the median \
         ratio of the frame time to draw only; `!` marks a bounded buffer that overflowed at some point. Point at a cell for the rest."
            .to_owned(),
    )];
    for setup in points.setups() {
        if points.setups().count() > 1 {
            blocks.push(Block::Heading(5, points.label(setup)));
        }
        blocks.push(Block::Grid(matrix(&points.on(setup))));
    }
    blocks
}

fn matrix(points: &[Point<'_>]) -> Grid {
    let mut columns: Vec<(&str, &str)> = Vec::new();
    for point in points {
        let column = (point.record.experiment.as_str(), point.record.run.as_str());
        if !columns.contains(&column) {
            columns.push(column);
        }
    }
    let heading = columns.iter().map(|(experiment, run)| {
        let number = experiment.split('-').next().unwrap_or(experiment);
        Cell::from(format!("{number} {run}")).titled(format!("{experiment}, run {run}"))
    });
    let heading = std::iter::once(Cell::from("strategy")).chain(heading);
    let mut grid = Grid::new("strategies by scenes", heading);
    let records: Vec<&Record> = points.iter().map(|p| p.record).collect();
    for totals in totals_of_strategies(&records) {
        let cells = columns.iter().map(|(experiment, run)| {
            let of_run = records.iter().copied();
            let of_run = of_run.filter(|r| r.experiment == *experiment && r.run == *run);
            cell(&StrategyTotals::of(&totals.name, of_run))
        });
        grid.row(std::iter::once(Cell::from(totals.name.as_str())).chain(cells));
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
    let wrong = match totals.worst_px {
        0 if totals.is_exact() => "exact".to_owned(),
        px => format!("{px} px"),
    };
    let ratio = totals.ratio.map(|r| format!(" {}", times(r.median)));
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
    let text = format!("{wrong}{}{mark}", ratio.unwrap_or_default());
    let key = totals.worst_px as f64 + totals.ratio.map_or(0.0, |r| r.median * 1e-6);
    Cell::number(text, key).toned(tone).titled(lines.join("; "))
}
