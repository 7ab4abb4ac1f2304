//! Reports of recorded runs: everything recorded is in every form, nothing recorded can act in a page, what was missed is loud, and
//! folders that cannot be reported are refused by name. How the page looks and behaves is checked by `scripts/check-report.sh`.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::fs;
use std::path::Path;

use cutaway_lab::experiment::Record;
use cutaway_lab::report::{Pages, PictureOptions, RecordedFolders, pages};

use crate::common::command;
mod answering;
pub(crate) mod fixture;
pub(crate) mod form;
mod whole;

use command::Scratch;
use fixture::{NAME, PNG, adapter, cases, reached, records, write};

fn report(folders: &[&Path], most_bytes: u64) -> Pages {
    let folders: Vec<_> = folders.iter().map(|f| f.to_path_buf()).collect();
    let recorded = RecordedFolders::read(&folders).unwrap();
    let options = PictureOptions {
        out: folders[0].clone(),
        link: false,
        most_bytes,
    };
    pages(&recorded, &options)
}

fn report_of(folder: &Scratch, records: &[Record]) -> Pages {
    write(&folder.path("run"), records, Some(&cases()));
    report(&[&folder.path("run")], PictureOptions::MOST_BYTES)
}

/// Words by which a page would fetch something.
pub(crate) fn fetches(page: &str) -> Vec<&'static str> {
    let words = [
        "src=\"http",
        "src=\"//",
        "srcset",
        "url(",
        "@import",
        "<iframe",
        "<object",
        "<embed",
        "fetch(",
        "XMLHttpRequest",
        "import(",
        "rel=\"stylesheet\"",
        "http-equiv",
    ];
    words.into_iter().filter(|w| page.contains(w)).collect()
}

#[test]
fn every_record_is_in_every_form() {
    let folder = Scratch::new("report-all");
    let records = records();
    let pages = report_of(&folder, &records);
    for text in [&pages.html, &pages.markdown] {
        for said in [
            NAME,
            "crank",
            "size = 2%",
            "size = 10%",
            "raycast+mask",
            "grid:256+vds:1024",
            "grid:64+mask",
            "planar",
            "# 2%",
            "# 10%",
            "2026-01-02T03:04:05Z",
            "a case called 10",
            "hard_cases::case_2",
            "vtk 9.9",
            "+25.0000 %",
            "flicker px",
            "no_such_px",
            "storage_buffers",
        ] {
            assert!(text.contains(said), "{said} is missing from\n{text}");
        }
    }
    let mut lines = pages.csv.lines();
    let heading: Vec<&str> = lines.next().unwrap().split(',').collect();
    for name in [
        "cells=",
        "size=",
        "decided_wrong_px",
        "flicker_px",
        "time_ms.frame",
        "time_ms.frame.mad",
        "ratio",
        "bytes",
    ] {
        assert!(heading.contains(&name), "{name} is not in {heading:?}");
    }
    assert_eq!(lines.count(), 8, "a row for each point and strategy");
    let json: serde_json::Value = serde_json::from_str(&pages.json).unwrap();
    let read = &json["folders"][0]["experiments"][0]["records"];
    assert_eq!(
        *read,
        serde_json::json!(records),
        "records are as they were"
    );
    assert_eq!(json["derived"][0]["fastest_exact"][0], "raycast+mask");
}

#[test]
fn both_pages_have_the_same_tables() {
    let folder = Scratch::new("report-tables");
    let pages = report_of(&folder, &records());
    let in_html = pages.html.matches("<table class=\"grid\">").count()
        + pages.html.matches("<table class=\"bars\">").count()
        + pages.html.matches("<table class=\"ranking\">").count();
    let in_markdown = pages
        .markdown
        .lines()
        .filter(|l| l.starts_with("|---|"))
        .count();
    assert!(in_html > 10, "{in_html} tables");
    assert_eq!(in_html, in_markdown);
}

#[test]
fn nothing_recorded_acts_and_nothing_is_fetched() {
    let folder = Scratch::new("report-escape");
    let page = report_of(&folder, &records()).html;
    assert!(
        !page.contains("<script>alert"),
        "a record's own script is in the page"
    );
    assert!(
        page.contains("&lt;script&gt;alert(1)") && page.contains("&lt;script&gt;alert(2)"),
        "what it says is told"
    );
    assert_eq!(
        page.matches("<script").count(),
        1,
        "the script of the page alone"
    );
    assert_eq!(fetches(&page), [""; 0]);
    let planted = format!("{page}<img src=\"https://example.invalid/x.png\">");
    assert_eq!(fetches(&planted), ["src=\"http"], "planted");
}

