//! What a folder lacks, what else lies in it, and what belongs to which folder and point.

use std::fs;
use std::path::Path;

use cutaway_lab::experiment::{Invocation, RecordedPicture, Warning};
use cutaway_lab::report::PictureOptions;

use super::command::Scratch;
use super::fixture::{NAME, records, scene, write};
use super::{report, report_of};

/// Rewrites a JSON file.
fn edit(file: &Path, change: impl Fn(&mut serde_json::Value)) {
    let mut value = serde_json::from_str(&fs::read_to_string(file).unwrap()).unwrap();
    change(&mut value);
    fs::write(file, value.to_string()).unwrap();
}

#[test]
fn points_that_are_not_there_are_said_aloud() {
    let folder = Scratch::new("report-missing");
    write(&folder.path("run"), &records(), None);
    let file = folder.path(&format!("run/{NAME}/experiment.json"));
    edit(&file, |v| {
        v["points"] = serde_json::json!(["crank.2", "crank.10"])
    });
    let whole = report(&[&folder.path("run")], PictureOptions::MOST_BYTES);
    assert!(!whole.markdown.contains(" missing in "), "the control");
    for (file, wanted) in [
        ("crank.2", "1 of 2 points of 01-fixture is missing in "),
        ("crank.10", "2 of 2 points of 01-fixture are missing in "),
    ] {
        fs::remove_file(folder.path(&format!("run/{NAME}/{file}.json"))).unwrap();
        let page = report(&[&folder.path("run")], PictureOptions::MOST_BYTES).markdown;
        assert_eq!(page.matches(wanted).count(), 2, "{page}");
        let command = "```sh\ncutaway measure 01-fixture.toml --out here\n```";
        assert_eq!(page.matches(command).count(), 3, "{page}");
        assert!(page.contains(file), "{page}");
        assert!(!page.contains("Nothing was expected"), "{page}");
    }
}

#[test]
fn areas_that_disagree_count_as_missed() {
    let folder = Scratch::new("report-peers");
    write(&folder.path("run"), &records(), None);
    let file = folder.path("run/peers/planar.json");
    for (holds, phrase) in [
        (true, "All 3 expectations were reached"),
        (false, "1 of 3 expectations were missed"),
    ] {
        edit(&file, |v| {
            v["checks"] = serde_json::json!([{ "mesh": "torus", "cut": "x", "tool": "vtk", "off": 0.5, "bound": 0.1,
                "bound_is": "1e-6 of the area", "holds": holds }]);
        });
        let page = report(&[&folder.path("run")], PictureOptions::MOST_BYTES).markdown;
        assert!(page.contains(phrase), "{page}");
        assert_eq!(page.contains("2.500000 (missed)"), !holds, "{page}");
        assert_eq!(page.contains("torus, x: the area of vtk is off by"), !holds);
    }
}

#[test]
fn folders_are_not_mixed_and_neither_are_quick_runs() {
    let folder = Scratch::new("report-benches");
    write(&folder.path("a"), &records(), None);
    write(&folder.path("b"), &records(), None);
    let at = |name: &str| folder.path(name);
    let both = report(&[&at("a"), &at("b")], PictureOptions::MOST_BYTES);
    let b = at("b").display().to_string();
    assert!(both.html.contains(&format!("By size ({b}, one)")));
    let mut lines = both.csv.lines();
    let heading = lines.next().unwrap();
    for name in [
        "folder",
        "rounds",
        "cap_px",
        "surface_px",
        "undecided_px",
        "truth",
    ] {
        let count = heading.split(',').filter(|h| *h == name).count();
        assert_eq!(count, 1, "{name} in {heading}");
    }
    let of_b = lines.filter(|l| l.starts_with(&format!("{b},")));
    assert_eq!(of_b.count(), 8);
    let mut mixed = records();
    mixed[0].is_quick = true;
    write(&folder.path("mixed"), &mixed, None);
    let page = report(&[&at("mixed")], PictureOptions::MOST_BYTES).html;
    assert!(page.contains("size = 2% · one, quick") && page.contains("size = 10% · one, in full"));
}

