//! What should I use for what I have: a row for each input that runs of the experiments say they stand for.

use super::best;
use super::figures::{counts, percent, ranged};
use super::point::{Point, Points, Setup};
use crate::experiment::{Record, StrategyMeasurement};
use crate::report::derived::{
    BETWEEN_RUNS, Situation, Spread, TOO_MUCH, has_defect, has_other_truth, papers,
};
use crate::report::document::{Block, Cell, Grid, Tone};

/// What the table says of itself.
fn how_to_read() -> String {
    let (between_runs, too_much) = (percent(BETWEEN_RUNS), percent(TOO_MUCH));
    format!(
        "Each row is a kind of input that some run stands for.

- `use` is the cheapest of the strategies that are exact wherever they drew, at more than half of the points, by the clocks that are paid for what
  moves. Cheapest is the least time over that of the fastest at each point, in the median. It is written as `cutaway render --strategy` takes
  it, with what it is limited to in brackets; `×` is its own time over that of drawing only, in the median.
- `or` is the next. It is a draw unless the first is faster at more than half of the points that both drew, by more than the deviations of both over
  the rounds and by more than the {between_runs} by which two runs were seen to differ.
- Nothing is exact on a mesh that is broken: there `use` is the strategy that is wrong least, as a share of the cap there should be. One that loses
  {too_much} of the cap or more, as pixels that are marked or wrong and unmarked, is left out.
- `paper` is the paper's method, `grid:256+vds:1024` (Trapp and Döllner 2013): its time over that of drawing only, and its decided wrong pixels.

Point at a cell for the range over the points. Words are explained further down."
    )
}

/// Points that stand for one input.
struct Input<'a> {
    name: &'a str,
    situation: Situation,
    runs: Vec<String>,
    records: Vec<&'a Record>,
}

/// The table of a setup and its explanation; nothing where no run stands for anything.
pub(super) fn blocks(points: &Points<'_>, setup: &Setup<'_>) -> Vec<Block> {
    let on_it = points.on(setup);
    let inputs = inputs(&on_it);
    if inputs.is_empty() {
        return Vec::new();
    }
    let heading = ["what you have", "what moves", "points"];
    let heading = heading.into_iter().chain(best::COLUMNS);
    let heading = heading.chain(PAPER_COLUMNS);
    let mut grid = Grid::new("what to use for which input", heading);
    for input in &inputs {
        grid.row(row(input));
    }
    vec![Block::Grid(grid), Block::Prose(how_to_read())]
}

fn inputs<'a>(points: &'a [Point<'a>]) -> Vec<Input<'a>> {
    let mut inputs: Vec<Input<'a>> = Vec::new();
    for point in points {
        let Some((run, name)) = point.run().and_then(|r| Some((r, r.input.as_deref()?))) else {
            continue;
        };
        if has_other_truth(point.record) && !has_defect(point.record) {
            continue;
        }
        let situation = Situation::from(run.moves);
        let is_it = |i: &&mut Input<'_>| i.name == name && i.situation == situation;
        let run_name = format!("{}: {}", point.experiment.synopsis.name, run.name);
        match inputs.iter_mut().find(is_it) {
            Some(input) => {
                input.records.push(point.record);
                if !input.runs.contains(&run_name) {
                    input.runs.push(run_name);
                }
            }
            None => inputs.push(Input {
                name,
                situation,
                runs: vec![run_name],
                records: vec![point.record],
            }),
        }
    }
    inputs
}

fn row(input: &Input<'_>) -> Vec<Cell> {
    let records = &input.records;
    let mut cells = vec![
        Cell::from(input.name).titled(input.runs.join("; ")),
        Cell::from(input.situation.describe()),
        Cell::number(records.len().to_string(), records.len() as f64),
    ];
    cells.extend(best::cells(records, input.situation));
    cells.extend(paper(records, input.situation));
    cells
}

/// Headings of the cells of the paper's method.
pub(super) const PAPER_COLUMNS: [&str; 2] = ["paper, ×", "paper, wrong px"];

/// What the paper's method costs at some points, and what it gets wrong.
pub(super) fn paper(records: &[&Record], situation: Situation) -> [Cell; 2] {
    let found: Vec<(&Record, &StrategyMeasurement)> = (records.iter())
        .flat_map(|r| {
            papers(r)
                .into_iter()
                .map(|i| (*r, &r.measurement.strategies[i]))
        })
        .collect();
    let ratios = found.iter().filter_map(|(r, s)| situation.ratio(r, s));
    let wrong = found.iter().filter_map(|(_, s)| s.comparison);
    let wrong = Spread::of(wrong.map(|c| c.decided_wrong_px as f64).collect());
    let tone = match wrong {
        Some(w) if w.most > 0.0 => Tone::Fair,
        _ => Tone::Plain,
    };
    [
        ranged(Spread::of(ratios.collect())),
        counts(wrong).toned(tone),
    ]
}
