//! Errors and costs of strategies at some points: the table, the samples, and the time of each pass.

use std::collections::BTreeSet;

use cutaway::plan::Clock;

use super::figures::{self, label, timed, wrong_px};
use crate::experiment::{Ending, MedianPassTime, Record, Samples, StrategyMeasurement, Warning};
use crate::report::document::{Bar, Bars, Cell, Grid, ReportBlock, Segment, Tone};
use crate::report::errors::ERRORS;
use crate::report::number::{figure, mebibytes, significant};

/// Column headings after the error columns and before the figures that only some records have.
const HEADING: [&str; 11] = [
    "depth max, px",
    "normal max, °",
    "frame, × draw only ± of the rounds",
    "frame, × uncut by the same rasteriser",
    "cut alone, ns per pixel covered",
    "frame, ms ± of the rounds",
    "cut, ms ± of the rounds",
    "solid, ms ± of the rounds",
    "MiB of the frame",
    "MiB of the cut",
    "MiB of the solid",
];

/// Columns before those of [`HEADING`]: the name, the outcome, and the errors.
const COLUMNS_BEFORE: usize = 2 + ERRORS.len();

/// Index of the first ratio column among all columns; the row of the uncut scene has a value in it.
const RATIO: usize = COLUMNS_BEFORE + 2;
const RATIO_UNCUT: usize = COLUMNS_BEFORE + 3;
const FRAME: usize = COLUMNS_BEFORE + 5;

/// A point's label and record. The label is shown next to the method; it is empty if there is no other point.
pub(super) type Labelled<'a> = (String, &'a Record);

/// Error and cost of each strategy at some points. Columns that contain only zeros are left out and listed below the table.
pub(super) fn table(points: &[Labelled<'_>]) -> Vec<ReportBlock> {
    let named = |name: &str, label: &str| match label {
        "" => name.to_owned(),
        label => format!("{name}, {label}"),
    };
    let mut grid = empty("strategy", points);
    for (label, record) in points {
        let name = |text: &str| named(text, label);
        let draw_only = &record.measurement.draw_only_ms;
        let one = || Cell::number("×1.00", 1.0);
        let plain = uncut(one(), Cell::default(), draw_only);
        grid.row(std::iter::once(Cell::from(name("draw only, nothing cut"))).chain(plain));
        if let Some(compute) = &record.measurement.draw_only_compute_ms {
            let ratio = compute.over(draw_only);
            let ratio = figures::ratio(Some(ratio.median), Some(ratio.mad));
            let plain = uncut(ratio, one(), compute);
            let first = Cell::from(name("draw only by compute, nothing cut"));
            grid.row(std::iter::once(first).chain(plain));
        }
        for (index, found) in record.measurement.strategies.iter().enumerate() {
            let first = Cell::from(name(&found.name));
            grid.row(std::iter::once(first).chain(cells(points, record, index)));
        }
    }
    finished(grid)
}

/// Error and cost of one strategy, with a row for each point that requests it.
pub(super) fn of_method(name: &str, points: &[Labelled<'_>]) -> Vec<ReportBlock> {
    let mut grid = empty("point", points);
    for (label, record) in points {
        let strategies = record.measurement.strategies.iter();
        if let Some(index) = strategies.into_iter().position(|s| s.name == name) {
            let mut cells = cells(points, record, index);
            // The reasons for refusals have their own table.
            if let Some((outcome, reason)) = cells[0].text.split_once(": ") {
                let short = Cell::from(outcome).toned(cells[0].tone);
                cells[0] = short.titled(reason.to_owned());
            }
            let first = Cell::from(label.as_str());
            grid.row(std::iter::once(first).chain(cells));
        }
    }
    finished(grid)
}

/// Names of the additional figures that only some records have.
fn more<'a>(points: &[Labelled<'a>]) -> BTreeSet<&'a String> {
    let all = points.iter().flat_map(|(_, record)| &record.figures);
    all.flat_map(|figures| figures.keys()).collect()
}

