//! What strategies get wrong at a point and what they cost there: the table, the samples, and where the time goes.

use std::collections::BTreeSet;

use super::figures::{self, label, mebibytes, timed, wrong_px};
use crate::experiment::{Ending, PassTime, Record, Samples, StrategyMeasurement, Warning};
use crate::plan::Clock;
use crate::report::document::{Bar, Bars, Block, Cell, Grid, Segment, Tone, word_of};
use crate::report::text::milliseconds;

/// Headings of the table before those of figures that only some records have.
const HEADING: [&str; 19] = [
    "strategy",
    "decided wrong px",
    "missed cap",
    "leaked cap",
    "wrong part",
    "crack",
    "outline",
    "interior wrong",
    "unreliable",
    "depth max, px",
    "normal max, °",
    "frame, × draw only ± of the rounds",
    "frame, × uncut by the same rasteriser",
    "cut alone, ns per pixel covered",
    "frame, ms ± of the rounds",
    "cut, ms ± of the rounds",
    "solid, ms ± of the rounds",
    "MiB",
    "outcome",
];

/// Error and cost of each strategy.
pub(super) fn table(record: &Record) -> Grid {
    let more: BTreeSet<&String> = record.figures.iter().flat_map(|f| f.keys()).collect();
    let heading = HEADING.map(str::to_owned).into_iter();
    let heading = heading.chain(more.iter().map(|name| label(name)));
    let mut grid = Grid::new("error and cost", heading);
    let draw_only = &record.measurement.draw_only_ms;
    let mut plain = vec![Cell::default(); HEADING.len()];
    plain[0] = Cell::from("draw only, nothing cut");
    plain[11] = Cell::number("×1", 1.0);
    plain[14] = timed(draw_only);
    grid.row(plain);
    if let Some(uncut) = &record.measurement.draw_only_compute_ms {
        let mut plain = vec![Cell::default(); HEADING.len()];
        plain[0] = Cell::from("draw only by compute, nothing cut");
        let ratio = uncut.over(draw_only);
        plain[11] = figures::ratio(Some(ratio.median), Some(ratio.mad));
        plain[12] = Cell::number("×1", 1.0);
        plain[14] = timed(uncut);
        grid.row(plain);
    }
    for (index, found) in record.measurement.strategies.iter().enumerate() {
        let own = &record.figures[index];
        let more = more.iter().map(|name| {
            own.get(*name)
                .map_or_else(Cell::default, |v| Cell::number(word_of(*v), *v))
        });
        let cells = strategy(found, &record.warnings);
        grid.row(cells.into_iter().chain(more));
    }
    grid
}

fn strategy(found: &StrategyMeasurement, warnings: &[Warning]) -> Vec<Cell> {
    let reason = found.reason.clone().unwrap_or_default();
    let outcome = Cell::from(match found.outcome {
        Ending::Complete => found.outcome.name().to_owned(),
        _ => format!("{}: {reason}", found.outcome.name()),
    });
    let Some(c) = &found.comparison else {
        let mut cells = vec![Cell::default(); HEADING.len()];
        cells[0] = Cell::from(found.name.as_str());
        cells[1] = Cell::from(found.outcome.name()).toned(Tone::Faint);
        cells[18] = outcome.toned(Tone::Faint);
        return cells;
    };
    let count = |n: usize| Cell::number(n.to_string(), n as f64);
    let size = |v: f64, text: String| Cell::number(text, v);
    let ratio = figures::ratio(found.frame_over_draw_only, found.frame_over_draw_only_mad);
    let bytes = found.bytes.solid + found.bytes.cut + found.bytes.frame;
    vec![
        Cell::from(found.name.as_str()),
        wrong_px(c.decided_wrong_px),
        count(c.missed_cap_px),
        count(c.leaked_cap_px),
        count(c.wrong_part_px),
        count(c.crack_px),
        count(c.outline_px),
        count(c.interior_wrong_px),
        count(c.odd_parity_px),
        size(
            c.depth_error_px_max,
            format!("{:.1e}", c.depth_error_px_max),
        ),
        size(
            c.normal_error_deg_max,
            format!("{:.2}", c.normal_error_deg_max),
        ),
        warned(ratio, found, warnings),
        figures::ratio(found.cut.map(|c| c.over_uncut), None),
        (found.cut.and_then(|c| c.ns_per_px))
            .map_or_else(Cell::default, |ns| size(ns, format!("{ns:.1}"))),
        timed(&found.time_ms.frame),
        timed(&found.time_ms.cut),
        timed(&found.time_ms.solid),
        mebibytes(bytes),
        outcome.toned(match found.outcome {
            Ending::Complete => Tone::Plain,
            _ => Tone::Fair,
        }),
    ]
}

/// A figure that a warning concerns says so.
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

/// Every sample that was taken, and the memory of each clock.
pub(super) fn samples(record: &Record) -> Vec<Block> {
    let mut grid = Grid::new(
        "samples",
        [
            "who",
            "clock",
            "median, ms",
            "MAD, ms",
            "samples, ms, in order",
        ],
    );
    let mut add = |who: &str, clock: &str, samples: &Samples| {
        if samples.samples.is_empty() {
            return;
        }
        let all: Vec<String> = samples.samples.iter().map(|s| milliseconds(*s)).collect();
        grid.row([
            Cell::from(who),
            Cell::from(clock),
            Cell::number(milliseconds(samples.median), samples.median),
            Cell::number(milliseconds(samples.mad), samples.mad),
            Cell::from(all.join(", ")),
        ]);
    };
    add("draw only", "frame", &record.measurement.draw_only_ms);
    if let Some(uncut) = &record.measurement.draw_only_compute_ms {
        add("draw only by compute", "frame", uncut);
    }
    let mut memory = Grid::new(
        "memory",
        ["strategy", "solid, MiB", "cut, MiB", "frame, MiB"],
    );
    for found in record
        .measurement
        .strategies
        .iter()
        .filter(|s| s.was_drawn())
    {
        add(&found.name, "solid", &found.time_ms.solid);
        add(&found.name, "cut", &found.time_ms.cut);
        add(&found.name, "frame", &found.time_ms.frame);
        let bytes = [found.bytes.solid, found.bytes.cut, found.bytes.frame];
        let cells = bytes.map(mebibytes);
        memory.row(std::iter::once(Cell::from(found.name.as_str())).chain(cells));
    }
    vec![Block::Grid(memory), Block::Grid(grid)]
}

/// Where the time of each strategy goes; nothing where no pass was timed.
pub(super) fn passes(record: &Record) -> Option<Block> {
    let strategies = record.measurement.strategies.iter();
    let timed: Vec<&StrategyMeasurement> = strategies.filter(|s| !s.passes.is_empty()).collect();
    if timed.is_empty() {
        return None;
    }
    let of = |passes: &[PassTime], clock: Clock| -> Vec<Segment> {
        let of_clock = passes.iter().filter(|p| p.clock == clock);
        of_clock
            .map(|p| Segment {
                name: p.name.clone(),
                ms: p.median_ms,
            })
            .collect()
    };
    let bars = timed.iter().map(|found| Bar {
        name: found.name.clone(),
        segments: Clock::ALL.map(|clock| of(&found.passes, clock)).into(),
    });
    Some(Block::Bars(Bars {
        label: "where the time goes: medians of passes".to_owned(),
        clocks: ["solid", "cut", "frame"].map(str::to_owned).into(),
        bars: bars.collect(),
    }))
}
