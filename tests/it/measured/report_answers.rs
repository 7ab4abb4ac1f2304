//! The answers of a report: what to use for which input, the paper's path wherever it is swept, broken meshes apart from the sound ones,
//! and reasons that fit in a table.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::fs;

use cutaway_lab::experiment::{FamilyMember, Parameter, Record, Samples};
use cutaway_lab::report::{PictureOptions, RecordedFolders, pages};
use serde_json::{Value, json};

use crate::common::command;
use crate::measured::report::fixture;

use command::Scratch;
use fixture::{NAME, drawn, record, records, refused, scene, write};

/// The report of some points as Markdown, where the run says more of itself.
fn describe(folder: &Scratch, records: &[Record], of_run: &Value) -> String {
    write(&folder.path("run"), records, None);
    let file = folder.path(&format!("run/{NAME}/experiment.json"));
    let mut definition: Value = serde_json::from_str(&fs::read_to_string(&file).unwrap()).unwrap();
    let run = definition["run"][0].as_object_mut().unwrap();
    run.extend(of_run.as_object().unwrap().clone());
    fs::write(&file, definition.to_string()).unwrap();
    let path = folder.path("run");
    let options = PictureOptions {
        out: path.clone(),
        link: false,
        most_bytes: PictureOptions::MOST_BYTES,
    };
    pages(&RecordedFolders::read(&[path]).unwrap(), &options).markdown
}

/// Rows of a table that begin with a text.
fn rows<'a>(page: &'a str, start: &str) -> Vec<&'a str> {
    page.lines()
        .filter(|l| l.starts_with(&format!("| {start} |")))
        .collect()
}

#[test]
fn each_input_has_an_answer() {
    let folder = Scratch::new("answers-inputs");
    let mut all = records();
    for record in &mut all {
        let mut compute = drawn("raycast+mask@compute", 0, 3.0);
        compute.time_ms.solid = Samples::new(vec![40.0; 3]);
        record.measurement.strategies[3] = compute;
    }
    let silent = describe(&folder, &all, &json!({}));
    assert!(!silent.contains("What should I use for what I have?"));
    let view = describe(&folder, &all, &json!({ "input": "sawn wood" }));
    assert_eq!(
        rows(&view, "sawn wood"),
        [
            "| sawn wood | only the view moves | 2 | raycast+mask --rasteriser compute | ×3.00 | raycast+mask ×4.00 | ×2.00 | 550 (up to 1000) |"
        ]
    );
    let heading = view.find("What should I use for what I have?").unwrap();
    assert!(
        heading < view.find("Which strategy is exact").unwrap(),
        "it is the first table"
    );
    // The mesh moves: what stands on its clock is paid too.
    let mesh = describe(
        &folder,
        &all,
        &json!({ "input": "sawn wood", "moves": "mesh" }),
    );
    assert_eq!(
        rows(&mesh, "sawn wood"),
        [
            "| sawn wood | the mesh moves | 2 | raycast+mask | ×10.5 | raycast+mask --rasteriser compute ×23.0 | ×8.50 | 550 (up to 1000) |"
        ]
    );
    // One wrong pixel at one point, and a strategy is out.
    all[1].measurement.strategies[3]
        .comparison
        .as_mut()
        .unwrap()
        .decided_wrong_px = 1;
    let wrong = describe(&folder, &all, &json!({ "input": "sawn wood" }));
    assert!(rows(&wrong, "sawn wood")[0].contains("| raycast+mask | ×4.00 |  |"));
}

#[test]
fn broken_meshes_are_told_apart() {
    let folder = Scratch::new("answers-broken");
    let mut all = records();
    let mut whole = record(
        "5%",
        vec![
            drawn("raycast+mask", 4, 4.0),
            drawn("winding", 2, 90.0),
            drawn("planar", 1, 2.0),
        ],
    );
    whole.measurement.exact.cap_px = 200;
    for (index, unmarked, marked) in [(0, 0, 6), (1, 2, 0), (2, 0, 190)] {
        let found = &mut whole.measurement.strategies[index];
        let comparison = found.comparison.as_mut().unwrap();
        comparison.unmarked_wrong_px = unmarked;
        comparison.odd_parity_px = marked;
    }
    whole.scene = scene(Some("holes:amount=5%"));
    all.push(whole);
    let control = describe(&folder, &all, &json!({}));
    let exact = |page: &str| rows(page, "raycast+mask")[0].to_owned();
    assert!(exact(&control).starts_with("| raycast+mask | 3 | 3 | 2 | 4 |"));
    assert!(!control.contains("Which strategies cope with broken meshes"));

    all[2].truth = Some(scene(None));
    let page = describe(&folder, &all, &json!({}));
    assert!(exact(&page).starts_with("| raycast+mask | 2 | 2 | 2 | 0 |"));
    assert!(page.contains("1 point judged by the exact image of another scene"));
    let broken = rows(&page, "crank");
    assert_eq!(
        broken,
        [
            "| crank | winding | 1 | 1 | 1.00 % (up to 1.00 %) | 2 (up to 2) | 0 % (up to 0 %) | ×90.0 | least wrong, only in compare |",
            "| crank | raycast+mask | 1 | 1 | 2.00 % (up to 2.00 %) | 0 (up to 0) | 3.00 % (up to 3.00 %) | ×4.00 | use |",
            "| crank | planar | 1 | 1 | 0.50 % (up to 0.50 %) | 0 (up to 0) | 95 % (up to 95 %) | ×2.00 | too much is lost |",
        ]
    );
    // As an input: nothing is exact. What `render` takes is named, what marks nearly everything is not, and `winding` comes with its command.
    let alone = Scratch::new("answers-broken-alone");
    let input = describe(&alone, &all[2..], &json!({ "input": "what was scanned" }));
    let row = rows(&input, "what was scanned")[0].to_owned();
    assert!(
        row.contains(
            "| raycast+mask: 2.00 % wrong, 0 % unmarked, 3.00 % marked | ×4.00 | winding: 1.00 % wrong; draws no picture; run \
             `cutaway compare --strategies winding` |"
        ),
        "{row}"
    );
    // With nothing broken there is nothing to cope with.
    all[2].scene = scene(Some("holes:amount=0%"));
    let unbroken = describe(&folder, &all, &json!({}));
    assert!(rows(&unbroken, "crank").is_empty());
}

