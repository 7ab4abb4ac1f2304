//! Page on one method at all points of a report: a summary, its errors, its costs and its refusals.

use cutaway::error::{Error, Result, did_you_mean};

use super::figures::{counted, percent, times};
use super::point::Points;
use super::{costs, expectations, glossary, head};
use crate::experiment::{Record, StrategyMeasurement};
use crate::report::derived::{Situation, Spread, StrategyTotals, has_other_truth, ranked, usage};
use crate::report::document::{Cell, Grid, Line, Ranking, ReportBlock, ReportDocument, Tone};
use crate::report::look::look;
use crate::report::number::{mebibytes, milliseconds};
use crate::report::recorded::RecordedFolders;

/// Makes the page on a method.
///
/// # Errors
///
/// Fails if no point used the method; the error names the methods that were used.
pub(in crate::report) fn method_document(
    recorded: &RecordedFolders,
    name: &str,
) -> Result<ReportDocument> {
    let points = Points::of(recorded);
    let records: Vec<&Record> = points.all.iter().map(|p| p.record).collect();
    let known = names(&records);
    if !known.contains(&name) {
        let what = "none of these records has a point with this method";
        return Err(Error::input(
            format!("--method {name}"),
            what,
            did_you_mean(name, known),
        ));
    }
    let mut blocks = Vec::new();
    for setup in points.setups() {
        let on_it = points.on(setup);
        let records: Vec<&Record> = on_it
            .iter()
            .map(|p| p.record)
            .filter(|r| of(r, name).is_some())
            .collect();
        if records.is_empty() {
            continue;
        }
        let place = match points.setups().count() {
            1 => String::new(),
            _ => format!(" on {}", points.label(setup)),
        };
        blocks.push(ReportBlock::Heading(2, format!("In short{place}")));
        blocks.extend(short(name, &records));
        blocks.push(ReportBlock::Ranking(by_run(name, &records)));
        let refused = refusals(name, &records);
        if !refused.rows.is_empty() {
            blocks.push(ReportBlock::Heading(
                2,
                format!("What it refuses or cannot finish{place}"),
            ));
            blocks.push(ReportBlock::Grid(refused));
        }
        if let Some(expected) = expectations::of_run(&records, Some(name)) {
            blocks.push(ReportBlock::Heading(
                2,
                format!("What was expected of it{place}"),
            ));
            blocks.push(expected);
        }
        blocks.push(ReportBlock::Heading(2, format!("Every point{place}")));
        let labelled: Vec<costs::Labelled<'_>> = (on_it.iter())
            .map(|p| (format!("{} {}", p.record.experiment, p.name()), p.record))
            .collect();
        blocks.extend(costs::of_method(name, &labelled));
    }
    for (heading, section) in [
        ("What the words mean", glossary::chapter(recorded)),
        ("What was run", head::chapter(recorded)),
    ] {
        blocks.push(ReportBlock::Heading(2, heading.to_owned()));
        blocks.extend(section);
    }
    Ok(ReportDocument {
        title: format!("What {name} does"),
        blocks,
    })
}

/// Distinct names of all strategies.
fn names<'a>(records: &[&'a Record]) -> Vec<&'a str> {
    let all = records.iter().flat_map(|r| &r.measurement.strategies);
    let mut names: Vec<&str> = all.map(|s| s.name.as_str()).collect();
    names.sort_unstable();
    names.dedup();
    names
}

fn of<'a>(record: &'a Record, name: &str) -> Option<&'a StrategyMeasurement> {
    record
        .measurement
        .strategies
        .iter()
        .find(|s| s.name == name)
}

