//! What should I use: the short answers, all of them worked out from the records.

use super::figures::{ranged, times};
use super::point::{Point, Points, Setup};
use super::{best, broken, counted, figures, inputs};
use crate::experiment::Record;
use crate::report::derived::{
    Kind, Situation, Spread, StrategyTotals, has_other_truth, is_exact, papers,
    totals_of_strategies,
};
use crate::report::document::{Block, Cell, Grid, Tone};
use crate::strategies::Strategy;

pub(super) fn chapter(points: &Points<'_>) -> Vec<Block> {
    if points.all.is_empty() {
        return Vec::new();
    }
    let mut blocks = Vec::new();
    for setup in points.setups() {
        let answers = inputs::blocks(points, setup);
        if !answers.is_empty() {
            blocks.push(heading("What should I use for what I have?"));
            blocks.extend(whose(points, setup));
            blocks.extend(answers);
        }
    }
    blocks.push(heading("Which strategy is exact, and what does it cost?"));
    blocks.push(Block::Text(
        "A strategy is exact at a point if it drew the whole frame and has no wrong pixel where the reference is sure. \
         The ratio is the time of a frame over that of drawing the same scene with nothing cut: median, and on pointing at it the range. \
         Strategies that only occur in sweeps over their own parameter are in the charts of their experiment."
            .to_owned(),
    ));
    let others = points.all.iter().filter(|p| has_other_truth(p.record));
    let others = others.count();
    if others > 0 {
        blocks.push(Block::Text(format!(
            "Left out here, in what the paper's path costs, and in what moves: {} judged by the exact image of another scene, as broken meshes are \
             by that of the whole one. They have a table of their own below.",
            counted(others, "point")
        )));
    }
    for setup in points.setups() {
        let on_it = sound(points.on(setup));
        let records: Vec<&Record> = on_it.iter().map(|p| p.record).collect();
        blocks.extend(whose(points, setup));
        blocks.push(Block::Grid(exactness(&totals_of_strategies(&records))));
    }
    blocks.push(heading(
        "What does the paper's path cost, and what does it miss?",
    ));
    blocks.extend(points.setups().map(|setup| {
        let records: Vec<&Record> = (sound(points.on(setup)).iter()).map(|p| p.record).collect();
        Block::Text(papers_path(&points.label(setup), &records))
    }));
    blocks.push(heading("Which one for what moves?"));
    blocks.push(Block::Text(
        "The same ranking as for inputs, over all points of one kind of cut, when only the view moves (clock of the frame), the cut moves \
         (frame and cut), or the mesh moves (all clocks). `exact at` counts the points that have an exact strategy."
            .to_owned(),
    ));
    for setup in points.setups() {
        blocks.extend(whose(points, setup));
        blocks.push(Block::Grid(by_situation(&sound(points.on(setup)))));
    }
    if others > 0 {
        blocks.push(heading("Which strategies cope with broken meshes?"));
        blocks.push(Block::Text(
            "A row for each defect and strategy: decided wrong pixels as a share of the cap of the whole mesh, median and worst over the points where \
             something is broken; how many of them are not marked as unreliable; and how many pixels are marked, wrong or not."
                .to_owned(),
        ));
    }
    for setup in points.setups() {
        if let Some(grid) = broken::grid(&points.on(setup)) {
            blocks.extend(whose(points, setup));
            blocks.push(Block::Grid(grid));
        }
    }
    blocks.push(heading("Answers by question"));
    for setup in points.setups() {
        blocks.extend(whose(points, setup));
        blocks.push(Block::Grid(by_question(points, &points.on(setup))));
    }
    blocks
}

fn heading(text: &str) -> Block {
    Block::Heading(4, text.to_owned())
}

/// Whose figures follow, where there are several.
fn whose(points: &Points<'_>, setup: &Setup<'_>) -> Option<Block> {
    (points.setups().count() > 1).then(|| Block::Heading(5, points.label(setup)))
}