/// Points at which one of two strategies is twice as fast, by turns.
fn in_turns() -> Vec<Record> {
    let point = |(size, ratio): (&str, f64)| {
        let strategies = vec![
            drawn("stencil", 0, ratio),
            drawn("raycast+mask@compute", 0, 2.0),
        ];
        let mut point = record(size, strategies);
        point.scene = scene(None);
        point
    };
    let all = [("1", 1.0), ("2", 1.0), ("3", 4.0), ("4", 4.0)];
    all.map(point).into()
}

#[test]
fn all_tables_have_one_ranking_and_the_ratio_of_what_they_name() {
    let folder = Scratch::new("answers-ranking");
    let page = describe(&folder, &in_turns(), &json!({ "input": "sawn wood" }));
    // The median of the stencil is 2.5; that of whichever is faster at each point would be 1.5.
    let best = "| raycast+mask --rasteriser compute | ×2.00 | stencil (one plane, eye outside the cut) ×2.50, a draw |";
    for start in [
        "sawn wood | only the view moves | 4",
        "one plane | only the view moves | 4 of 4",
        "01-fixture: What does &lt;it> cost? | only the view moves | 4 | 4 of 4",
    ] {
        let found = rows(&page, start);
        assert_eq!(found.len(), 1, "{start} in\n{page}");
        assert!(found[0].contains(best), "{found:?}");
    }
    // Faster at three points of four is no draw.
    let mut all = in_turns();
    all[1] = record("2", all[2].measurement.strategies.clone());
    let page = describe(&folder, &all, &json!({ "input": "sawn wood" }));
    assert!(rows(&page, "sawn wood")[0].contains("eye outside the cut) ×4.00 |"));
}

#[test]
fn the_papers_path_is_told_where_it_is_swept() {
    let folder = Scratch::new("answers-paper");
    let swept = |names: [&str; 2]| {
        let all = vec![drawn(names[0], 3, 2.0), drawn(names[1], 9, 5.0)];
        describe(&folder, &[record("2%", all)], &json!({}))
    };
    let none = swept(["grid:64+mask", "raycast+vds:512"]);
    assert!(none.contains("was not timed at any point"), "the control");
    let page = swept(["grid:32+vds:1024", "grid:64+vds:512"]);
    assert!(
        page.contains("in the median (×2.00 to ×5.00) over 2 frames, and is exact in 0 of them")
    );
    // Its own parameters are enough, where they are asked.
    let page = swept(["grid:256+vds:1024", "grid:64+vds:512"]);
    assert!(
        page.contains("in the median (×2.00 to ×2.00) over 1 frame, and is exact in 0 of them")
    );
}

#[test]
fn long_reasons_are_short_and_whole() {
    let folder = Scratch::new("answers-reasons");
    let long = "it knows planes, and the clip-surface has a relief";
    let mut all = vec![
        record("2%", vec![refused("planar", long)]),
        record("5%", vec![refused("planar", "another")]),
    ];
    write(&folder.path("run"), &all, None);
    folder.run("report run").exits(0);
    let page = fs::read_to_string(folder.path("run/report.html")).unwrap();
    assert!(page.contains(&format!(
        "title=\"another; {long}\">another (and 1 more)</td>"
    )));
    all.truncate(1);
    fs::remove_dir_all(folder.path("run")).unwrap();
    write(&folder.path("run"), &all, None);
    folder.run("report run").exits(0);
    let page = fs::read_to_string(folder.path("run/report.html")).unwrap();
    assert!(page.contains(&format!("title=\"{long}\">it knows planes…</td>")));
}

#[test]
fn series_are_called_as_the_experiment_calls_them() {
    let folder = Scratch::new("answers-families");
    let mut all = records();
    let member = |family: &str, parameter: &str, value: i64| FamilyMember {
        family: family.to_owned(),
        parameters: [(parameter.to_owned(), Parameter::Whole(value))].into(),
    };
    for record in &mut all {
        record.measurement.strategies[1].name = "grid:256+vds:256".to_owned();
        record.families[1] = vec![
            member("grid:256+vds:{texels}", "texels", 256),
            member("grid:{cells}+vds:256", "cells", 256),
        ];
    }
    write(&folder.path("run"), &all, None);
    folder.run("report run").exits(0);
    let page = fs::read_to_string(folder.path("run/report.html")).unwrap();
    for family in ["grid:256+vds:texels", "grid:cells+vds:256"] {
        let named = page.matches(&format!(">{family}<")).count();
        assert!(named >= 2, "{family} names {named} series");
    }
    assert!(!page.contains("{texels}"), "a template is no name");
    all[0].families[1].clear();
    write(&folder.path("run"), &all, None);
    let message = folder.run("report run").exits(2).stderr;
    assert!(
        message.contains("`makers` has 3 entries for 4"),
        "{message}"
    );
}
