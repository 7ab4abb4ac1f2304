//! What comes first on a page, what a method's own page says, and folders of outside baselines alone.

use std::fs;

use cutaway_lab::experiment::{RecordedPicture, Warning};
use cutaway_lab::report::PictureOptions;

use super::command::Scratch;
use super::fixture::{NAME, records, refused, write};
use super::form::{broken_links, faults, repeated_notices, words_of};
use super::{report, report_of};

/// The page of the fixture, where its run stands for an input.
fn with_input(folder: &Scratch) -> String {
    write(&folder.path("run"), &records(), None);
    let file = folder.path(&format!("run/{NAME}/experiment.json"));
    let text = fs::read_to_string(&file).unwrap();
    let mut definition: serde_json::Value = serde_json::from_str(&text).unwrap();
    definition["run"][0]["input"] = "sawn wood".into();
    fs::write(&file, definition.to_string()).unwrap();
    report(&[&folder.path("run")], PictureOptions::MOST_BYTES).html
}

#[test]
fn the_answer_comes_before_the_evidence_and_that_before_the_machine() {
    let folder = Scratch::new("report-first");
    let page = with_input(&folder);
    let place = |text: &str| page.find(text).unwrap_or_else(|| panic!("no {text}"));
    let sentence = "Use <code>raycast+mask</code>: ×4.00 of drawing uncut. Cheaper and wrong: <code>grid:256+vds:1024</code>, ×2.00, up to 1000 wrong px.";
    let order = [
        sentence,
        "<table class=\"ranking\">",
        "<details",
        "<figure class=\"chart\">",
        "id=\"s-what-the-words-mean\"",
        "id=\"s-what-was-run\"",
    ];
    let places: Vec<usize> = order.into_iter().map(place).collect();
    assert!(places.is_sorted(), "{places:?}");
    // What was asked by a sweep of its own parameter, and what refuses, is no answer.
    let lines = page.split("<table class=\"ranking\">").nth(1).unwrap();
    let lines = words_of(&lines.split("</table>").next().unwrap().replace("<wbr>", ""));
    for (text, is_there) in [
        ("raycast+mask", true),
        ("exact", true),
        ("refuses: a <script>alert", true),
        ("grid:64+mask", false),
    ] {
        assert_eq!(lines.contains(text), is_there, "{text} in {lines}");
    }
}

#[test]
fn a_page_is_in_form() {
    let folder = Scratch::new("report-form");
    assert_eq!(faults(&with_input(&folder)), [""; 0]);
}

#[test]
fn links_stay_in_sight_and_lead_back() {
    let folder = Scratch::new("report-links");
    let page = report_of(&folder, &records()).html;
    let links = page.split("<nav class=\"sections\"").nth(1).unwrap();
    let links = links.split("</nav>").next().unwrap();
    assert!(links.contains("href=\"#top\"") && page.contains("<body id=\"top\">"));
    assert_eq!(
        links.matches("<a ").count(),
        1 + page.matches("<h2 ").count(),
        "one for each section, and one back"
    );
    assert!(page.contains("nav.sections { position: sticky;"));
    assert_eq!(broken_links(&page), [""; 0]);
}

#[test]
fn warnings_are_said_once() {
    let folder = Scratch::new("report-warnings");
    let mut records = records();
    for strategy in ["raycast+mask", "grid:256+vds:1024", "grid:64+mask"] {
        records[1].warnings.push(Warning::Noisy {
            strategy: strategy.to_owned(),
            spread: 0.5,
        });
    }
    let page = report_of(&folder, &records).html;
    assert_eq!(repeated_notices(&page), [""; 0]);
    for (text, count) in [
        ("draws on the CPU", 1),
        ("measure again with more --rounds", 1),
        (
            "times scatter around their median: raycast+mask by 50 %, grid:256+vds:1024 by 50 %, grid:64+mask by 50 %",
            1,
        ),
    ] {
        assert_eq!(page.matches(text).count(), count, "{text}");
    }
}

