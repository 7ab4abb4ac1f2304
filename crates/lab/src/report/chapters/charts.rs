//! The charts that an experiment requests.
//!
//! A chart with a Pareto front compares strategies at one point, so each point has its own chart. Any other chart shows all points of a
//! setup. If a parameter of a strategy is swept, the strategy's marks form one series in the order of the parameter.

use super::figures::label;
use super::point::{Points, RecordedPoint};
use super::{fronts, series};
use crate::experiment::{ChartSynopsis, Ending, Parameter};
use crate::report::derived::{Row, natural, rows_by_family};
use crate::report::document::{Chart, ChartAxis, Mark, Panel, ReportBlock, Series, Tone};
use crate::report::look::{Look, look};
use crate::report::number::figure;

/// The requested charts of an experiment, drawn from the experiment's points.
pub(super) fn blocks(
    charts: &[ChartSynopsis],
    points: &Points<'_>,
    all: &[RecordedPoint<'_>],
) -> Vec<ReportBlock> {
    let mut blocks = Vec::new();
    for asked in charts {
        let of_runs = all
            .iter()
            .filter(|p| asked.runs.is_empty() || asked.runs.contains(&p.record.run));
        let mut facets: Vec<(String, Vec<RecordedPoint<'_>>)> = Vec::new();
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
            add_card(&mut blocks, draw_chart(asked, facet, of_facet));
        }
        if blocks.len() == before && facets.iter().all(|(_, of)| !is_drawn(asked, of)) {
            let text = format!(
                "\"{}\" has nothing to show: no record has figures for both `{}` and `{}`.",
                asked.title, asked.x, asked.y
            );
            blocks.push(ReportBlock::Notice(Tone::Fair, text));
        }
    }
    blocks
}

/// Puts a chart next to the previous one, unless it is as wide as the page.
fn add_card(blocks: &mut Vec<ReportBlock>, chart: Vec<ReportBlock>) {
    let is_wide = (chart.iter()).any(|b| matches!(b, ReportBlock::Chart(c) if c.panels.len() > 1));
    match blocks.last_mut() {
        _ if chart.is_empty() => {}
        _ if is_wide => blocks.extend(chart),
        Some(ReportBlock::Cards(cards)) => cards.push(chart),
        _ => blocks.push(ReportBlock::Cards(vec![chart])),
    }
}

/// A strategy at a point, with its position in a chart.
pub(super) struct PlottedStrategy<'a> {
    pub(super) row: Row<'a>,
    pub(super) at: [f64; 2],
    pub(super) series: String,
    /// Values of the other varied parameters; each combination of values has its own drawing.
    pub(super) panel: String,
}

/// All strategies of some points that have both figures of a chart, and the categories of the x axis if its values are not numbers.
fn placed<'a>(
    asked: &ChartSynopsis,
    points: &[RecordedPoint<'a>],
) -> (Vec<PlottedStrategy<'a>>, Vec<String>) {
    let rows: Vec<Row<'_>> = points
        .iter()
        .flat_map(|p| rows_by_family(p.record))
        .collect();
    let categories = categories(asked, &rows);
    let mut placed: Vec<PlottedStrategy<'_>> = Vec::new();
    for row in rows {
        let x = x_of(asked, &categories, &row);
        let y = row.figures.get(&asked.y).copied();
        if let (Some(x), Some(y)) = (x, y) {
            placed.push(PlottedStrategy {
                at: [x, y],
                series: String::new(),
                panel: String::new(),
                row,
            });
        }
    }
    (placed, categories)
}

