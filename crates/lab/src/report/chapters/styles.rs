//! Cost of a cutaway relative to the same picture without one, and of a style relative to plain light.

use super::advice::cards;
use super::figures::times;
use super::point::Points;
use crate::experiment::Record;
use crate::report::derived::{Situation, Variants, variants};
use crate::report::document::{Cell, Grid, ReportBlock};
use crate::report::number::milliseconds;

/// For each run whose points are variants of one picture: the question, the answer and the table.
pub(super) fn blocks(points: &Points<'_>) -> Vec<ReportBlock> {
    let mut blocks = Vec::new();
    for setup in points.setups() {
        let on_it = points.on(setup);
        let mut runs: Vec<(&str, &str)> = Vec::new();
        for point in &on_it {
            let run = (point.record.experiment.as_str(), point.record.run.as_str());
            if !runs.contains(&run) {
                runs.push(run);
            }
        }
        for (experiment, run) in runs {
            let records = on_it.iter().map(|p| p.record);
            let of_run = records.filter(|r| r.experiment == experiment && r.run == run);
            let records: Vec<&Record> = of_run.collect();
            // A run with additional figures answers another question, such as whether frames flicker.
            let asks_else = records
                .iter()
                .any(|r| r.figures.iter().any(|f| !f.is_empty()));
            let Some(found) = variants(&records).filter(|_| !asks_else) else {
                continue;
            };
            let question = match found.axis {
                "cutaway" => "What does a cutaway cost relative to the same picture without one?",
                _ => "What does a style cost relative to plain light?",
            };
            let is_asked =
                |b: &ReportBlock| matches!(b, ReportBlock::Heading(_, text) if text == question);
            if !blocks.iter().any(is_asked) {
                blocks.push(ReportBlock::Heading(4, question.to_owned()));
            }
            let answer = cards::sentence(&records, Situation::Mesh);
            let place = match points.setups().count() {
                1 => String::new(),
                _ => format!(" on {}", points.label(setup)),
            };
            blocks.push(ReportBlock::Text(format!(
                "{answer} ({experiment}, run {run}{place})"
            )));
            blocks.push(ReportBlock::Folded {
                summary: "Every picture".to_owned(),
                open: false,
                blocks: vec![ReportBlock::Grid(table(&found))],
            });
        }
    }
    blocks
}

/// A table of the variants: if there are several pictures, it has a column for each value; otherwise a row for each value.
fn table(found: &Variants) -> Grid {
    let factor =
        |ratio: &Option<f64>| ratio.map_or_else(Cell::default, |r| Cell::number(times(r), r));
    let ms = |ms: f64| Cell::number(milliseconds(ms), ms);
    if let [only] = found.rows.as_slice() {
        let mut grid = Grid::new("variants", [found.axis, "all clocks, ms", "×"]);
        grid.row([
            Cell::from(found.base.as_str()),
            ms(only.base_ms),
            Cell::number("×1.00", 1.0),
        ]);
        for (value, ratio) in found.values.iter().zip(&only.ratios) {
            let time = ratio.map_or_else(Cell::default, |r| ms(r * only.base_ms));
            grid.row([Cell::from(value.as_str()), time, factor(ratio)]);
        }
        return grid;
    }
    let base = format!("{}, all clocks, ms", found.base);
    let heading = ["picture".to_owned(), base].into_iter();
    let heading = heading.chain(found.values.iter().map(|v| format!("{v}, ×")));
    let mut grid = Grid::new("variants", heading);
    for row in &found.rows {
        let first = [Cell::from(row.of.as_str()), ms(row.base_ms)];
        grid.row(first.into_iter().chain(row.ratios.iter().map(factor)));
    }
    grid
}
