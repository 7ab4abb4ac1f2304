//! Short answers on which strategy to use, all derived from the records.

use cutaway::strategies::Strategy;

use super::{best, cards, inputs, reasons};
use crate::experiment::Record;
use crate::report::chapters::figures::{counted, ranged, times};
use crate::report::chapters::point::{Points, RecordedPoint, Setup};
use crate::report::chapters::{broken, figures, styles};
use crate::report::derived::{
    CutSetKind, Situation, Spread, StrategyTotals, has_defect, has_other_truth, is_exact, papers,
    totals_of_strategies,
};
use crate::report::document::{Cell, Grid, ReportBlock, Tone};

pub(in crate::report::chapters) fn chapter(points: &Points<'_>) -> Vec<ReportBlock> {
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
    let others = points.all.iter().filter(|p| has_other_truth(p.record));
    let others = others.count();
    for setup in points.setups() {
        let on_it = sound(points.on(setup));
        let records: Vec<&Record> = on_it.iter().map(|p| p.record).collect();
        let totals = totals_of_strategies(&records);
        blocks.extend(whose(points, setup));
        blocks.push(ReportBlock::Text(exact_ones(&totals)));
        blocks.push(folded(
            "All methods, their errors, costs and refusals",
            exactness_notes(others).chain([ReportBlock::Grid(exactness(&totals))]),
        ));
    }
    blocks.push(heading(
        "What does the paper's method cost, and what does it miss?",
    ));
    blocks.extend(points.setups().map(|setup| {
        let records: Vec<&Record> = (sound(points.on(setup)).iter()).map(|p| p.record).collect();
        ReportBlock::Text(papers_path(&points.label(setup), &records))
    }));
    // With a single point, these tables would repeat the answer above.
    let are_several = points.all.len() > 1;
    if are_several {
        blocks.push(heading("Which strategy for which moving input?"));
        blocks.push(ReportBlock::Text(
        "The same ranking as for inputs, over all points of one kind of cut. If only the view moves, a frame costs the time of the frame clock; if the cut moves, \
         that of the frame and cut clocks; if the mesh moves, that of all clocks. `exact at` counts the points that have an exact strategy."
            .to_owned(),
    ));
        for setup in points.setups() {
            blocks.extend(whose(points, setup));
            blocks.push(ReportBlock::Grid(by_situation(&sound(points.on(setup)))));
        }
    }
    if others > 0 {
        blocks.push(heading("Which strategies cope with broken meshes?"));
    }
    for setup in points.setups() {
        if let Some(grid) = broken::grid(&points.on(setup)) {
            blocks.extend(whose(points, setup));
            let on_it = points.on(setup);
            let broken = on_it.iter().map(|p| p.record).filter(|r| has_defect(r));
            let broken: Vec<&Record> = broken.collect();
            blocks.push(ReportBlock::Text(cards::sentence(&broken, Situation::View)));
            let how = "One row for each defect and method: the decided wrong pixels as a share of the intact mesh's cap, as median and maximum over the points \
                 with a defect; how many wrong pixels are not marked as unreliable; and how many pixels are marked, wrong or not.";
            blocks.push(folded(
                "All defects and methods",
                [ReportBlock::Text(how.to_owned()), ReportBlock::Grid(grid)],
            ));
        }
    }
    blocks.extend(styles::blocks(points));
    if are_several {
        blocks.push(heading("Answers by question"));
        for setup in points.setups() {
            blocks.extend(whose(points, setup));
            let table = ReportBlock::Grid(by_question(points, &points.on(setup)));
            blocks.push(folded("Each experiment in a line", [table]));
        }
    }
    blocks
}

fn folded(summary: &str, blocks: impl IntoIterator<Item = ReportBlock>) -> ReportBlock {
    ReportBlock::Folded {
        summary: summary.to_owned(),
        open: false,
        blocks: blocks.into_iter().collect(),
    }
}

/// Notes on what the exactness table counts and leaves out.
fn exactness_notes(others: usize) -> impl Iterator<Item = ReportBlock> {
    let counts = ReportBlock::Text(
        "A strategy is exact at a point if it drew the whole frame and has no wrong pixel where the reference is sure. \
         The ratio is the frame time divided by the time to draw the same scene uncut: the median, with the range in its tooltip. \
         Strategies that only occur in sweeps over their own parameter are in the charts of their experiment."
            .to_owned(),
    );
    let left_out = (others > 0).then(|| {
        ReportBlock::Text(format!(
            "Left out here, and in the sections on the paper's method and on moving inputs: {} judged by the exact image of another scene. Broken meshes, \
             for example, are judged by the image of the intact mesh. They have a separate table below.",
            counted(others, "point")
        ))
    });
    std::iter::once(counts).chain(left_out)
}

