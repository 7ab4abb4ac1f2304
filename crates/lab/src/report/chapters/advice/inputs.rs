//! Advice by kind of input: a row for each kind that the experiments' runs represent.

use super::{best, cards};
use crate::experiment::{Record, StrategyMeasurement};
use crate::report::chapters::figures::{counts, percent, ranged};
use crate::report::chapters::point::{Points, RecordedPoint, Setup};
use crate::report::derived::{
    BETWEEN_RUNS, Situation, Spread, TOO_MUCH, has_defect, has_other_truth, papers,
};
use crate::report::document::{Cell, Grid, ReportBlock, Tone};

/// Explanation of how the answers are derived.
fn how_to_read() -> String {
    let (between_runs, too_much) = (percent(BETWEEN_RUNS), percent(TOO_MUCH));
    format!(
        "Each row is a kind of input that at least one run represents.

- `use` is the cheapest of the methods that are exact wherever they drew, at more than half of the points. The time is that of the clocks that run
  when the input under `what moves` changes. At each point it is divided by the time of the fastest method; the cheapest method has the smallest median.
  `use` is written as for `cutaway render --strategy`, with limits in brackets; `×` is the method's median time relative to drawing the uncut scene.
- `or` is the second method. It is a draw unless the first is faster at more than half of the points that both drew, by more than the sum of both
  methods' deviations over the rounds and by more than {between_runs}, by which two runs were seen to differ.
- On a broken mesh no method is exact. There, `use` is the method with the fewest wrong pixels, as a share of the exact cap. A method that loses
  {too_much} of the cap or more, as pixels that are marked or are wrong and unmarked, is left out.
- `paper` is the method of Trapp and Döllner (2013), `grid:256+vds:1024`: its time relative to drawing uncut, and its decided wrong pixels.

In the charts a filled marker is an exact method, a hollow one has wrong pixels; the bar is the range over the points."
    )
}

/// Points that represent one kind of input.
struct InputRecords<'a> {
    name: &'a str,
    situation: Situation,
    runs: Vec<String>,
    records: Vec<&'a Record>,
}

/// The table of a setup and its explanation; empty if no run represents a kind of input.
pub(in crate::report::chapters) fn blocks(
    points: &Points<'_>,
    setup: &Setup<'_>,
) -> Vec<ReportBlock> {
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
    let all = inputs.iter().map(|i| (i.records.clone(), i.situation));
    let range = cards::range_of(all);
    let cards = inputs.iter().map(|input| card(input, range)).collect();
    vec![
        ReportBlock::Grid(grid),
        ReportBlock::Cards(cards),
        ReportBlock::Folded {
            summary: "How these answers are derived".to_owned(),
            open: false,
            blocks: vec![ReportBlock::Prose(how_to_read())],
        },
    ]
}

/// The answer for an input in a sentence and a chart.
fn card(input: &InputRecords<'_>, range: [f64; 2]) -> Vec<ReportBlock> {
    let title = format!("{}, {}", input.name, input.situation.describe());
    let ranking = cards::ranking(&title, &input.records, input.situation, range);
    let answer = cards::sentence(&input.records, input.situation);
    let head = [ReportBlock::Heading(5, title), ReportBlock::Text(answer)];
    head.into_iter().chain(ranking).collect()
}

fn inputs<'a>(points: &'a [RecordedPoint<'a>]) -> Vec<InputRecords<'a>> {
    let mut inputs: Vec<InputRecords<'a>> = Vec::new();
    for point in points {
        let Some((run, name)) = point.run().and_then(|r| Some((r, r.input.as_deref()?))) else {
            continue;
        };
        if has_other_truth(point.record) && !has_defect(point.record) {
            continue;
        }
        let situation = Situation::from(run.moves);
        let is_it = |i: &&mut InputRecords<'_>| i.name == name && i.situation == situation;
        let run_name = format!("{}: {}", point.experiment.synopsis.name, run.name);
        match inputs.iter_mut().find(is_it) {
            Some(input) => {
                input.records.push(point.record);
                if !input.runs.contains(&run_name) {
                    input.runs.push(run_name);
                }
            }
            None => inputs.push(InputRecords {
                name,
                situation,
                runs: vec![run_name],
                records: vec![point.record],
            }),
        }
    }
    inputs
}

fn row(input: &InputRecords<'_>) -> Vec<Cell> {
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
pub(in crate::report::chapters) const PAPER_COLUMNS: [&str; 2] = ["paper, ×", "paper, wrong px"];

/// Cost and errors of the paper's method at some points.
pub(in crate::report::chapters) fn paper(records: &[&Record], situation: Situation) -> [Cell; 2] {
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
