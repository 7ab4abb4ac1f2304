//! The charts that an experiment asks for.
//!
//! A chart of a front compares strategies at one point, so each point has its own; any other has all points of a setup. Marks of
//! one strategy under a sweep of its parameter are one series, in the order of the parameter.

use super::figures::{label, times};
use super::point::{Point, Points};
use crate::experiment::ChartSynopsis;
use crate::experiment::{Ending, Parameter};
use crate::report::derived::{Offer, Price, Row, front, natural, rows_by_family, steps};
use crate::report::document::{Axis, Block, Cell, Chart, Grid, Mark, Series, Tone, word_of};

/// All charts of a definition, from the points of its experiment.
pub(super) fn blocks(
    charts: &[ChartSynopsis],
    points: &Points<'_>,
    all: &[Point<'_>],
) -> Vec<Block> {
    let mut blocks = Vec::new();
    for asked in charts {
        let of_runs = all
            .iter()
            .filter(|p| asked.runs.is_empty() || asked.runs.contains(&p.record.run));
        let mut facets: Vec<(String, Vec<Point<'_>>)> = Vec::new();
        for point in of_runs {
            let facet = match asked.pareto {
                true => format!("{}{}", point.name(), points.on_whom(point)),
                false => points.on_whom(point),
            };
            match facets.iter_mut().find(|(name, _)| *name == facet) {
                Some((_, of_facet)) => of_facet.push(*point),
                None => facets.push((facet, vec![*point])),
            }
        }
        let before = blocks.len();
        for (facet, of_facet) in &facets {
            let facet = if facets.len() > 1 { facet.as_str() } else { "" };
            blocks.extend(draw_chart(asked, facet, of_facet));
        }
        if blocks.len() == before {
            let text = format!(
                "\"{}\" has nothing to show: no record has figures for both `{}` and `{}`.",
                asked.title, asked.x, asked.y
            );
            blocks.push(Block::Notice(Tone::Fair, text));
        }
    }
    blocks
}

/// A strategy at a point with its place in a chart.
struct Placed<'a> {
    row: Row<'a>,
    at: [f64; 2],
    series: String,
}

fn draw_chart(asked: &ChartSynopsis, facet: &str, points: &[Point<'_>]) -> Vec<Block> {
    let rows: Vec<Row<'_>> = points
        .iter()
        .flat_map(|p| rows_by_family(p.record))
        .collect();
    let categories = categories(asked, &rows);
    let mut placed: Vec<Placed<'_>> = Vec::new();
    for row in rows {
        let x = x_of(asked, &categories, &row);
        let y = row.figures.get(&asked.y).copied();
        if let (Some(x), Some(y)) = (x, y) {
            placed.push(Placed {
                at: [x, y],
                series: String::new(),
                row,
            });
        }
    }
    if placed.is_empty() {
        return Vec::new();
    }
    name_series(asked, &mut placed);
    let is_log = |axis: &str| asked.log.iter().any(|a| a == axis);
    let mut chart = Chart {
        title: match facet.trim_start_matches([' ', '·']) {
            "" => asked.title.clone(),
            facet => format!("{} ({facet})", asked.title),
        },
        note: Some(note(asked, &placed)),
        x: Axis {
            label: label(&asked.x),
            is_log: is_log("x") && categories.is_empty(),
            categories,
        },
        y: Axis {
            label: label(&asked.y),
            // Errors span decades.
            is_log: is_log("y") || asked.pareto,
            categories: Vec::new(),
        },
        ..Chart::default()
    };
    let mut prices = None;
    if asked.pareto {
        let offers: Vec<Offer> = placed.iter().map(|p| offer(asked, p)).collect();
        let on_front = front(&offers);
        chart.front = on_front.iter().map(|i| placed[*i].at).collect();
        prices = Some(price_table(&placed, &offers, &on_front));
    }
    chart.series = series(asked, &placed);
    let mut blocks = vec![Block::Chart(chart)];
    blocks.extend(prices.into_iter().map(Block::Grid));
    blocks
}

/// The note of a chart, and which points it shows: each run with the values that its axes have there.
fn note(asked: &ChartSynopsis, placed: &[Placed<'_>]) -> String {
    let mut runs: Named<'_, Named<'_, Vec<String>>> = Vec::new();
    for record in placed.iter().map(|p| p.row.record) {
        let run = place_of(&mut runs, record.run.as_str());
        for (axis, value) in &record.parameters {
            let values = place_of(run, axis.as_str());
            let value = value.to_string();
            if !values.contains(&value) {
                values.push(value);
            }
        }
    }
    let shown = runs.into_iter().map(|(run, axes)| {
        let axes = axes.iter();
        let words = axes.map(|(name, values)| format!("{name} = {}", values.join(", ")));
        std::iter::once(format!("run `{run}`"))
            .chain(words)
            .collect::<Vec<_>>()
            .join("; ")
    });
    let shown = shown.collect::<Vec<_>>().join("; ");
    match asked.note.as_deref().map(|n| n.trim_end_matches('.')) {
        None => format!("Shown: {shown}."),
        Some(note) => format!("{note}. Shown: {shown}."),
    }
}

/// A list by names, in their order.
type Named<'n, T> = Vec<(&'n str, T)>;

/// What a list has under a name, added where it has nothing.
fn place_of<'l, 'n, T: Default>(list: &'l mut Named<'n, T>, name: &'n str) -> &'l mut T {
    let place = list.iter().position(|(n, _)| *n == name);
    let place = place.unwrap_or_else(|| {
        list.push((name, T::default()));
        list.len() - 1
    });
    &mut list[place].1
}

/// Values of the x axis in order, where they are not all numbers.
fn categories(asked: &ChartSynopsis, rows: &[Row<'_>]) -> Vec<String> {
    let values = || rows.iter().filter_map(|r| r.parameter(&asked.x));
    if values().all(|v| v.number().is_some()) {
        return Vec::new();
    }
    let mut names: Vec<String> = values().map(ToString::to_string).collect();
    names.sort_by(|a, b| natural(a, b));
    names.dedup();
    names
}

fn x_of(asked: &ChartSynopsis, categories: &[String], row: &Row<'_>) -> Option<f64> {
    match row.parameter(&asked.x) {
        None => row.figures.get(&asked.x).copied(),
        Some(value) if categories.is_empty() => value.number(),
        Some(value) => {
            let name = value.to_string();
            categories.iter().position(|c| *c == name).map(|i| i as f64)
        }
    }
}

fn offer(asked: &ChartSynopsis, placed: &Placed<'_>) -> Offer {
    Offer {
        error: placed.at[1],
        cost: placed.at[0],
        spread: known_spread(&placed.row, &asked.x),
        is_complete: placed.row.found().outcome == Ending::Complete,
    }
}

/// Rounds from which on a spread means something.
const LEAST_ROUNDS: usize = 5;

/// The spread of a figure, 0 where it has none; none where there were too few rounds.
fn known_spread(row: &Row<'_>, figure: &str) -> Option<f64> {
    match row.figures.get(&format!("{figure}.mad")) {
        None => Some(0.0),
        Some(mad) => (row.record.measurement.rounds >= LEAST_ROUNDS).then_some(*mad),
    }
}

fn spread(row: &Row<'_>, figure: &str) -> f64 {
    let name = format!("{figure}.mad");
    row.figures.get(&name).copied().unwrap_or_default()
}

/// Figures of the scene: what is varied of it is what is along x.
const OF_SCENE: [&str; 2] = ["triangles", "pixels"];

/// A series has one strategy and one value of whatever is varied over the chart, but for what is along x: where that is a parameter,
/// all other parameters are told apart; where it is a figure, the strategy's own parameters run along the series.
fn name_series(asked: &ChartSynopsis, placed: &mut [Placed<'_>]) {
    let is_of_scene = OF_SCENE.contains(&asked.x.as_str());
    let mut names: Vec<&String> = placed
        .iter()
        .flat_map(|p| p.row.record.parameters.keys())
        .filter(|name| **name != asked.x && !is_of_scene)
        .collect();
    names.sort();
    names.dedup();
    let varies = |name: &&String| {
        let first = placed[0].row.record.parameters.get(*name);
        placed
            .iter()
            .any(|p| p.row.record.parameters.get(*name) != first)
    };
    let names: Vec<String> = names.into_iter().filter(|n| varies(n)).cloned().collect();
    let has_runs = placed
        .iter()
        .any(|p| p.row.record.run != placed[0].row.record.run);
    for p in placed {
        let mut words = vec![who(asked, &p.row, is_of_scene)];
        if has_runs {
            words.push(p.row.record.run.clone());
        }
        for name in &names {
            if let Some(value) = p.row.record.parameters.get(name) {
                words.push(format!("{name} = {value}"));
            }
        }
        p.series = words.join(", ");
    }
}

/// What a series calls its strategy.
fn who(asked: &ChartSynopsis, row: &Row<'_>, is_of_scene: bool) -> String {
    let own = &row.member.parameters;
    let runs_along = own.contains_key(&asked.x);
    let is_figure = row.parameter(&asked.x).is_none() && !is_of_scene;
    let others = own.iter().filter(|(name, _)| **name != asked.x);
    match (runs_along, is_figure) {
        (false, true) => row.member.family.clone(),
        (false, false) => row.found().name.clone(),
        (true, _) => others.fold(row.member.family.clone(), |family, (name, value)| {
            family.replace(&format!("{{{name}}}"), &value.to_string())
        }),
    }
}

fn series(asked: &ChartSynopsis, placed: &[Placed<'_>]) -> Vec<Series> {
    let mut names: Vec<&str> = Vec::new();
    for p in placed {
        if !names.contains(&p.series.as_str()) {
            names.push(&p.series);
        }
    }
    names
        .into_iter()
        .map(|name| {
            let mut of_it: Vec<&Placed<'_>> = placed.iter().filter(|p| p.series == name).collect();
            of_it.sort_by(|a, b| in_order(asked, a, b));
            Series {
                name: name.to_owned(),
                marks: of_it.into_iter().map(|p| mark(asked, p)).collect(),
            }
        })
        .collect()
}

/// By the strategy's own parameters where x is a figure, else along x.
fn in_order(asked: &ChartSynopsis, a: &Placed<'_>, b: &Placed<'_>) -> std::cmp::Ordering {
    let values = |p: &Placed<'_>| p.row.member.parameters.clone();
    let along_x = a.at[0].total_cmp(&b.at[0]);
    if a.row.parameter(&asked.x).is_some() {
        return along_x;
    }
    let (a, b) = (values(a), values(b));
    let pairs = a.values().zip(b.values());
    let by_value = |(a, b): (&Parameter, &Parameter)| natural(&a.to_string(), &b.to_string());
    let by_values = pairs.fold(std::cmp::Ordering::Equal, |o, pair| o.then(by_value(pair)));
    by_values.then(along_x)
}

fn mark(asked: &ChartSynopsis, placed: &Placed<'_>) -> Mark {
    let row = &placed.row;
    let describe = |figure: &str, value: f64| {
        let word = row
            .parameter(figure)
            .map_or_else(|| word_of(value), ToString::to_string);
        match spread(row, figure) {
            0.0 => format!("{}: {word}", label(figure)),
            mad => format!("{}: {word} ± {}", label(figure), word_of(mad)),
        }
    };
    let found = row.found();
    let is_doubtful = found.outcome != Ending::Complete;
    let mut title = vec![
        found.name.clone(),
        describe(&asked.x, placed.at[0]),
        describe(&asked.y, placed.at[1]),
    ];
    title.extend(is_doubtful.then(|| found.outcome.name().to_owned()));
    Mark {
        at: placed.at,
        spread: [spread(row, &asked.x), spread(row, &asked.y)],
        title: title.join("\n"),
        is_doubtful,
    }
}

fn price_table(placed: &[Placed<'_>], offers: &[Offer], on_front: &[usize]) -> Grid {
    let heading = [
        "on the front",
        "error",
        "cost",
        "cost over the one before",
        "price of each tenfold of accuracy",
    ];
    let mut grid = Grid::new("the price of accuracy", heading);
    let steps = steps(offers, on_front);
    for (place, index) in on_front.iter().enumerate() {
        let step = place.checked_sub(1).map(|before| &steps[before]);
        let price = match step {
            None => Cell::from("cheapest").toned(Tone::Faint),
            Some(step) => match step.price {
                Price::Factor(price) => Cell::number(times(price), price),
                Price::ToNoError => Cell::from("to no error at all"),
                Price::TooShort => Cell::from("too short a step").toned(Tone::Faint),
                Price::WithinSpread => Cell::from("within spread").toned(Tone::Faint),
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
            Cell::number(word_of(offer.error), offer.error),
            Cell::number(word_of(offer.cost), offer.cost),
            over,
            price,
        ]);
    }
    grid
}