fn is_drawn(asked: &ChartSynopsis, points: &[RecordedPoint<'_>]) -> bool {
    !placed(asked, points).0.is_empty()
}

fn draw_chart(
    asked: &ChartSynopsis,
    facet: &str,
    points: &[RecordedPoint<'_>],
) -> Vec<ReportBlock> {
    let (mut placed, categories) = placed(asked, points);
    if placed.is_empty() {
        return Vec::new();
    }
    series::name_series(asked, &mut placed);
    let is_log = |axis: &str| asked.log.iter().any(|a| a == axis);
    let title = match facet.trim_start_matches([' ', '·']) {
        "" => asked.title.clone(),
        facet => format!("{} ({facet})", asked.title),
    };
    let note = note(asked, &placed);
    let front = asked.pareto.then(|| fronts::front_of(asked, &placed));
    let (on_front, prices) = front.unzip();
    let mut blocks = match fronts::is_mostly_without_error(asked, &placed) {
        true => vec![
            ReportBlock::Heading(5, title.clone()),
            ReportBlock::Ranking(fronts::ranking(asked, title, &placed)),
            ReportBlock::Text(note),
        ],
        false => vec![ReportBlock::Chart(Chart {
            title,
            note: Some(note),
            x: ChartAxis {
                label: label(&asked.x),
                is_log: is_log("x") && categories.is_empty(),
                categories,
            },
            y: ChartAxis {
                label: label(&asked.y),
                // Errors span several decades, so a chart with a front has a logarithmic y axis.
                is_log: is_log("y") || asked.pareto,
                categories: Vec::new(),
            },
            panels: panels(asked, &placed, &on_front.unwrap_or_default()),
        })],
    };
    blocks.extend(prices);
    blocks
}

/// The note of a chart, which also names the points shown: each run with its values on the sweep axes.
fn note(asked: &ChartSynopsis, placed: &[PlottedStrategy<'_>]) -> String {
    let mut runs: NamedValues<'_, NamedValues<'_, Vec<String>>> = Vec::new();
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

/// A list of named values, in order.
type NamedValues<'n, T> = Vec<(&'n str, T)>;

/// The value with this name in a list; a default value is added if there is none.
fn place_of<'l, 'n, T: Default>(list: &'l mut NamedValues<'n, T>, name: &'n str) -> &'l mut T {
    let place = list.iter().position(|(n, _)| *n == name);
    let place = place.unwrap_or_else(|| {
        list.push((name, T::default()));
        list.len() - 1
    });
    &mut list[place].1
}

/// Values of the x axis in order, if not all are numbers.
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

pub(super) fn spread(row: &Row<'_>, figure: &str) -> f64 {
    let name = format!("{figure}.mad");
    row.figures.get(&name).copied().unwrap_or_default()
}

/// The drawings of a chart: one for each combination of the values that vary besides the strategies.
fn panels(asked: &ChartSynopsis, placed: &[PlottedStrategy<'_>], front: &[[f64; 2]]) -> Vec<Panel> {
    let mut titles: Vec<&str> = Vec::new();
    for p in placed {
        if !titles.contains(&p.panel.as_str()) {
            titles.push(&p.panel);
        }
    }
    let panel = |title: &&str| {
        let of_it = placed.iter().filter(|p| p.panel == **title);
        Panel {
            title: (*title).to_owned(),
            series: series_of(asked, &of_it.collect::<Vec<_>>()),
            front: front.to_vec(),
        }
    };
    titles.iter().map(panel).collect()
}

fn series_of(asked: &ChartSynopsis, placed: &[&PlottedStrategy<'_>]) -> Vec<Series> {
    let mut names: Vec<&str> = Vec::new();
    for p in placed {
        if !names.contains(&p.series.as_str()) {
            names.push(&p.series);
        }
    }
    names
        .into_iter()
        .map(|name| {
            let mut of_it: Vec<&PlottedStrategy<'_>> = placed
                .iter()
                .copied()
                .filter(|p| p.series == name)
                .collect();
            of_it.sort_by(|a, b| in_order(asked, a, b));
            Series {
                name: name.to_owned(),
                look: of_it
                    .first()
                    .map_or_else(Look::default, |p| look(&p.row.found().name)),
                marks: of_it.into_iter().map(|p| mark(asked, p)).collect(),
            }
        })
        .collect()
}

/// Orders marks by the strategy's own parameters if x is a figure; otherwise by x.
fn in_order(
    asked: &ChartSynopsis,
    a: &PlottedStrategy<'_>,
    b: &PlottedStrategy<'_>,
) -> std::cmp::Ordering {
    let values = |p: &PlottedStrategy<'_>| p.row.member.parameters.clone();
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

fn mark(asked: &ChartSynopsis, placed: &PlottedStrategy<'_>) -> Mark {
    let row = &placed.row;
    let describe = |name: &str, value: f64| {
        let word = row
            .parameter(name)
            .map_or_else(|| figure(value), ToString::to_string);
        match spread(row, name) {
            0.0 => format!("{}: {word}", label(name)),
            mad => format!("{}: {word} ± {}", label(name), figure(mad)),
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