fn empty(first: &str, points: &[Labelled<'_>]) -> Grid {
    let errors = ERRORS.iter().map(|(word, _)| (*word).to_owned());
    let heading = [first, "outcome"].map(str::to_owned).into_iter();
    let heading = heading.chain(errors).chain(HEADING.map(str::to_owned));
    let heading: Vec<String> = heading
        .chain(more(points).into_iter().map(|name| label(name)))
        .collect();
    Grid::new("error and cost", heading)
}

fn finished(mut grid: Grid) -> Vec<ReportBlock> {
    let left_out = grid.without_zeros(&["decided wrong px"]);
    let note = (!left_out.is_empty())
        .then(|| ReportBlock::Text(format!("0 in every row: {}.", left_out.join(", "))));
    std::iter::once(ReportBlock::Grid(grid))
        .chain(note)
        .collect()
}

/// The cells of the uncut scene's row, except the first.
fn uncut(ratio: Cell, uncut: Cell, time: &Samples) -> Vec<Cell> {
    let mut plain = vec![Cell::default(); COLUMNS_BEFORE + HEADING.len() - 1];
    plain[RATIO - 1] = ratio;
    plain[RATIO_UNCUT - 1] = uncut;
    plain[FRAME - 1] = timed(time);
    plain
}

/// The cells of a strategy's row, except the first.
fn cells(points: &[Labelled<'_>], record: &Record, index: usize) -> Vec<Cell> {
    let own = &record.figures[index];
    let more = more(points).into_iter().map(|name| {
        own.get(name)
            .map_or_else(Cell::default, |v| Cell::number(figure(*v), *v))
    });
    let found = &record.measurement.strategies[index];
    let cells = strategy(found, &record.warnings).into_iter();
    cells.chain(more).collect()
}

fn strategy(found: &StrategyMeasurement, warnings: &[Warning]) -> Vec<Cell> {
    let reason = found.reason.clone().unwrap_or_default();
    let outcome = match found.outcome {
        Ending::Complete => Cell::default(),
        _ => Cell::from(format!("{}: {reason}", found.outcome.name())).toned(Tone::Fair),
    };
    let mut cells = vec![outcome];
    let Some(c) = &found.comparison else {
        cells[0].tone = Tone::Faint;
        cells.resize(COLUMNS_BEFORE + HEADING.len() - 1, Cell::default());
        return cells;
    };
    cells.extend(
        ERRORS
            .iter()
            .enumerate()
            .map(|(place, (_, count))| match place {
                0 => wrong_px(count(c)),
                _ => Cell::number(count(c).to_string(), count(c) as f64),
            }),
    );
    let number = |v: f64| Cell::number(significant(v), v);
    let ratio = figures::ratio(found.frame_over_draw_only, found.frame_over_draw_only_mad);
    cells.extend([
        number(c.depth_error_px_max),
        number(c.normal_error_deg_max),
        warned(ratio, found, warnings),
        figures::ratio(found.cut.map(|c| c.over_uncut), None),
        (found.cut.and_then(|c| c.ns_per_px)).map_or_else(Cell::default, number),
        timed(&found.time_ms.frame),
        timed(&found.time_ms.cut),
        timed(&found.time_ms.solid),
    ]);
    let bytes = [found.bytes.frame, found.bytes.cut, found.bytes.solid];
    cells.extend(bytes.map(|b| Cell::number(mebibytes(b), b as f64)));
    cells
}

/// Adds the warnings that concern a figure to its cell.
fn warned(cell: Cell, found: &StrategyMeasurement, warnings: &[Warning]) -> Cell {
    let of_it = warnings
        .iter()
        .filter(|w| w.concerns() == Some(&found.name));
    let words: Vec<String> = of_it.map(Warning::text).collect();
    if words.is_empty() {
        return cell;
    }
    let text = format!("{} !", cell.text);
    Cell { text, ..cell }
        .toned(Tone::Fair)
        .titled(words.join("; "))
}

/// Time of each strategy by pass, and every sample; `None` if no time was taken.
pub(super) fn passes(record: &Record) -> Option<ReportBlock> {
    let of = |passes: &[MedianPassTime], clock: Clock| -> Vec<Segment> {
        let of_clock = passes.iter().filter(|p| p.clock == clock);
        of_clock
            .map(|p| Segment {
                name: p.name.clone(),
                ms: p.median_ms,
            })
            .collect()
    };
    let measurement = &record.measurement;
    let uncut = |name: &str, frame: &Samples| Bar {
        name: name.to_owned(),
        segments: Vec::new(),
        samples: vec![Vec::new(), Vec::new(), frame.samples.clone()],
    };
    let draw_only = std::iter::once(uncut("draw only", &measurement.draw_only_ms));
    let compute = measurement.draw_only_compute_ms.iter();
    let compute = compute.map(|time| uncut("draw only by compute", time));
    let drawn = measurement.strategies.iter().filter(|s| s.was_drawn());
    let drawn = drawn.map(|found| Bar {
        name: found.name.clone(),
        segments: Clock::ALL.map(|clock| of(&found.passes, clock)).into(),
        samples: [
            &found.time_ms.solid,
            &found.time_ms.cut,
            &found.time_ms.frame,
        ]
        .map(|time| time.samples.clone())
        .into(),
    });
    let bars: Vec<Bar> = draw_only.chain(compute).chain(drawn).collect();
    let is_timed = |bar: &Bar| bar.samples.iter().any(|s| !s.is_empty());
    bars.iter().any(is_timed).then(|| {
        ReportBlock::Bars(Bars {
            label: "where the time goes: medians of passes, and every sample".to_owned(),
            clocks: ["solid", "cut", "frame"].map(str::to_owned).into(),
            bars,
        })
    })
}
