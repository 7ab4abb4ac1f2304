//! The report of the committed record, and the figures that the book takes from it.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use cutaway_lab::experiment::{Record, Samples};
use cutaway_lab::report::{Pages, PictureOptions, RecordedFolders, pages};
use serde_json::Value;

use crate::common::root;
use crate::measured::report::fetches;
use crate::measured::report::form::faults;

#[path = "report/book.rs"]
mod book;

/// A full run, and one of `09-broken`.
const RECORDS: [&str; 2] = [
    "experiments/record/2026-11-24-llvmpipe",
    "experiments/record/2026-11-28-llvmpipe-broken",
];

static RECORDED: LazyLock<RecordedFolders> = LazyLock::new(|| {
    let folders = RECORDS.map(|folder| root().join(folder));
    RecordedFolders::read(&folders).unwrap()
});

fn pages_of(record: &str) -> Pages {
    let recorded = RecordedFolders::read(&[root().join(record)]).unwrap();
    let options = PictureOptions {
        out: PathBuf::from("/"),
        link: false,
        most_bytes: PictureOptions::MOST_BYTES,
    };
    pages(&recorded, &options)
}

static PAGES: LazyLock<Pages> = LazyLock::new(|| pages_of(RECORDS[0]));
static BROKEN: LazyLock<Pages> = LazyLock::new(|| pages_of(RECORDS[1]));

/// Cells of a row of the page that begins with a text.
fn row(start: &str) -> Vec<&'static str> {
    row_of(&PAGES, start)
}

fn row_of<'a>(pages: &'a Pages, start: &str) -> Vec<&'a str> {
    let mut rows = pages.markdown.lines();
    let row = rows.find(|l| l.starts_with(&format!("| {start} |")));
    let row = row.unwrap_or_else(|| panic!("no row begins with {start}"));
    row.trim_matches('|').split('|').map(str::trim).collect()
}

#[test]
fn one_plane_has_one_answer() {
    let cuts = row("plane cuts");
    assert_eq!(cuts[3], "raycast+mask --rasteriser compute", "{cuts:?}");
    let stencil = "stencil (one plane, eye outside the cut";
    assert!(cuts[5].starts_with(stencil), "{cuts:?}");
    // Who drew all points comes first there, and who drew some of them in less time stands beside it.
    let one = row("one plane | only the view moves");
    assert_eq!(one[3], "raycast+mask", "{one:?}");
    // Where there are several planes the stencil has no say.
    let several = row("several planes | only the view moves");
    assert!(
        several.iter().all(|c| !c.contains("stencil")),
        "{several:?}"
    );
}

#[test]
fn what_is_recommended_can_be_drawn() {
    let broken = row_of(&BROKEN, "broken meshes");
    assert!(broken[3].starts_with("raycast+winding"), "{broken:?}");
    let page = &BROKEN.markdown;
    let lines = PAGES.markdown.lines().chain(page.lines());
    let used = lines.filter(|l| l.ends_with("| use |"));
    let names: Vec<&str> = used.map(|l| l.split(" | ").nth(1).unwrap()).collect();
    assert!(names.len() > 4, "{names:?}");
    assert!(!names.contains(&"winding"), "{names:?}");
    // It leaves no pixel of the holes unmarked, for it marks more than there is of the cap.
    let holes = page.lines().find(|l| l.starts_with("| holes | planar |"));
    assert!(
        holes.unwrap().ends_with("| too much is lost |"),
        "{holes:?}"
    );
}

#[test]
fn the_page_is_in_form() {
    for pages in [&PAGES, &BROKEN] {
        assert_eq!(faults(&pages.html), [""; 0]);
        assert_eq!(fetches(&pages.html), [""; 0]);
    }
}

#[test]
fn each_input_is_answered_in_a_sentence_and_a_chart() {
    let page = &PAGES.markdown;
    let inputs = page.split("\n## ").nth(1).unwrap();
    let answers = inputs.split("\n##### ").skip(1);
    let answers: Vec<&str> = answers.filter(|a| a.contains("moves\n")).collect();
    assert_eq!(answers.len(), 9, "{inputs}");
    for answer in &answers {
        let says = answer.contains("\nUse `") || answer.contains("Least wrong: ");
        assert!(says && answer.contains("| method | median |"), "{answer}");
    }
    let planes = answers.iter().find(|a| a.starts_with("plane cuts,"));
    let cell = row("plane cuts")[4].to_owned();
    let said = format!("Use `raycast+mask --rasteriser compute`: {cell} of drawing uncut");
    assert!(planes.unwrap().contains(&said), "{planes:?}");
}

/// Time of all clocks of the one strategy of a point of an experiment.
fn all_clocks_ms(experiment: &str, values: &[(&str, &str)]) -> f64 {
    let mut experiments = RECORDED.folders.iter().flat_map(|f| &f.experiments);
    let found = experiments.find(|e| e.synopsis.name == experiment).unwrap();
    let is_it = |r: &&Record| {
        values
            .iter()
            .all(|(k, v)| r.parameters[*k].to_string() == *v)
    };
    let time = &found
        .records
        .iter()
        .find(is_it)
        .unwrap()
        .measurement
        .strategies[0]
        .time_ms;
    Samples::sum(&[&time.solid, &time.cut, &time.frame]).median
}