/// The summary in a few sentences.
fn short(name: &str, records: &[&Record]) -> Vec<ReportBlock> {
    let sound: Vec<&Record> = records
        .iter()
        .copied()
        .filter(|r| !has_other_truth(r))
        .collect();
    let totals = StrategyTotals::of(name, sound.iter().copied());
    let usage = usage(name);
    let limit = usage.as_ref().and_then(|u| u.limit);
    let limit = limit.map_or_else(String::new, |limit| format!(" It is limited to: {limit}."));
    let wrong = match (totals.drawn, totals.worst_px) {
        (0, _) => String::new(),
        (_, 0) => " No decided pixel is wrong at any of them.".to_owned(),
        (_, px) => format!(" At worst {px} decided pixels are wrong."),
    };
    let mut blocks = vec![ReportBlock::Text(format!(
        "`{name}` drew {} of {}, and is exact at {} of them.{wrong}{limit}",
        totals.drawn,
        counted(totals.asked, "point"),
        totals.exact
    ))];
    if let Some(ratio) = totals.ratio {
        let found = sound
            .iter()
            .filter_map(|r| of(r, name))
            .filter(|s| s.was_drawn());
        let found: Vec<&StrategyMeasurement> = found.collect();
        let median = |value: fn(&StrategyMeasurement) -> f64| {
            Spread::of(found.iter().map(|s| value(s)).collect()).unwrap_or_default()
        };
        let [frame, cut, solid] = [
            median(|s| s.time_ms.frame.median),
            median(|s| s.time_ms.cut.median),
            median(|s| s.time_ms.solid.median),
        ];
        let memory = median(|s| (s.bytes.solid + s.bytes.cut + s.bytes.frame) as f64);
        blocks.push(ReportBlock::Text(format!(
            "A frame takes {} of drawing uncut in the median ({} to {}): {} ms. A change of the cut adds {} ms, a change of the mesh {} ms. \
             It takes {} MiB in the median, {} MiB at most.{}",
            times(ratio.median),
            times(ratio.least),
            times(ratio.most),
            milliseconds(frame.median),
            milliseconds(cut.median),
            milliseconds(solid.median),
            mebibytes(memory.median as u64),
            mebibytes(memory.most as u64),
            over_fastest(name, &sound)
        )));
    }
    let broken: Vec<&Record> = records
        .iter()
        .copied()
        .filter(|r| has_other_truth(r))
        .collect();
    let shares = broken.iter().filter_map(|r| {
        let wrong = of(r, name)?.comparison?.decided_wrong_px as f64;
        Some(wrong / r.measurement.exact.cap_px.max(1) as f64)
    });
    if let Some(share) = Spread::of(shares.collect()) {
        blocks.push(ReportBlock::Text(format!(
            "On {} judged by the exact image of another scene (for a broken mesh, that of the intact mesh), it gets {} of the cap wrong in the median, \
             {} at most.",
            counted(broken.len(), "point"),
            percent(share.median),
            percent(share.most)
        )));
    }
    if let Some(usage) = usage {
        blocks.push(ReportBlock::Text("To draw a picture with it:".to_owned()));
        blocks.push(ReportBlock::Command(format!(
            "cutaway render MODEL --section x=50% --strategy {} -o picture.png",
            usage.words
        )));
    }
    blocks
}

/// Sentence with the method's time relative to the fastest exact method of each point.
fn over_fastest(name: &str, records: &[&Record]) -> String {
    let factors = records.iter().filter_map(|record| {
        let own = Situation::View.ratio(record, of(record, name)?)?;
        let first = ranked(&[record], Situation::View).into_iter().next()?;
        Some(own / first.ratio.median)
    });
    Spread::of(factors.collect()).map_or_else(String::new, |s| {
        format!(
            " Relative to the fastest exact method of each point, its frame takes {} in the median ({} to {}).",
            times(s.median),
            times(s.least),
            times(s.most)
        )
    })
}

/// A ranking with a line for each run, in the order of the experiments.
fn by_run(name: &str, records: &[&Record]) -> Ranking {
    let mut runs: Vec<(&str, &str)> = Vec::new();
    for record in records {
        let run = (record.experiment.as_str(), record.run.as_str());
        if !runs.contains(&run) {
            runs.push(run);
        }
    }
    let line = |(experiment, run): &(&str, &str)| {
        let of_run = records.iter().copied();
        let of_run = of_run.filter(|r| r.experiment == *experiment && r.run == *run);
        let totals = StrategyTotals::of(name, of_run);
        let refused = match totals.refused() {
            0 => String::new(),
            refused => format!(", refuses {refused} of {}", totals.asked),
        };
        Line {
            name: format!("{experiment}, {run}"),
            look: look(name),
            cost: totals.ratio,
            words: match (totals.drawn, totals.is_exact()) {
                (0, _) => Cell::from("refuses").toned(Tone::Faint),
                (_, true) => Cell::from(format!("exact{refused}")).toned(Tone::Good),
                _ => Cell::from(format!("{} px{refused}", totals.worst_px)).toned(Tone::Fair),
            },
        }
    };
    let lines: Vec<Line> = runs.iter().map(line).collect();
    let ends = lines.iter().filter_map(|l| l.cost);
    Ranking {
        title: format!("{name} by run"),
        names: "run",
        axis: "time relative to drawing uncut".to_owned(),
        is_factor: true,
        heading: "wrong px, at most".to_owned(),
        range: ends.fold([1.0, 1.0], |[least, most], s| {
            [f64::min(least, s.least), f64::max(most, s.most)]
        }),
        lines,
    }
}

/// Table with a row for each reason for a refusal, and the points that it concerns.
fn refusals(name: &str, records: &[&Record]) -> Grid {
    let mut reasons: Vec<(&str, Vec<String>)> = Vec::new();
    for record in records {
        let Some(reason) = of(record, name).and_then(|s| s.reason.as_deref()) else {
            continue;
        };
        let values = record.parameters.values().map(ToString::to_string);
        let point: Vec<String> = [record.experiment.clone(), record.run.clone()]
            .into_iter()
            .chain(values)
            .collect();
        let point = point.join(" ");
        match reasons.iter_mut().find(|(r, _)| *r == reason) {
            Some((_, points)) => points.push(point),
            None => reasons.push((reason, vec![point])),
        }
    }
    let mut grid = Grid::new("refusals", ["reason", "points", "where"]);
    for (reason, points) in reasons {
        grid.row([
            Cell::from(reason),
            Cell::number(points.len().to_string(), points.len() as f64),
            Cell::from(points.join("; ")),
        ]);
    }
    grid
}
