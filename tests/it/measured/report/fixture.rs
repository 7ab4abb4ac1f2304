//! A folder of a run, made of values: two points of one experiment, a strategy that refuses, a hard case, an outside baseline.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use cutaway::gpu::AdapterReport;
use cutaway::plan::Clock;
use cutaway_io::document::{Document, cut, part, section};
use cutaway_lab::Comparison;
use cutaway_lab::experiment::{
    CaseRecord, CaseRecords, Ending, Expectation, FamilyMember, Machine, Measurement,
    MedianPassTime, Parameter, PerClock, Reached, Record, RecordedPicture, Reference, Run, Samples,
    StrategyMeasurement, Timing, Warning,
};
use serde_json::json;

/// The name of the experiment.
pub(crate) const NAME: &str = "01-fixture";

pub(crate) fn adapter(name: &str) -> AdapterReport {
    AdapterReport {
        name: name.to_owned(),
        backend: "vulkan".to_owned(),
        driver: "driver 1".to_owned(),
        software: true,
        sub_pixel_bits: Some(8),
    }
}

/// A strategy that got so many pixels wrong in so much of the time of drawing only.
pub(crate) fn drawn(name: &str, wrong_px: usize, ratio: f64) -> StrategyMeasurement {
    StrategyMeasurement {
        name: name.to_owned(),
        outcome: Ending::Complete,
        reason: None,
        comparison: Some(Comparison {
            decided_wrong_px: wrong_px,
            edge_wrong_px: wrong_px,
            ..Comparison::default()
        }),
        undecided_px: None,
        bytes: PerClock {
            solid: 1 << 20,
            cut: 0,
            frame: 2 << 20,
        },
        time_ms: PerClock {
            solid: Samples::new(vec![12.0, 13.0, 14.0]),
            cut: Samples::default(),
            frame: Samples::new([1.75, 2.0, 2.25].map(|t| t * ratio).into()),
        },
        frame_over_draw_only: Some(ratio),
        frame_over_draw_only_mad: Some(0.01),
        cut: None,
        passes: vec![MedianPassTime {
            name: "shade & light".to_owned(),
            clock: Clock::Frame,
            median_ms: 0.5,
        }],
    }
}

pub(crate) fn refused(name: &str, reason: &str) -> StrategyMeasurement {
    StrategyMeasurement {
        outcome: Ending::Refused,
        reason: Some(reason.to_owned()),
        comparison: None,
        undecided_px: None,
        bytes: PerClock::default(),
        time_ms: PerClock::default(),
        frame_over_draw_only: None,
        frame_over_draw_only_mad: None,
        cut: None,
        passes: Vec::new(),
        ..drawn(name, 0, 1.0)
    }
}

pub(crate) fn record(size: &str, strategies: Vec<StrategyMeasurement>) -> Record {
    let count = strategies.len();
    Record {
        format: Record::FORMAT,
        experiment: NAME.to_owned(),
        run: "crank".to_owned(),
        parameters: BTreeMap::from([("size".to_owned(), Parameter::Text(size.to_owned()))]),
        is_quick: false,
        identity: size.to_owned(),
        scene: Document::new(),
        truth: None,
        measurement: Measurement {
            scene: "crank".to_owned(),
            command: format!("cutaway compare shape:crank --section x=50% # {size}"),
            version: "0.1.0".to_owned(),
            triangles: 12,
            resolution: [64, 48],
            adapter: adapter("one"),
            timing: Timing::Timestamps,
            rounds: 3,
            exact: Reference {
                cap_px: 10,
                surface_px: 20,
                background_px: 3042,
                undecided_px: 1,
                judged_px: Some(29),
                overlap_px: 0,
                time_ms: 5.0,
            },
            draw_only_ms: Samples::new(vec![2.0, 2.0, 2.0]),
            draw_only_compute_ms: None,
            strategies,
        },
        families: vec![vec![FamilyMember::default()]; count],
        figures: vec![BTreeMap::new(); count],
        expectations: vec![reached("raycast+mask", true)],
        warnings: vec![Warning::SoftwareAdapter {
            adapter: "one".to_owned(),
        }],
        invocation: None,
        pictures: vec![RecordedPicture {
            drawer: "exact".to_owned(),
            file: "exact.png".to_owned(),
            heatmap: None,
        }],
    }
}

pub(crate) fn reached(strategy: &str, holds: bool) -> Reached {
    Reached {
        strategy: strategy.to_owned(),
        expected: Expectation {
            what: "0 decided wrong px".to_owned(),
            why: None,
        },
        found: "what was found".to_owned(),
        holds,
    }
}

