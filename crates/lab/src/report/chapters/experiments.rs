//! The experiments: question, answer, pictures and charts. The analysis and every point of every run are in sections shown on demand.

use cutaway_io::document::Document;

use super::advice::answers::situation_of;
use super::advice::cards;
use super::figures::counted;
use super::point::{Points, RecordedPoint};
use super::{charts, costs, expectations, head, pictures, warnings};
use crate::experiment::Record;
use crate::report::derived::variants;
use crate::report::document::ReportBlock;
use crate::report::number::milliseconds;
use crate::report::recorded::RecordedFolders;

pub(super) fn chapter(
    recorded: &RecordedFolders,
    points: &Points<'_>,
    pictures: &pictures::Galleries,
) -> Vec<ReportBlock> {
    let mut blocks = Vec::new();
    let all = || (recorded.folders.iter()).flat_map(|f| f.experiments.iter().map(move |e| (f, e)));
    for (folder, experiment) in all().filter(|(_, e)| e.records.is_empty()) {
        let name = &experiment.synopsis.name;
        let missing = head::missing(folder, experiment);
        if !missing.is_empty() && !points.by_experiment().iter().any(|(n, _)| n == name) {
            blocks.push(ReportBlock::Heading(3, name.clone()));
            blocks.extend(missing);
        }
    }
    for (name, of_it) in points.by_experiment() {
        let Some(first) = of_it.first() else {
            continue;
        };
        let synopsis = &first.experiment.synopsis;
        blocks.push(ReportBlock::Heading(3, name.to_owned()));
        if !synopsis.question.is_empty() {
            blocks.push(ReportBlock::Heading(4, synopsis.question.clone()));
        }
        for (folder, experiment) in all().filter(|(_, e)| e.synopsis.name == name) {
            blocks.extend(head::missing(folder, experiment));
        }
        blocks.extend(answers(points, &of_it));
        let pictured = of_it.iter().find(|p| pictures.has(p));
        blocks.extend(pictured.into_iter().flat_map(|p| pictures.gallery(p)));
        blocks.extend(charts::blocks(&synopsis.charts, points, &of_it));
        if !synopsis.analysis.is_empty() {
            blocks.push(ReportBlock::Folded {
                summary: "What was asked, and how to read the answer".to_owned(),
                open: false,
                blocks: vec![ReportBlock::Prose(synopsis.analysis.clone())],
            });
        }
        blocks.push(measurements(points, &of_it, pictures, pictured));
    }
    blocks
}

/// The answer of an experiment for each setup; a setup in which neither methods nor variants are compared has none.
fn answers(points: &Points<'_>, of_it: &[RecordedPoint<'_>]) -> Vec<ReportBlock> {
    let answer = |setup| {
        let on_it = points.on(setup);
        let is_on_it =
            |p: &&RecordedPoint<'_>| on_it.iter().any(|q| std::ptr::eq(p.record, q.record));
        let records: Vec<&Record> = of_it.iter().filter(is_on_it).map(|p| p.record).collect();
        let first = records.first()?;
        let is_alone = records.iter().all(|r| r.measurement.strategies.len() < 2);
        let situation = situation_of(of_it);
        if is_alone && variants(&records).is_none() {
            return None;
        }
        let sentence = cards::sentence(&records, situation);
        let on_whom = of_it.iter().find(|p| std::ptr::eq(p.record, *first));
        let on_whom = on_whom.map_or_else(String::new, |p| points.on_whom(p));
        Some(ReportBlock::Text(format!("{sentence}{on_whom}")))
    };
    points.setups().filter_map(answer).collect()
}