#[test]
fn what_was_missed_is_loud() {
    let folder = Scratch::new("report-missed");
    let calm = report_of(&folder, &records());
    assert!(
        calm.html.contains("All 4 expectations were reached"),
        "the control"
    );
    assert!(
        !calm.html.contains("notice bad") && !calm.markdown.contains("**Wrong**"),
        "the control"
    );
    let mut records = records();
    records[1]
        .expectations
        .push(reached("grid:256+vds:1024", false));
    let loud = report_of(&folder, &records);
    let missed = "Expectation missed by grid:256+vds:1024. Expected: 0 decided wrong px. Found: what was found.";
    assert!(loud.html.contains("1 of 5 expectations were missed"));
    assert!(
        loud.html
            .contains(&format!("<p class=\"notice bad\">{missed}"))
    );
    assert!(loud.markdown.contains(&format!("> **Wrong**: {missed}")));
    // A point with something missed is open from the start, although it is not the first.
    assert!(
        loud.html
            .contains("<details open><summary>size = 10% · 1 expectation missed")
    );
}

#[test]
fn missed_cases_come_first() {
    let folder = Scratch::new("report-cases");
    let place = |page: &str, id: &str| {
        page.find(&format!("<td class=\"plain\">a case called {id}<"))
            .unwrap()
    };
    let calm = report_of(&folder, &records()).html;
    assert!(place(&calm, "2") < place(&calm, "10"), "by number");
    let mut cases = cases();
    cases.cases[1].expectations[0].holds = false;
    write(&folder.path("run"), &records(), Some(&cases));
    let loud = report(&[&folder.path("run")], PictureOptions::MOST_BYTES).html;
    assert!(
        place(&loud, "10") < place(&loud, "2"),
        "what was missed is first"
    );
    assert!(loud.contains("Case 10 (a case called 10). Expectation missed by raycast+mask."));
}

#[test]
fn the_price_of_accuracy_is_that_of_the_front() {
    let folder = Scratch::new("report-front");
    let pages = report_of(&folder, &records());
    // From 1000 wrong pixels to 100 for twice the time; then to none for twice that.
    assert!(
        pages
            .markdown
            .contains("| grid:64+mask | 1000 | 1 |  | cheapest |"),
        "{}",
        pages.markdown
    );
    assert!(
        pages
            .markdown
            .contains("| grid:256+vds:1024 | 100 | 2 | ×2.00 (spread unknown) | ×2.00 |")
    );
    assert!(
        pages
            .markdown
            .contains("| raycast+mask | 0 | 4 | ×2.00 (spread unknown) | to no error at all |")
    );
    // A chart of a front for each of two points, one chart for both, and none where there is nothing to show.
    assert_eq!(pages.html.matches("<figure class=\"chart\">").count(), 3);
    assert_eq!(pages.html.matches("class=\"front\"").count(), 2);
    assert_eq!(pages.html.matches("class=\"mark\"").count(), 4 * 3);
}

#[test]
fn figures_of_two_adapters_say_whose_they_are() {
    let folder = Scratch::new("report-adapters");
    write(&folder.path("a"), &records(), None);
    let mut others = records();
    for record in &mut others {
        record.measurement.adapter = adapter("two");
    }
    write(&folder.path("b"), &others, None);
    let page = report(
        &[&folder.path("a"), &folder.path("b")],
        PictureOptions::MOST_BYTES,
    )
    .html;
    let at = |name: &str| folder.path(name).display().to_string();
    let (a, b) = (at("a"), at("b"));
    for said in [
        format!("size = 2% · {a}, one"),
        format!("size = 2% · {b}, two"),
        format!("By size ({a}, one)"),
        format!("By size ({b}, two)"),
        format!("On {b}, two: <code>grid:256+vds:1024"),
    ] {
        assert!(page.contains(&said), "{said} is missing");
    }
    let twice = report(
        &[&folder.path("a"), &folder.path("a")],
        PictureOptions::MOST_BYTES,
    )
    .html;
    assert!(
        !twice.contains("size = 2% ·"),
        "a folder named twice is one"
    );
}