/// The crank, cut by a plane; its mesh may be broken.
#[allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]
pub(crate) fn scene(defect: Option<&str>) -> Document {
    let mut scene = Document::new();
    let crank = part("shape:crank");
    let crank = defect.into_iter().fold(crank, |part, d| part.defect(d));
    scene.add_part(crank).unwrap();
    scene.add_cut(cut([section("x=1")])).unwrap();
    scene
}

/// The records of the fixture: at each size the exact one, the paper's, one of a sweep, and one that refuses.
pub(crate) fn records() -> Vec<Record> {
    let of = |size: &str, wrong: usize| {
        let mut record = record(
            size,
            vec![
                drawn("raycast+mask", 0, 4.0),
                drawn("grid:256+vds:1024", wrong, 2.0),
                drawn("grid:64+mask", 10 * wrong, 1.0),
                refused("planar", "a <script>alert(1)</script> | relief"),
            ],
        );
        record.families[2][0]
            .parameters
            .insert("cells".to_owned(), Parameter::Whole(64));
        record.families[2][0].family = "grid:{cells}+vds:1024".to_owned();
        record.figures[0].insert("flicker_px".to_owned(), 7.0);
        record
    };
    vec![of("2%", 100), of("10%", 1000)]
}

pub(crate) fn cases() -> CaseRecords {
    let case = |id: &str, holds: bool| CaseRecord {
        id: id.to_owned(),
        name: format!("a case called {id}"),
        expectations: vec![reached("raycast+mask", holds)],
        held_by: Some(format!("hard_cases::case_{id}")),
    };
    CaseRecords {
        format: Record::FORMAT,
        experiment: NAME.to_owned(),
        run: "cases".to_owned(),
        identity: String::new(),
        sizes_px: vec![64],
        cases: vec![case("2", true), case("10", true)],
        invocation: None,
    }
}

fn run(name: &str) -> Run {
    Run {
        format: Record::FORMAT,
        command: "cutaway measure 01-fixture.toml --out here".to_owned(),
        version: "0.1.0".to_owned(),
        commit: None,
        began: "2026-01-02T03:04:05Z".to_owned(),
        took_s: 7.0,
        is_quick: false,
        machine: Machine::default(),
        adapter: adapter(name),
        limits: BTreeMap::from([("storage_buffers".to_owned(), 8)]),
    }
}

/// A picture of one pixel.
pub(crate) const PNG: &[u8] = b"\x89PNG\r\n\x1a\nfixture";

/// Writes a folder.
#[allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]
pub(crate) fn write(folder: &Path, records: &[Record], cases: Option<&CaseRecords>) {
    let inside = folder.join(NAME);
    fs::create_dir_all(&inside).unwrap();
    fs::create_dir_all(folder.join("peers")).unwrap();
    let name = (records.first()).map_or("one", |r| &r.measurement.adapter.name);
    let put = |path: &str, value: serde_json::Value| {
        fs::write(folder.join(path), value.to_string()).unwrap();
    };
    put("run.json", json!(run(name)));
    put(
        &format!("{NAME}/experiment.json"),
        json!({
            "name": NAME,
            "question": "What does <it> cost?",
            "analysis": "Read *downwards*. <script>alert(2)</script>",
            "run": [{ "name": "crank", "about": "a crank", "scene": { "part": [{ "shape": "crank" }] } }],
            "chart": [
                { "title": "Error against time", "x": "ratio", "y": "decided_wrong_px", "pareto": true, "log": ["x", "y"] },
                { "title": "By size", "x": "size", "y": "time_ms.frame" },
                { "title": "Nothing", "x": "cells", "y": "no_such_px" },
            ],
        }),
    );
    for record in records {
        let size = record.parameters["size"].to_string().replace('%', "");
        put(&format!("{NAME}/crank.{size}.json"), json!(record));
    }
    if let Some(cases) = cases {
        put(&format!("{NAME}/cases.cases.json"), json!(cases));
    }
    put(
        "peers/planar.json",
        json!({
            "format": 1, "what": "planar", "versions": { "vtk": "9.9" }, "command": "run.sh", "rows": [
                { "mesh": "torus", "cut": "x", "tool": "cutaway section", "area": 2.0, "outcome": "done",
                  "time_ms": { "median": 1.0, "mad": 0.1, "samples": [1.0, 1.1] } },
                { "mesh": "torus", "cut": "x", "tool": "vtk", "area": 2.5, "outcome": "done" },
                { "mesh": "torus", "cut": "x", "tool": "manifold3d", "outcome": "refused", "reason": "<NotManifold>" },
            ],
        }),
    );
    fs::write(inside.join("exact.png"), PNG).unwrap();
}
