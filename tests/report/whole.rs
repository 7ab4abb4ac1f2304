//! What a folder lacks, what else lies in it, and what belongs to which folder and point.

use std::fs;
use std::path::Path;

use cutaway::experiment::Warning;
use cutaway::report::PictureOptions;

use super::command::Scratch;
use super::fixture::{NAME, records, write};
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
    for (file, told) in [
        ("crank.2", "1 of 2 points of 01-fixture is missing in "),
        ("crank.10", "2 of 2 points of 01-fixture are missing in "),
    ] {
        fs::remove_file(folder.path(&format!("run/{NAME}/{file}.json"))).unwrap();
        let page = report(&[&folder.path("run")], PictureOptions::MOST_BYTES).markdown;
        assert_eq!(page.matches(told).count(), 2, "{page}");
        assert!(page.contains(file), "{page}");
        assert!(!page.contains("Nothing was expected"), "{page}");
    }
}

#[test]
fn areas_that_disagree_count_as_missed() {
    let folder = Scratch::new("report-peers");
    write(&folder.path("run"), &records(), None);
    let file = folder.path("run/peers/planar.json");
    for (holds, told) in [
        (true, "All 3 expectations were reached"),
        (false, "1 of 3 expectations were missed"),
    ] {
        edit(&file, |v| {
            v["checks"] = serde_json::json!([{ "mesh": "torus", "cut": "x", "tool": "vtk", "off": 0.5, "bound": 0.1,
                "bound_is": "1e-6 of the area", "holds": holds }]);
        });
        let page = report(&[&folder.path("run")], PictureOptions::MOST_BYTES).markdown;
        assert!(page.contains(told), "{page}");
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
        "words",
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
    assert!(!plain.markdown.contains("Judged by"), "the control");
    let mut records = records();
    for record in &mut records {
        record.words = ["shape:crank", "--section=x=1"].map(str::to_owned).into();
        record.truth = Some(vec!["shape:whole".to_owned()]);
        record.warnings.push(Warning::Opening {
            text: "the section misses the model".to_owned(),
            mend: "move it".to_owned(),
        });
    }
    let pages = report_of(&folder, &records);
    for page in [&pages.html, &pages.markdown] {
        for (said, count) in [
            ("shape:crank --section=x=1", 2),
            ("shape:whole", 2),
            ("the section misses the model", 3),
        ] {
            assert_eq!(page.matches(said).count(), count, "{said} in\n{page}");
        }
    }
    assert!(
        pages
            .csv
            .contains(",shape:crank --section=x=1,shape:whole,")
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