/// Points that are judged by their own exact image.
fn sound(mut points: Vec<Point<'_>>) -> Vec<Point<'_>> {
    points.retain(|p| !has_other_truth(p.record));
    points
}

fn exactness(totals_of_strategies: &[StrategyTotals]) -> Grid {
    let mut grid = Grid::new(
        "exactness of strategies",
        [
            "strategy",
            "points",
            "drawn",
            "exact",
            "worst: decided wrong px",
            "frame, × draw only",
            "overflowed",
            "refused",
            "why it refuses",
        ],
    );
    for s in totals_of_strategies {
        let count = |n: usize| Cell::number(n.to_string(), n as f64);
        let exact = match (s.drawn, s.exact) {
            (0, _) => Cell::from("-").toned(Tone::Faint),
            (drawn, exact) if drawn == exact => count(exact).toned(Tone::Good),
            (_, exact) => count(exact).toned(Tone::Fair),
        };
        let reasons: Vec<String> = s.refusals.keys().cloned().collect();
        let worst = match s.drawn {
            0 => Cell::from("-").toned(Tone::Faint),
            _ => figures::wrong_px(s.worst_px),
        };
        grid.row([
            Cell::from(s.name.as_str()),
            count(s.asked),
            count(s.drawn),
            exact,
            worst,
            ranged(s.ratio),
            count(s.overflowed).toned(if s.overflowed > 0 {
                Tone::Fair
            } else {
                Tone::Plain
            }),
            count(s.refused()),
            describe_reasons(&reasons),
        ]);
    }
    grid
}

/// Reasons of refusals, so short that a table stays flat; whole on pointing at it.
fn describe_reasons(reasons: &[String]) -> Cell {
    const MOST: usize = 48;
    let Some(first) = reasons.first() else {
        return Cell::default();
    };
    let sentence = first
        .split(['.', ';', ',', '('])
        .next()
        .unwrap_or(first)
        .trim_end();
    let mut text: String = sentence.chars().take(MOST).collect();
    if text.len() < first.len() {
        text.push('…');
    }
    if reasons.len() > 1 {
        text.push_str(&format!(" (and {} more)", reasons.len() - 1));
    }
    Cell::from(text).titled(reasons.join("; "))
}

/// The paper's path at some points as one strategy: where its own parameters were not asked, with all that were.
fn totals_of_paper(records: &[&Record]) -> StrategyTotals {
    let all = records.iter().flat_map(|r| {
        let own = papers(r).into_iter();
        own.map(|index| &r.measurement.strategies[index])
    });
    StrategyTotals::over(&Strategy::PAPER.to_string(), all)
}

/// The paper's path over all points, in a sentence or two.
fn papers_path(setup: &str, records: &[&Record]) -> String {
    let name = Strategy::PAPER.to_string();
    let paper = totals_of_paper(records);
    let Some(ratio) = paper.ratio else {
        return format!("On {setup}: `{name}` was not timed on any point.");
    };
    let own = records.iter().flat_map(|r| {
        let all = &r.measurement.strategies;
        papers(r).into_iter().map(|index| &all[index])
    });
    let drawn: Vec<_> = own.filter_map(|s| s.comparison).collect();
    let over = |of: fn(&crate::Comparison) -> usize| -> String {
        let spread = Spread::of(drawn.iter().map(|c| of(c) as f64).collect());
        spread.map_or_else(String::new, |s| {
            format!("{:.0} ({:.0} to {:.0})", s.median, s.least, s.most)
        })
    };
    format!(
        "On {setup}: `{name}`, or where it was not asked the grids and sprites of other sizes that were, costs {} draw only in the median ({} to {}) over {}, and is exact in {} of them. \
         Median and range of its decided wrong pixels: {}; of missed cap: {}; of leaked cap: {}; of cracks: {}.",
        times(ratio.median),
        times(ratio.least),
        times(ratio.most),
        counted(paper.drawn, "frame"),
        paper.exact,
        over(|c| c.decided_wrong_px),
        over(|c| c.missed_cap_px),
        over(|c| c.leaked_cap_px),
        over(|c| c.crack_px),
    )
}

/// How many points have an exact strategy.
fn exact_count(records: &[&Record]) -> usize {
    let has_exact = |r: &&&Record| r.measurement.strategies.iter().any(is_exact);
    records.iter().filter(has_exact).count()
}

fn by_situation(points: &[Point<'_>]) -> Grid {
    let heading = ["cut by", "situation", "exact at"];
    let heading = heading.into_iter().chain(best::COLUMNS);
    let mut grid = Grid::new("the fastest exact strategy by situation", heading);
    for kind in Kind::ALL {
        let of_kind: Vec<&Record> = (points.iter().map(|p| p.record))
            .filter(|r| Kind::of(r) == kind)
            .collect();
        let exact = exact_count(&of_kind);
        if exact == 0 {
            continue;
        }
        for situation in Situation::ALL {
            let first = [
                Cell::from(kind.describe()),
                Cell::from(situation.describe()),
                Cell::number(format!("{exact} of {}", of_kind.len()), exact as f64),
            ];
            grid.row(first.into_iter().chain(best::cells(&of_kind, situation)));
        }
    }
    grid
}

/// What moves in an experiment: what its runs say where they agree, else the view.
fn situation_of(points: &[Point<'_>]) -> Situation {
    let mut all = points.iter().filter_map(Point::run).map(|run| run.moves);
    let first = all.next().unwrap_or_default();
    match all.all(|moves| moves == first) {
        true => first.into(),
        false => Situation::View,
    }
}

fn by_question(points: &Points<'_>, on_it: &[Point<'_>]) -> Grid {
    let heading = ["question", "what moves", "points", "exact at"];
    let heading = heading.into_iter().chain(best::COLUMNS);
    let heading = heading.chain(inputs::PAPER_COLUMNS);
    let mut grid = Grid::new("answers by question", heading);
    for (name, of_it) in points.by_experiment() {
        let records: Vec<&Record> = (of_it.iter())
            .filter(|p| on_it.iter().any(|q| std::ptr::eq(p.record, q.record)))
            .map(|p| p.record)
            .collect();
        if records.is_empty() {
            continue;
        }
        let question = of_it
            .first()
            .map_or("", |p| p.experiment.synopsis.question.as_str());
        let exact = exact_count(&records);
        let situation = situation_of(&of_it);
        let first = [
            Cell::from(format!("{name}: {question}")),
            Cell::from(situation.describe()),
            Cell::number(records.len().to_string(), records.len() as f64),
            Cell::number(format!("{exact} of {}", records.len()), exact as f64),
        ];
        let best = best::cells(&records, situation);
        let paper = inputs::paper(&records, situation);
        grid.row(first.into_iter().chain(best).chain(paper));
    }
    grid
}