#[test]
fn pictures_are_inside_linked_or_said_to_be_missing() {
    let folder = Scratch::new("report-pictures");
    write(&folder.path("run"), &records(), None);
    let embedded = "src=\"data:image/png;base64,iVBOR";
    let inside = report(&[&folder.path("run")], PictureOptions::MOST_BYTES).html;
    assert_eq!(
        inside.matches(embedded).count(),
        2,
        "a picture of each point"
    );
    // The first point has half of the room, which is too little; what it leaves is for the second.
    let small = report(&[&folder.path("run")], PNG.len() as u64).html;
    assert_eq!(small.matches(embedded).count(), 1, "one fits");
    assert_eq!(
        small
            .matches("Not in this page, which would be too large (see --link): exact.")
            .count(),
        1,
        "the other is said to be left out"
    );
    folder.run("report run --link --out elsewhere").exits(0);
    let linked = fs::read_to_string(folder.path("elsewhere/report.html")).unwrap();
    assert!(!linked.contains(embedded), "linked");
    assert!(
        linked.contains(&format!("src=\"../run/{NAME}/exact.png\"")),
        "linked"
    );
    fs::remove_file(folder.path(&format!("run/{NAME}/exact.png"))).unwrap();
    let gone = report(&[&folder.path("run")], PictureOptions::MOST_BYTES).html;
    let said = "2 pictures of 2 points are not beside the records";
    assert_eq!(gone.matches(said).count(), 1, "said once for all points");
    assert!(!inside.contains("not beside the records"), "the control");
    assert!(!gone.contains("class=\"gallery\""), "no empty galleries");
}

#[test]
fn the_command_writes_four_files_and_says_where() {
    let folder = Scratch::new("report-command");
    write(&folder.path("run"), &records(), None);
    let ran = folder.run("report run").exits(0);
    assert_eq!(
        ran.text(),
        "run/report.html\nrun/report.md\nrun/report.csv\nrun/report.json\n"
    );
    for line in ran.text().lines() {
        assert!(
            fs::metadata(folder.path(line)).unwrap().len() > 1000,
            "{line}"
        );
    }
    // What it wrote there does not disturb it.
    folder.run("report run").exits(0);
}

#[test]
fn folders_that_cannot_be_reported_are_refused_by_name() {
    let folder = Scratch::new("report-hostile");
    let record = format!("run/{NAME}/crank.2.json");
    type Plant = fn(&str) -> Option<String>;
    let plants: [(&str, Plant, &str); 7] = [
        ("run/run.json", |_| None, "there is no run in this folder"),
        (
            &format!("run/{NAME}/experiment.json"),
            |_| Some("{".to_owned()),
            "incomplete or invalid",
        ),
        (
            &record,
            |t| Some(t[..t.len() / 2].to_owned()),
            "incomplete or invalid",
        ),
        (
            &record,
            |t| Some(t.replacen("\"format\":2", "\"format\":99", 1)),
            "format 99",
        ),
        (
            &record,
            |t| Some(t.replacen("\"format\"", "\"from\"", 1)),
            "which form",
        ),
        (&record, |t| Some(t.replace(NAME, "02-other")), "02-other"),
        (
            "run/peers/planar.json",
            |t| Some(t.replace("\"rows\"", "\"rwos\"")),
            "rows",
        ),
    ];
    for (path, plant, said) in plants {
        write(&folder.path("run"), &records(), None);
        folder.run("report run --out out").exits(0);
        let file = folder.path(path);
        match plant(&fs::read_to_string(&file).unwrap()) {
            Some(text) => fs::write(&file, text).unwrap(),
            None => fs::remove_file(&file).unwrap(),
        }
        let message = folder.run("report run --out out").exits(2).stderr;
        for word in [path, said, "help: "] {
            assert!(
                message.contains(word),
                "{path}: {word} is missing from {message}"
            );
        }
    }
    let mut uneven = records();
    uneven[0].figures.pop();
    write(&folder.path("run"), &uneven, None);
    let message = folder.run("report run").exits(2).stderr;
    assert!(
        message.contains("`figures` has 3 entries for 4 strategies"),
        "{message}"
    );
    let message = folder.run("report nowhere").exits(2).stderr;
    assert!(
        message.contains("nowhere: there is no such folder"),
        "{message}"
    );
    let message = folder.run("report run/run.json").exits(2).stderr;
    assert!(message.contains("it is a file, not a folder"), "{message}");
}