#[test]
fn a_point_says_its_scene_its_truth_and_what_was_said_of_it() {
    let folder = Scratch::new("report-scene");
    let plain = report_of(&folder, &records());
    assert!(
        !plain.markdown.contains("exact image is the truth"),
        "the control"
    );
    let mut records = records();
    for record in &mut records {
        record.scene = scene(Some("holes"));
        record.truth = Some(scene(None));
        record.warnings.push(Warning::Opening {
            text: "the section misses the model".to_owned(),
            help: "move it".to_owned(),
        });
    }
    let pages = report_of(&folder, &records);
    for page in [&pages.html, &pages.markdown] {
        for (said, count) in [
            ("section = ", 4),
            ("kind = ", 2),
            ("The scene whose exact image is the truth", 2),
            // Of all points, and so said once.
            ("the section misses the model", 1),
        ] {
            assert_eq!(page.matches(said).count(), count, "{said} in\n{page}");
        }
    }
    assert!(pages.csv.contains(",10,20,1,29,other,"), "{}", pages.csv);
}

#[test]
fn all_commands_that_measured_are_named() {
    let folder = Scratch::new("report-invocations");
    let command = |files: &str| format!("cutaway measure {files} --out here");
    let mut records = records();
    for (record, began, files) in [(0, "T22", "second.toml"), (1, "T21", "first.toml")] {
        records[record].invocation = Some(Invocation {
            began: format!("2026-01-02{began}:00:00Z"),
            load: Some(0.25),
            command: command(files),
            ..Invocation::default()
        });
    }
    let page = report_of(&folder, &records).markdown;
    let row = |began: &str, load: &str, points, files| {
        let at = folder.path("run").display().to_string();
        format!(
            "| {at} | {began} | {load} | {points} | `{}` |\n",
            command(files)
        )
    };
    // The last is that of `run.json`, which measured no point of these.
    let rows = [
        row("2026-01-02T21:00:00Z", "0.25", 1, "first.toml"),
        row("2026-01-02T22:00:00Z", "0.25", 1, "second.toml"),
        row("", "", 0, "01-fixture.toml"),
    ];
    assert!(page.contains(&rows.concat()), "{page}");
    for files in ["first.toml", "second.toml", "01-fixture.toml"] {
        let to_copy = format!("```sh\n{}\n```", command(files));
        assert_eq!(page.matches(&to_copy).count(), 1, "{files}");
    }
    assert!(page.contains("| took, all commands together | 7 s |"));
    // Older records name no command: all are of that of `run.json`.
    records.iter_mut().for_each(|r| r.invocation = None);
    let page = report_of(&folder, &records).markdown;
    let only = row("2026-01-02T03:04:05Z", "", 2, "01-fixture.toml");
    assert!(page.contains(&only), "{page}");
}

#[test]
fn points_are_in_the_order_of_the_experiment() {
    let folder = Scratch::new("report-order");
    let place = |page: &str, size: &str| page.find(&format!("<summary>size = {size}")).unwrap();
    let natural = report_of(&folder, &records()).html;
    assert!(
        place(&natural, "2%") < place(&natural, "10%"),
        "the control"
    );
    let listed = |records: &[cutaway_lab::experiment::Record]| {
        write(&folder.path("run"), records, None);
        let file = folder.path(&format!("run/{NAME}/experiment.json"));
        edit(&file, |v| {
            v["points"] = serde_json::json!(["crank.10", "crank.2"])
        });
        report(&[&folder.path("run")], PictureOptions::MOST_BYTES).html
    };
    let page = listed(&records());
    assert!(place(&page, "10%") < place(&page, "2%"));
    assert!(page.contains("<details open><summary>size = 10%"));
    // The open point is the one that has pictures.
    let mut records = records();
    records[1].pictures.clear();
    let page = listed(&records);
    assert!(page.contains("<details open><summary>size = 2%"));
    assert!(page.contains("<details><summary>size = 10%"));
}