/// Sentence that lists the methods that are exact wherever they drew.
fn exact_ones(totals: &[StrategyTotals]) -> String {
    let named = |is_it: fn(&StrategyTotals) -> bool| -> Vec<String> {
        let of_it = totals.iter().filter(|s| s.drawn > 0 && is_it(s));
        of_it
            .map(|s| {
                let ratio = s
                    .ratio
                    .map_or_else(String::new, |r| format!(" {}", times(r.median)));
                format!("`{}`{ratio}", s.name)
            })
            .collect()
    };
    let exact = named(StrategyTotals::is_exact);
    let wrong = named(|s| !s.is_exact());
    match (exact.as_slice(), wrong.as_slice()) {
        ([], _) => "None is exact at every point that it drew.".to_owned(),
        (_, []) => format!("Exact at every point that they drew: {}.", exact.join(", ")),
        _ => format!(
            "Exact at every point that they drew: {}. Wrong at some point: {}. The factor is the frame time divided by the time of drawing uncut, as the median \
             over all points of a method. As methods were measured at different points, these factors are no ranking.",
            exact.join(", "),
            wrong.join(", ")
        ),
    }
}

fn heading(text: &str) -> ReportBlock {
    ReportBlock::Heading(4, text.to_owned())
}

/// Heading that names the setup of the figures below it, if there are several setups.
fn whose(points: &Points<'_>, setup: &Setup<'_>) -> Option<ReportBlock> {
    (points.setups().count() > 1).then(|| ReportBlock::Heading(5, points.label(setup)))
}

/// Points that are judged by their own exact image.
fn sound(mut points: Vec<RecordedPoint<'_>>) -> Vec<RecordedPoint<'_>> {
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
            reasons::short(&reasons),
        ]);
    }
    grid
}

/// Totals of the paper's method at some points, as one strategy: with the paper's parameters where measured, else with all measured sizes.
fn totals_of_paper(records: &[&Record]) -> StrategyTotals {
    let all = records.iter().flat_map(|r| {
        let own = papers(r).into_iter();
        own.map(|index| &r.measurement.strategies[index])
    });
    StrategyTotals::over(&Strategy::PAPER.to_string(), all)
}

/// One or two sentences on the paper's method over all points.
fn papers_path(setup: &str, records: &[&Record]) -> String {
    let name = Strategy::PAPER.to_string();
    let paper = totals_of_paper(records);
    let Some(ratio) = paper.ratio else {
        return format!("On {setup}: `{name}` was not timed at any point.");
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
        "On {setup}: `{name}` (at points without it, grids and sprites of other sizes) costs {} of draw only in the median ({} to {}) over {}, and is exact in {} of them. \
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

/// Number of points that have an exact strategy.
fn exact_count(records: &[&Record]) -> usize {
    let has_exact = |r: &&&Record| r.measurement.strategies.iter().any(is_exact);
    records.iter().filter(has_exact).count()
}

fn by_situation(points: &[RecordedPoint<'_>]) -> Grid {
    let heading = ["cut by", "situation", "exact at"];
    let heading = heading.into_iter().chain(best::COLUMNS);
    let mut grid = Grid::new("the fastest exact strategy by situation", heading);
    for kind in CutSetKind::ALL {
        let of_kind: Vec<&Record> = (points.iter().map(|p| p.record))
            .filter(|r| CutSetKind::of(r) == kind)
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

/// Situation of an experiment: that of its runs if they all have the same; otherwise only the view moves.
pub(in crate::report::chapters) fn situation_of(points: &[RecordedPoint<'_>]) -> Situation {
    let mut all = points
        .iter()
        .filter_map(RecordedPoint::run)
        .map(|run| run.moves);
    let first = all.next().unwrap_or_default();
    match all.all(|moves| moves == first) {
        true => first.into(),
        false => Situation::View,
    }
}

fn by_question(points: &Points<'_>, on_it: &[RecordedPoint<'_>]) -> Grid {
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