/// Every point of every run, with its expectations.
fn measurements(
    points: &Points<'_>,
    of_it: &[RecordedPoint<'_>],
    pictures: &pictures::Galleries,
    shown: Option<&RecordedPoint<'_>>,
) -> ReportBlock {
    let mut blocks = Vec::new();
    let mut runs: Vec<&str> = of_it.iter().map(|p| p.record.run.as_str()).collect();
    runs.dedup();
    if let Some(first) = of_it.first() {
        runs.sort_by_key(|run| first.experiment.synopsis.place_of(run));
    }
    runs.dedup();
    for run in runs {
        blocks.push(ReportBlock::Heading(4, format!("Run {run}")));
        let of_run: Vec<&RecordedPoint<'_>> =
            of_it.iter().filter(|p| p.record.run == run).collect();
        let about = of_run
            .first()
            .and_then(|p| p.run())
            .and_then(|r| r.about.as_ref());
        blocks.extend(about.map(|about| ReportBlock::Text(about.clone())));
        let records: Vec<&Record> = of_run.iter().map(|p| p.record).collect();
        blocks.extend(expectations::of_run(&records, None));
        let labels = of_run.iter().map(|p| {
            let label = format!("{}{}", p.parameters(), points.on_whom(p));
            (label.trim_start_matches(" · ").to_owned(), p.record)
        });
        blocks.extend(costs::table(&labels.collect::<Vec<_>>()));
        let pictured = of_run.iter().position(|p| pictures.has(p));
        for (index, point) in of_run.into_iter().enumerate() {
            let is_open = index == pictured.unwrap_or(0);
            let is_shown = shown.is_some_and(|p| std::ptr::eq(p.record, point.record));
            let own = (!is_shown).then_some(pictures);
            blocks.push(folded(points, point, own, is_open));
        }
    }
    let has_missed = |p: &RecordedPoint<'_>| p.record.expectations.iter().any(|r| !r.holds);
    ReportBlock::Folded {
        summary: format!(
            "{}: errors, times, memory, scenes, and the commands that repeat them",
            counted(of_it.len(), "point")
        ),
        open: of_it.iter().any(has_missed),
        blocks,
    }
}

fn folded(
    points: &Points<'_>,
    point: &RecordedPoint<'_>,
    pictures: Option<&pictures::Galleries>,
    is_open: bool,
) -> ReportBlock {
    let record = point.record;
    let missed = record.expectations.iter().filter(|r| !r.holds).count();
    let missed_words = match missed {
        0 => String::new(),
        n => format!(" · {} missed", counted(n, "expectation")),
    };
    let parameters = match record.parameters.is_empty() {
        true => record.run.clone(),
        false => point.parameters(),
    };
    ReportBlock::Folded {
        summary: format!("{parameters}{}{missed_words}", points.on_whom(point)),
        open: is_open || missed > 0,
        blocks: one(points, point, pictures),
    }
}

fn one(
    points: &Points<'_>,
    point: &RecordedPoint<'_>,
    pictures: Option<&pictures::Galleries>,
) -> Vec<ReportBlock> {
    let record = point.record;
    let mut blocks = vec![ReportBlock::Text(facts(record))];
    let common = points.common(point.folder);
    let own = record.warnings.iter().filter(|w| !common.contains(w));
    blocks.extend(warnings::notices(own));
    blocks.extend(expectations::missed(&record.expectations));
    blocks.extend(pictures.into_iter().flat_map(|p| p.gallery(point)));
    blocks.extend(scenes(record));
    blocks.extend(costs::passes(record));
    blocks.push(ReportBlock::Text("To repeat this point:".to_owned()));
    blocks.push(ReportBlock::Command(record.measurement.command.clone()));
    blocks
}

/// The scene of a point, and its truth scene if that is another scene.
fn scenes(record: &Record) -> Vec<ReportBlock> {
    let truth = record.truth.as_ref();
    let truth = truth.map(|truth| ("The scene whose exact image is the truth:", truth));
    let all = std::iter::once(("The scene, as a file:", &record.scene)).chain(truth);
    all.flat_map(|(what, scene): (&str, &Document)| {
        let text = scene.to_string().trim().to_owned();
        [
            ReportBlock::Text(what.to_owned()),
            ReportBlock::Command(text),
        ]
    })
    .collect()
}

fn facts(record: &Record) -> String {
    let (m, exact) = (&record.measurement, &record.measurement.exact);
    let times = match m.timing {
        crate::experiment::Timing::Timestamps => "timestamps of the device",
        crate::experiment::Timing::Wall => "wall time",
    };
    format!(
        "{}, {} triangles, {} × {} pixels on {}; {} by {}, over which ± is the spread (another run may differ by more). The reference has {} cap pixels, {} surface pixels and {} undecided pixels ({} ms on the CPU).",
        m.scene,
        m.triangles,
        m.resolution[0],
        m.resolution[1],
        m.adapter.name,
        counted(m.rounds, "round"),
        times,
        exact.cap_px,
        exact.surface_px,
        exact.undecided_px,
        milliseconds(exact.time_ms)
    )
}
