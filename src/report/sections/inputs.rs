//! What should I use for what I have: a row for each input that runs of the experiments say they stand for.

use super::figures::{counts, percent, ranged, times};
use super::point::{Bench, Point, Points};
use crate::experiment::{Record, StrategyMeasurement};
use crate::report::derived::{
    Advised, Harm, Situation, Spread, advised, harms, has_defect, has_other_truth, papers,
};
use crate::report::document::{Block, Cell, Grid, Tone};

/// What the table says of itself.
const HOW_TO_READ: &str = "A row for each kind of input that some run stands for. `use` is the cheapest strategy that is exact wherever it \
    drew, at half of the points or more, by the clocks that are paid for what moves; `or` is the next. Nothing is exact on a mesh that is broken: there `use` is who \
    is wrong least, as a share of the cap there should be, and `or` who leaves least of what is wrong unmarked. `@compute` is the compute rasteriser, without it the \
    hardware's is used. `paper` is the paper's path: its time over that of drawing only, and its decided wrong pixels. Point at a cell for the range.";

/// Points that stand for one input.
struct Input<'a> {
    name: &'a str,
    situation: Situation,
    runs: Vec<String>,
    records: Vec<&'a Record>,
}

/// The table of a bench, with its explanation where it is the first; nothing where no run stands for anything.
pub(super) fn blocks(points: &Points<'_>, bench: &Bench<'_>) -> Vec<Block> {
    let on_it = points.on(bench);
    let inputs = inputs(&on_it);
    if inputs.is_empty() {
        return Vec::new();
    }
    let heading = [
        "what you have",
        "what moves",
        "points",
        "use",
        "× draw only",
        "or",
        "paper, ×",
        "paper, wrong px",
    ];
    let mut grid = Grid::new("what to use for which input", heading);
    for input in &inputs {
        grid.row(row(input));
    }
    vec![Block::Text(HOW_TO_READ.to_owned()), Block::Grid(grid)]
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
        let told = format!("{}: {}", point.experiment.definition.name, run.name);
        match inputs.iter_mut().find(is_it) {
            Some(input) => {
                input.records.push(point.record);
                if !input.runs.contains(&told) {
                    input.runs.push(told);
                }
            }
            None => inputs.push(Input {
                name,
                situation,
                runs: vec![told],
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
        Cell::from(input.situation.told()),
        Cell::number(records.len().to_string(), records.len() as f64),
    ];
    match records.iter().all(|r| has_other_truth(r)) {
        true => cells.extend(of_broken(&harms(records))),
        false => cells.extend(of_sound(&advised(records, input.situation), records.len())),
    }
    let found: Vec<(&Record, &StrategyMeasurement)> = (records.iter())
        .flat_map(|r| {
            papers(r)
                .into_iter()
                .map(|i| (*r, &r.measurement.strategies[i]))
        })
        .collect();
    let ratios = found
        .iter()
        .filter_map(|(r, s)| input.situation.ratio(r, s));
    cells.push(ranged(Spread::of(ratios.collect())));
    let wrong = found.iter().filter_map(|(_, s)| s.comparison);
    let wrong = Spread::of(wrong.map(|c| c.decided_wrong_px as f64).collect());
    cells.push(counts(wrong).toned(match wrong {
        Some(w) if w.most > 0.0 => Tone::Fair,
        _ => Tone::Plain,
    }));
    cells
}

/// Who is exact: the first, its cost, and the next.
fn of_sound(advised: &[Advised], points: usize) -> [Cell; 3] {
    let at = |s: &Advised| format!("exact at {} of {points} points", s.exact);
    let Some(first) = advised.first() else {
        let none = Cell::from("none is exact").toned(Tone::Bad);
        return [none, Cell::default(), Cell::default()];
    };
    let next = advised.get(1).map_or_else(Cell::default, |s| {
        Cell::from(format!("{} {}", s.name, times(s.ratio.median))).titled(at(s))
    });
    let name = Cell::from(first.name.as_str());
    [
        name.toned(Tone::Good).titled(at(first)),
        ranged(Some(first.ratio)),
        next,
    ]
}

/// Who is least wrong, its cost, and who marks best.
fn of_broken(harms: &[Harm]) -> [Cell; 3] {
    let told = |h: &Harm, share: Option<Spread>, what: &str| {
        let share = share.map_or_else(String::new, |s| percent(s.median));
        let text = format!("{}: {share} {what}", h.standing.name);
        let (drawn, asked) = (h.standing.drawn, h.standing.asked);
        Cell::from(text).titled(format!("median; drawn at {drawn} of {asked} points"))
    };
    let Some(first) = harms.first() else {
        return [Cell::default(), Cell::default(), Cell::default()];
    };
    let best = best_marker(harms);
    [
        told(first, first.wrong, "wrong").toned(Tone::Fair),
        ranged(first.standing.ratio),
        best.map_or_else(Cell::default, |h| told(h, h.unmarked, "wrong unmarked")),
    ]
}

/// Who leaves least unmarked of what it gets wrong, by the median and then the worst; a refusal somewhere is no picture.
pub(super) fn best_marker(harms: &[Harm]) -> Option<&Harm> {
    let key = |h: &Harm| {
        h.unmarked
            .map_or([f64::INFINITY; 2], |s| [s.median, s.most])
    };
    let all = harms.iter().filter(|h| h.standing.refused() == 0);
    all.min_by(|a, b| {
        let ([a, a_most], [b, b_most]) = (key(a), key(b));
        a.total_cmp(&b).then(a_most.total_cmp(&b_most))
    })
}