#[test]
fn one_switch_shows_all_errors_of_a_frame() {
    let folder = Scratch::new("report-switch");
    let mut records = records();
    records[1].pictures.clear();
    let plain = report_of(&folder, &records).html;
    assert!(!plain.contains("class=\"switch\""), "nothing to switch to");
    records[0].pictures = ["exact", "raycast+mask", "grid:256+vds:1024"]
        .map(|drawer| RecordedPicture {
            drawer: drawer.to_owned(),
            file: "exact.png".to_owned(),
            heatmap: (drawer != "exact").then(|| "exact.png".to_owned()),
        })
        .into();
    let page = report_of(&folder, &records).html;
    for (text, count) in [
        ("class=\"switch\"", 1),
        ("<img class=\"picture\"", 3),
        ("<img class=\"errors\"", 2),
        (
            "missed cap</b>: there is a cap, and the method draws none",
            2,
        ),
    ] {
        assert_eq!(page.matches(text).count(), count, "{text}");
    }
}

#[test]
fn a_method_has_a_page_of_its_own() {
    let folder = Scratch::new("report-method");
    let mut records = records();
    let twice = refused("planar", "a <script>alert(1)</script> | relief");
    records[0].measurement.strategies[3] = twice;
    write(&folder.path("run"), &records, None);
    let ran = folder
        .run("report run --method grid:256+vds:1024 --out out")
        .exits(0);
    let names = ["html", "md"].map(|e| format!("out/method-grid-256+vds-1024.{e}\n"));
    assert_eq!(ran.text(), names.concat());
    let read = |name: &str| fs::read_to_string(folder.path(name.trim_end())).unwrap();
    let [page, text] = [&names[0], &names[1]].map(|n| read(n));
    for said in [
        "`grid:256+vds:1024` drew 2 of 2 points, and is exact at 0 of them. At worst 1000 decided pixels are wrong.",
        "A frame takes ×2.00 of drawing uncut in the median",
        "Relative to the fastest exact method of each point, its frame takes ×0.50",
        "| 01-fixture crank: size = 2% |",
        "| 01-fixture crank: size = 10% |",
    ] {
        assert!(text.contains(said), "{said} is missing from\n{text}");
    }
    assert!(!text.contains("What it refuses") && !text.contains("raycast+mask"));
    assert_eq!(faults(&page), [""; 0]);
    assert!(!folder.path("out/report.html").exists());
    // One that refuses says why, and where.
    folder.run("report run --method planar --out out").exits(0);
    let text = read("out/method-planar.md");
    assert!(text.contains("`planar` drew 0 of 2 points"), "{text}");
    let row = "| a &lt;script>alert(1)&lt;/script> \\| relief | 2 | 01-fixture crank 2%; 01-fixture crank 10% |";
    assert!(text.contains(row), "{text}");
    // One that no point asked is refused by name, and leaves nothing.
    let message = folder
        .run("report run --method planer --out other")
        .exits(2)
        .stderr;
    for word in ["--method planer", "help: did you mean `planar`?"] {
        assert!(message.contains(word), "{message}");
    }
    assert!(!folder.path("other").exists());
}

#[test]
fn outside_baselines_are_reported_alone() {
    let folder = Scratch::new("report-peers-alone");
    write(&folder.path("run"), &records(), None);
    fs::create_dir_all(folder.path("alone/peers")).unwrap();
    let baseline = folder.path("run/peers/planar.json");
    fs::copy(&baseline, folder.path("alone/peers/planar.json")).unwrap();
    for (dir, out) in [("alone", "a"), ("alone/peers", "b")] {
        folder.run(&format!("report {dir} --out {out}")).exits(0);
        let page = fs::read_to_string(folder.path(&format!("{out}/report.md"))).unwrap();
        assert!(page.contains("1 comparison with other tools"), "{page}");
        assert!(
            page.contains("+25.0000 %") && page.contains("vtk 9.9"),
            "{page}"
        );
        assert!(!page.contains("What was run"), "no machine of ours");
    }
    // What is reported there does not disturb the next report.
    folder.run("report alone/peers").exits(0);
    folder.run("report alone/peers").exits(0);
    // Points whose run is lost are no baselines alone, and an empty folder is none.
    fs::remove_file(folder.path("run/run.json")).unwrap();
    fs::create_dir_all(folder.path("empty")).unwrap();
    for dir in ["run", "empty"] {
        let message = folder.run(&format!("report {dir} --out c")).exits(2).stderr;
        assert!(
            message.contains("there is no run in this folder"),
            "{message}"
        );
    }
}