#[test]
fn a_slider_opens_on_pictures_that_differ() {
    let folder = Scratch::new("report-slider");
    let mut records = records();
    let drawers = ["exact", "raycast+mask", "grid:256+vds:1024", "grid:64+mask"];
    records[0].pictures = drawers
        .map(|drawer| RecordedPicture {
            drawer: drawer.to_owned(),
            file: "exact.png".to_owned(),
            heatmap: None,
        })
        .into();
    let page = report_of(&folder, &records[..1]).html;
    assert!(page.contains("data-left=\"0\" data-right=\"3\""), "{page}");
}

#[test]
fn answers_come_before_the_machine_and_the_words() {
    let folder = Scratch::new("report-sections");
    let page = report_of(&folder, &records()).markdown;
    let place = |heading: &str| page.find(heading).unwrap();
    let answers = place("\n## What should I use?");
    assert!(
        place("expectations were reached") < answers,
        "what concerns all"
    );
    for later in ["\n## What the words mean", "\n## What was run"] {
        assert!(answers < place(later), "{later}");
    }
}

#[test]
fn what_the_spread_covers_stands_beside_it() {
    let folder = Scratch::new("report-spread");
    let page = report_of(&folder, &records()).markdown;
    for said in [
        "3 rounds by timestamps of the device, over which ± is the spread (another run may differ by more)",
        "frame, × draw only ± of the rounds",
        "| what ± does not cover | how another run differs",
    ] {
        assert!(page.contains(said), "{said} is missing from\n{page}");
    }
}

#[test]
fn a_chart_says_which_points_it_shows() {
    let folder = Scratch::new("report-captions");
    let page = report_of(&folder, &records()).html;
    for (title, shown) in [
        ("Error against time (crank: size = 2%)", "size = 2%"),
        ("Error against time (crank: size = 10%)", "size = 10%"),
        ("By size", "size = 2%, 10%"),
    ] {
        let chart = page.split("<figure class=\"chart\">");
        let chart = chart.into_iter().find(|c| c.contains(title)).unwrap();
        let said = format!("Shown: run <code>crank</code>; {shown}.</p>");
        assert!(chart.contains(&said), "{said} is missing from {chart}");
    }
}

#[test]
fn nothing_recorded_is_markup_or_a_formula() {
    let folder = Scratch::new("report-inert");
    let mut records = records();
    records[0].measurement.scene = "=1+1".to_owned();
    records[0].measurement.strategies[3].reason = Some("-1 < <b>2</b> & \\*".to_owned());
    let pages = report_of(&folder, &records);
    assert!(pages.csv.contains(",'=1+1,"), "{}", pages.csv);
    assert!(
        pages.csv.contains(",'-1 < <b>2</b> & \\*,"),
        "{}",
        pages.csv
    );
    let said = "-1 &lt; &lt;b>2&lt;/b> &amp; \\\\\\*";
    assert!(pages.markdown.contains(said), "{}", pages.markdown);
    for tag in ["<script>", "<b>", "<it>"] {
        assert!(
            !pages.markdown.contains(tag),
            "{tag} is in\n{}",
            pages.markdown
        );
    }
    assert!(
        pages.markdown.contains("&lt;script>alert(2)"),
        "the analysis"
    );
}

#[test]
fn a_report_inside_a_run_does_not_disturb_the_next() {
    let folder = Scratch::new("report-inside");
    write(&folder.path("run"), &records(), None);
    fs::create_dir_all(folder.path("run/page")).unwrap();
    folder.run("report run --out run/page").exits(0);
    folder.run("report run --out run/page").exits(0);
}
