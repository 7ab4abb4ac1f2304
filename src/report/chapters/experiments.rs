//! The experiments: question, analysis, charts, and every point of every run.

use super::point::{Point, Points};
use super::{charts, costs, counted, expectations, head, pictures};
use crate::document::Document;
use crate::experiment::{Record, Warning};
use crate::report::document::{Block, Tone};
use crate::report::recorded::Recorded;

pub(super) fn chapter(
    recorded: &Recorded,
    points: &Points<'_>,
    pictures: &pictures::Chosen,
) -> Vec<Block> {
    let mut blocks = Vec::new();
    let all = || (recorded.folders.iter()).flat_map(|f| f.experiments.iter().map(move |e| (f, e)));
    for (folder, experiment) in all().filter(|(_, e)| e.records.is_empty()) {
        let name = &experiment.synopsis.name;
        let missing = head::missing(folder, experiment);
        if !missing.is_empty() && !points.by_experiment().iter().any(|(n, _)| n == name) {
            blocks.push(Block::Heading(3, name.clone()));
            blocks.extend(missing);
        }
    }
    for (name, of_it) in points.by_experiment() {
        let Some(first) = of_it.first() else {
            continue;
        };
        let synopsis = &first.experiment.synopsis;
        blocks.push(Block::Heading(3, name.to_owned()));
        if !synopsis.question.is_empty() {
            blocks.push(Block::Heading(4, synopsis.question.clone()));
        }
        if !synopsis.analysis.is_empty() {
            blocks.push(Block::Prose(synopsis.analysis.clone()));
        }
        for (folder, experiment) in all().filter(|(_, e)| e.synopsis.name == name) {
            blocks.extend(head::missing(folder, experiment));
        }
        blocks.extend(charts::blocks(&synopsis.charts, points, &of_it));
        let mut runs: Vec<&str> = of_it.iter().map(|p| p.record.run.as_str()).collect();
        runs.dedup();
        runs.sort_by_key(|run| synopsis.place_of(run));
        runs.dedup();
        for run in runs {
            blocks.push(Block::Heading(4, format!("Run {run}")));
            let about = synopsis.runs.iter().find(|r| r.name == run);
            if let Some(about) = about.and_then(|r| r.about.as_ref()) {
                blocks.push(Block::Text(about.clone()));
            }
            let of_run: Vec<&Point<'_>> = of_it.iter().filter(|p| p.record.run == run).collect();
            let pictured = of_run.iter().position(|p| pictures.has(p));
            for (index, point) in of_run.into_iter().enumerate() {
                let is_open = index == pictured.unwrap_or(0);
                blocks.push(folded(points, point, pictures, is_open));
            }
        }
    }
    blocks
}

fn folded(
    points: &Points<'_>,
    point: &Point<'_>,
    pictures: &pictures::Chosen,
    is_open: bool,
) -> Block {
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
    Block::Folded {
        summary: format!("{parameters}{}{missed_words}", points.on_whom(point)),
        open: is_open || missed > 0,
        blocks: one(points, point, pictures),
    }
}

fn one(points: &Points<'_>, point: &Point<'_>, pictures: &pictures::Chosen) -> Vec<Block> {
    let record = point.record;
    let mut blocks = vec![Block::Text(facts(record))];
    blocks.extend(scenes(record));
    let common = points.common(point.folder);
    // What was said of a scene belongs to it, even if all have it.
    let is_told = |w: &&Warning| matches!(w, Warning::Opening { .. }) || !common.contains(w);
    for warning in record.warnings.iter().filter(is_told) {
        let text = format!("{}. Mend: {}.", warning.text(), warning.remedy());
        let tone = match warning.concerns() {
            Some(_) => Tone::Plain,
            None => Tone::Fair,
        };
        blocks.push(Block::Notice(tone, text));
    }
    blocks.push(Block::Grid(costs::table(record)));
    blocks.extend(expectations::blocks(&record.expectations));
    if let Some(passes) = costs::passes(record) {
        blocks.push(Block::Folded {
            summary: "Where the time goes, by clock and pass".to_owned(),
            open: false,
            blocks: vec![passes],
        });
    }
    blocks.push(Block::Folded {
        summary: "Memory by clock, and every sample".to_owned(),
        open: false,
        blocks: costs::samples(record),
    });
    blocks.extend(pictures.gallery(point));
    blocks.push(Block::Text("To repeat this point:".to_owned()));
    blocks.push(Block::Command(record.measurement.command.clone()));
    blocks
}

/// The scene of a point, and the one that is the truth where that is another.
fn scenes(record: &Record) -> Vec<Block> {
    let truth = record.truth.as_ref();
    let truth = truth.map(|truth| ("The scene whose exact image is the truth", truth));
    let folded = |(what, scene): (&str, &Document)| Block::Folded {
        summary: what.to_owned(),
        open: false,
        blocks: vec![Block::Command(scene.to_string().trim().to_owned())],
    };
    let all = std::iter::once(("The scene, as a file", &record.scene)).chain(truth);
    all.map(folded).collect()
}

fn facts(record: &Record) -> String {
    let (m, exact) = (&record.measurement, &record.measurement.exact);
    let times = match m.timing {
        crate::experiment::Timing::Timestamps => "timestamps of the device",
        crate::experiment::Timing::Wall => "wall time",
    };
    format!(
        "{}, {} triangles, {} × {} pixels on {}; {} by {}, over which ± is the spread (another run may differ by more). The reference has {} cap, {} surface and {} undecided pixels ({:.0} ms on the CPU).",
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
        exact.time_ms
    )
}
