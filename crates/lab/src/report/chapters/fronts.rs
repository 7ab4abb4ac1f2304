//! Additions to a chart of error against cost: the price of accuracy along the front, and a list used instead if nearly all errors are 0.

use super::charts::{PlottedStrategy, spread};
use super::figures::{label, times};
use crate::experiment::{ChartSynopsis, Ending};
use crate::report::derived::{Offer, Row, Spread, StepPrice, front, steps};
use crate::report::document::{Cell, Grid, Line, Ranking, ReportBlock, Tone};
use crate::report::look::look;
use crate::report::number::figure;

/// The points of the front, the cheapest first, and the table of prices along the front.
pub(super) fn front_of(
    asked: &ChartSynopsis,
    placed: &[PlottedStrategy<'_>],
) -> (Vec<[f64; 2]>, ReportBlock) {
    let offers: Vec<Offer> = placed.iter().map(|p| offer(asked, p)).collect();
    let on_front = front(&offers);
    let prices = ReportBlock::Folded {
        summary: "The cheapest for each error, and the price of accuracy".to_owned(),
        open: false,
        blocks: vec![ReportBlock::Grid(price_table(placed, &offers, &on_front))],
    };
    (on_front.iter().map(|i| placed[*i].at).collect(), prices)
}

/// Returns true if nearly all marks have an error of 0, so that a list is more informative than a chart.
pub(super) fn is_mostly_without_error(
    asked: &ChartSynopsis,
    placed: &[PlottedStrategy<'_>],
) -> bool {
    const FEW: usize = 2;
    let wrong = placed.iter().filter(|p| p.at[1] > 0.0).count();
    asked.pareto && placed.len() >= 2 * FEW && wrong <= FEW
}

/// The strategies of a point, sorted by cost, with their errors as text.
pub(super) fn ranking(
    asked: &ChartSynopsis,
    title: String,
    placed: &[PlottedStrategy<'_>],
) -> Ranking {
    let mut sorted: Vec<&PlottedStrategy<'_>> = placed.iter().collect();
    sorted.sort_by(|a, b| a.at[0].total_cmp(&b.at[0]));
    let line = |p: &&PlottedStrategy<'_>| {
        let (median, mad) = (p.at[0], spread(&p.row, &asked.x));
        let error = Cell::from(figure(p.at[1]));
        Line {
            name: p.row.found().name.clone(),
            look: look(&p.row.found().name),
            cost: Some(Spread {
                least: (median - mad).max(median * 0.5),
                median,
                most: median + mad,
            }),
            words: error.toned(match p.at[1] {
                0.0 => Tone::Good,
                _ => Tone::Fair,
            }),
        }
    };
    let lines: Vec<Line> = sorted.iter().map(line).collect();
    let ends = lines.iter().filter_map(|l| l.cost);
    Ranking {
        title,
        names: "method",
        axis: label(&asked.x),
        is_factor: asked.x.starts_with("ratio"),
        heading: label(&asked.y),
        range: ends.fold([f64::INFINITY, 0.0], |[least, most], s| {
            [least.min(s.least), most.max(s.most)]
        }),
        lines,
    }
}

fn offer(asked: &ChartSynopsis, placed: &PlottedStrategy<'_>) -> Offer {
    Offer {
        error: placed.at[1],
        cost: placed.at[0],
        spread: known_spread(&placed.row, &asked.x),
        is_complete: placed.row.found().outcome == Ending::Complete,
    }
}

/// Minimum number of rounds for a meaningful spread.
const LEAST_ROUNDS: usize = 5;

/// The spread of a figure; 0 if the figure has no spread, `None` if there were too few rounds.
fn known_spread(row: &Row<'_>, figure: &str) -> Option<f64> {
    match row.figures.get(&format!("{figure}.mad")) {
        None => Some(0.0),
        Some(mad) => (row.record.measurement.rounds >= LEAST_ROUNDS).then_some(*mad),
    }
}

fn price_table(placed: &[PlottedStrategy<'_>], offers: &[Offer], on_front: &[usize]) -> Grid {
    let heading = [
        "on the front",
        "error",
        "cost",
        "cost over the previous one",
        "price of each tenfold gain in accuracy",
    ];
    let mut grid = Grid::new("the price of accuracy", heading);
    let steps = steps(offers, on_front);
    for (place, index) in on_front.iter().enumerate() {
        let step = place.checked_sub(1).map(|before| &steps[before]);
        let price = match step {
            None => Cell::from("cheapest").toned(Tone::Faint),
            Some(step) => match step.price {
                StepPrice::Factor(price) => Cell::number(times(price), price),
                StepPrice::ToNoError => Cell::from("to no error at all"),
                StepPrice::TooShort => Cell::from("too short a step").toned(Tone::Faint),
                StepPrice::WithinSpread => Cell::from("within spread").toned(Tone::Faint),
            },
        };
        let over = step.map_or_else(Cell::default, |step| {
            let cell = Cell::number(times(step.cost_ratio), step.cost_ratio);
            match step.is_spread_known {
                true => cell,
                false => Cell {
                    text: format!("{} (spread unknown)", cell.text),
                    ..cell
                },
            }
        });
        let (offer, name) = (&offers[*index], &placed[*index].row.found().name);
        grid.row([
            Cell::from(name.as_str()),
            Cell::number(figure(offer.error), offer.error),
            Cell::number(figure(offer.cost), offer.cost),
            over,
            price,
        ]);
    }
    grid
}