#[test]
fn cutaways_and_styles_have_their_cost_over_the_plain_picture() {
    let of = |cutaway| {
        let values = [("style", "toon"), ("size", "1024"), ("cutaway", cutaway)];
        all_clocks_ms("15-cutaways", &values)
    };
    let ratio = |value: f64| format!("×{value:.2}");
    let cells = row("size = 1024, style = toon");
    let [cutout, breakaway] = ["cutout", "breakaway"].map(|c| ratio(of(c) / of("none")));
    assert_eq!(cells[2..], [cutout, breakaway]);
    let of = |style| all_clocks_ms("14-illustration", &[("style", style)]);
    assert_eq!(row("ink")[2], ratio(of("ink") / of("lit")));
    assert!(
        PAGES
            .markdown
            .contains("Relative to `cutaway = none` in the same picture: `cutout` ×")
    );
}

#[test]
fn all_commands_are_there_and_missing_pictures_are_said_once() {
    let page = &PAGES.markdown;
    let invocations = page.lines().filter(|l| l.contains("| `cutaway measure "));
    let points: Vec<&str> = invocations
        .map(|l| l.split(" | ").nth(3).unwrap())
        .collect();
    assert_eq!(points, ["96"], "of one command");
    assert!(page.contains("01-paper.toml experiments/curated/02-accuracy.toml"));
    assert!(page.contains("| took, all commands together | 1340 s |"));
    let pictures: usize = (RECORDED.folders[0].experiments.iter())
        .flat_map(|e| &e.records)
        .flat_map(|r| r.pictures.iter().map(|p| p.files().count()))
        .sum();
    let said = format!("{pictures} pictures of ");
    assert_eq!(page.matches(&said).count(), 1, "{said}");
    assert_eq!(page.matches("not beside the records").count(), 1);
}

/// What values of sweeps are called.
fn swept(definition: &Value) -> Vec<&str> {
    let runs = definition["run"].as_array().unwrap().iter();
    let axes = runs.filter_map(|r| r.get("sweep")?.as_object());
    let values = axes.flat_map(|s| s.values());
    let values = values.flat_map(|v| v.get("values").unwrap_or(v).as_array().unwrap());
    values
        .filter_map(|v| v.get("is").unwrap_or(v).as_str())
        .collect()
}

/// A chart whose title or note names a value that is swept, and so is not that of all it shows.
fn misnamed(definition: &Value) -> Option<String> {
    let charts = definition.get("chart")?.as_array()?.iter();
    let mut texts = charts.flat_map(|c| [c.get("title"), c.get("note")].into_iter().flatten());
    let names = |text: &&Value| {
        let mut words = text.as_str().unwrap().split([' ', ',', '.']);
        words.any(|word| swept(definition).contains(&word))
    };
    texts.find(names).map(ToString::to_string)
}

/// The folder that holds the record of an experiment.
fn record_of(experiment: &OsStr) -> PathBuf {
    let runs = fs::read_dir(root().join("experiments/record")).unwrap();
    let mut folders = runs.map(|run| run.unwrap().path().join(experiment));
    let found = folders.find(|folder| folder.is_dir());
    found.unwrap_or_else(|| panic!("there is no record of {}", experiment.display()))
}

#[test]
fn titles_name_no_scene_that_the_chart_does_not_show() {
    let read = |file: &Path| fs::read_to_string(file).unwrap();
    for entry in fs::read_dir(root().join("experiments/curated")).unwrap() {
        let file = entry.unwrap().path();
        let curated: Value = toml_edit::de::from_str(&read(&file)).unwrap();
        assert_eq!(misnamed(&curated), None, "{}", file.display());
        let recorded = record_of(file.file_stem().unwrap());
        let recorded: Value =
            serde_json::from_str(&read(&recorded.join("experiment.json"))).unwrap();
        // Of late the file is told as it is.
        let recorded = match recorded["toml"].as_str() {
            Some(text) => toml_edit::de::from_str(text).unwrap(),
            None => recorded,
        };
        assert_eq!(
            misnamed(&recorded),
            None,
            "the record of {}",
            file.display()
        );
    }
    let planted = serde_json::json!({
        "run": [{ "sweep": { "model": [{ "is": "crank" }, { "is": "earth" }] } }],
        "chart": [{ "title": "Error against cost, crank" }],
    });
    assert!(misnamed(&planted).is_some(), "the control");
}

#[test]
fn a_chart_of_one_point_is_called_by_it() {
    // In the order of the experiment's file.
    let models = ["crank", "gears", "earth", "sponge"];
    let titles = PAGES
        .markdown
        .lines()
        .filter(|l| l.starts_with("**Error against cost") && l.contains("model = "));
    let titles: Vec<&str> = titles.map(|l| l.split("**").nth(1).unwrap()).collect();
    assert_eq!(titles.len(), models.len(), "{titles:?}");
    for (title, model) in titles.iter().zip(models) {
        let named = models.into_iter().filter(|m| title.contains(m));
        assert_eq!(named.collect::<Vec<_>>(), [model], "{title}");
    }
}
