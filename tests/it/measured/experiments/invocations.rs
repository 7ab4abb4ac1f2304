//! `cutaway measure` as a user runs it, on pictures of 32 x 24 pixels.

use std::fs;

use cutaway_io::document::Document;
use serde_json::Value;

use super::command::{Ran, Scratch};

const CUBE: &str = r#"
question = "What does a cube cost?"
analysis = "Little."
[[run]]
name = "cube"
resolution = [32, 24]
strategies = ["raycast+mask", "grid:8+vds:64"]
rounds = 2
sweep.amplitude = { path = "cut.front.surfaces.0.amplitude", values = ["2%", "5%"] }
[run.scene]
part = [{ shape = "cube" }]
relief.waves = { kind = "waves" }
cut = [{ name = "front", surfaces = [{ section = "-z=50%", relief = "waves" }] }]
[run.quick]
rounds = 1
sweep = { amplitude = ["5%"] }
[[run.expect]]
strategies = ["raycast+mask"]
decided_wrong_px = 0
"#;

fn json(folder: &Scratch, name: &str) -> Value {
    serde_json::from_slice(&fs::read(folder.path(name)).unwrap()).unwrap()
}

/// How many were measured and how many kept.
#[track_caller]
fn counts(ran: &Ran) -> [usize; 2] {
    let line = ran.text().lines().next().unwrap();
    let words: Vec<&str> = line.split([' ', ',', ';']).collect();
    let before = |what| {
        let at = words
            .iter()
            .position(|w| *w == what)
            .unwrap_or_else(|| panic!("{line}"));
        words[at - 1].parse().unwrap()
    };
    [before("measured"), before("kept")]
}

#[test]
fn records_are_left_kept_and_measured_again() {
    let folder = Scratch::new("measure");
    folder.write("01-cube.toml", CUBE);
    let measure = |more: &str| folder.run(&format!("measure 01-cube.toml --out out {more}"));
    let ran = measure("").exits(0);
    assert_eq!(counts(&ran), [2, 0]);
    assert!(
        ran.text().contains("2 of 2 expectations reached"),
        "{}",
        ran.text()
    );
    let record = json(&folder, "out/01-cube/cube.2_.json");
    assert_eq!(record["parameters"]["amplitude"], "2%");
    let scene = Document::parse("scene.toml", record["scene"].as_str().unwrap()).unwrap();
    let expected = "part = [{ shape = \"cube\" }]\nrelief.waves = { kind = \"waves\" }\nresolution = [32, 24]\n\
        cut = [{ name = \"front\", surfaces = [{ section = \"-z=50%\", relief = \"waves\", amplitude = \"2%\" }] }]";
    assert_eq!(scene, Document::parse("scene.toml", expected).unwrap());
    assert_eq!(record["truth"], Value::Null);
    assert_eq!(
        record["makers"][1],
        serde_json::json!([{ "family": "grid:8+vds:64", "parameters": {} }])
    );
    assert_eq!(
        record["measurement"]["resolution"],
        serde_json::json!([32, 24])
    );
    assert_eq!(
        json(&folder, "out/01-cube/experiment.json")["name"],
        "01-cube"
    );
    assert_eq!(json(&folder, "out/run.json")["is_quick"], false);
    for picture in record["pictures"].as_array().unwrap() {
        let file = picture["file"].as_str().unwrap();
        assert!(
            folder.path(&format!("out/01-cube/{file}")).is_file(),
            "{file}"
        );
    }

    // The command of a record repeats it.
    let command = record["measurement"]["command"].as_str().unwrap();
    folder
        .run(command.strip_prefix("cutaway ").unwrap())
        .exits(0);
    let again = json(&folder, "target/again/01-cube/cube.2_.json");
    for i in 0..2 {
        for field in ["name", "decided_wrong_px", "crack_px", "depth_error_max"] {
            let of = |r: &Value| r["measurement"]["strategies"][i][field].clone();
            let [a, b] = [&record, &again].map(of);
            assert_eq!(a, b, "{field}");
        }
    }

    assert_eq!(counts(&measure("").exits(0)), [0, 2], "nothing has changed");
    assert_eq!(
        counts(&measure("--rounds 1").exits(0)),
        [2, 0],
        "other rounds"
    );
    assert_eq!(counts(&measure("--force").exits(0)), [2, 0], "all again");
    fs::remove_file(folder.path("out/01-cube/cube.5_.json")).unwrap();
    assert_eq!(counts(&measure("").exits(0)), [1, 1], "one is missing");
    folder.write(
        "01-cube.toml",
        CUBE.replace("[\"2%\", \"5%\"]", "[\"2%\", \"10%\"]"),
    );
    let ran = measure("").exits(0);
    assert_eq!(counts(&ran), [1, 1], "one is another");
    let left = "1 record of a point that it no longer has is left";
    assert!(ran.stderr.contains(left), "{}", ran.stderr);
    let others = ["cube.5_.json", "mine.json"].map(|f| folder.path(&format!("out/01-cube/{f}")));
    fs::write(&others[1], "{}").unwrap();
    assert!(others[0].exists(), "what was measured is not thrown away");
    assert_eq!(
        json(&folder, "out/01-cube/experiment.json")["points"],
        serde_json::json!(["cube.2_", "cube.10_"]),
        "in the order of the experiment"
    );
    let ran = measure("--prune").exits(0);
    assert_eq!(counts(&ran), [0, 2]);
    assert!(
        ran.stderr.contains("removed 1 record of a point"),
        "{}",
        ran.stderr
    );
    assert_eq!(
        others.map(|o| o.exists()),
        [false, true],
        "only what nobody asks for, and no file of others"
    );
    let of_run = folder.path("out/run.json");
    let whole = fs::read(&of_run).unwrap();
    fs::write(&of_run, "{").unwrap();
    let ran = measure("").exits(2);
    assert!(
        ran.stderr
            .contains("help: remove the file and measure again"),
        "{}",
        ran.stderr
    );
    fs::write(&of_run, whole).unwrap();
    let ran = measure("--quick").exits(2);
    assert!(
        ran.stderr.contains("--force"),
        "full and quick do not mix: {}",
        ran.stderr
    );
}

#[test]
fn another_expectation_is_held_against_what_was_measured() {
    let folder = Scratch::new("judged");
    let measure = |expected: &str, code| {
        let text = CUBE.replace("decided_wrong_px = 0", expected);
        folder.write("01-cube.toml", &text);
        folder.run("measure 01-cube.toml --out out").exits(code)
    };
    let record = || json(&folder, "out/01-cube/cube.2_.json");
    assert_eq!(counts(&measure("decided_wrong_px = 0", 0)), [2, 0]);
    let first = record();
    let invocation = &first["sitting"];
    assert!(
        invocation["began"].as_str().unwrap().ends_with('Z'),
        "{invocation}"
    );
    assert!(
        invocation["command"]
            .as_str()
            .unwrap()
            .contains("--out out"),
        "{invocation}"
    );
    let ran = measure("decided_wrong_px = 3", 1);
    assert_eq!(counts(&ran), [0, 2]);
    assert!(ran.text().contains("0 of 2 expectations"), "{}", ran.text());
    let second = record();
    assert_eq!(second["expectations"][0]["holds"], false);
    assert_eq!(
        second["measurement"], first["measurement"],
        "to the last bit"
    );
    assert_eq!(second["sitting"], first["sitting"]);
    measure("decided_wrong_px = 0", 0);
    assert_eq!(record(), first, "and back");
}

#[test]
fn a_model_that_changed_is_measured_again() {
    let folder = Scratch::new("changed");
    let (before, rest) = CUBE.split_once("[run.scene]\n").unwrap();
    let (scene, after) = rest.split_once("[run.quick]").unwrap();
    let before = before.replace("rounds = 2", "rounds = 2\nscene = \"cube.toml\"");
    folder.write("01-cube.toml", format!("{before}[run.quick]{after}"));
    folder.write("cube.toml", scene);
    let measure = || folder.run("measure 01-cube.toml --out out").exits(0);
    assert_eq!(counts(&measure()), [2, 0]);
    assert_eq!(counts(&measure()), [0, 2], "the control");
    folder.write(
        "cube.toml",
        scene.replace("shape = \"cube\"", "shape = \"sphere\""),
    );
    assert_eq!(counts(&measure()), [2, 0]);
}

#[test]
fn two_runs_agree_in_every_error() {
    let folder = Scratch::new("twice");
    folder.write("01-cube.toml", CUBE);
    let errors = |out: &str| {
        folder
            .run(&format!("measure 01-cube.toml --out {out}"))
            .exits(0);
        let mut record = json(&folder, &format!("{out}/01-cube/cube.2_.json"));
        for strategy in record["measurement"]["strategies"].as_array_mut().unwrap() {
            let strategy = strategy.as_object_mut().unwrap();
            for of_time in [
                "time_ms",
                "frame_over_draw_only",
                "frame_over_draw_only_mad",
                "cut",
                "passes",
            ] {
                assert!(strategy.remove(of_time).is_some(), "{of_time}");
            }
        }
        record["measurement"]["strategies"].clone()
    };
    let first = errors("a");
    assert!(
        first[1]["decided_wrong_px"].as_u64().unwrap() > 0,
        "there are errors: {first}"
    );
    assert_eq!(first, errors("b"));
}

#[test]
fn an_expectation_that_fails_is_told_first_and_is_the_exit_code() {
    let folder = Scratch::new("fails");
    folder.write(
        "01-cube.toml",
        CUBE.replace("decided_wrong_px = 0", "decided_wrong_px = 3"),
    );
    for times in ["measured", "kept"] {
        let ran = folder
            .run("measure 01-cube.toml --quick --out out --verbose")
            .exits(1);
        let at = |what: &str| {
            ran.stderr
                .find(what)
                .unwrap_or_else(|| panic!("{what}: {}", ran.stderr))
        };
        let failed = at(
            "failed: 01-cube, cube, amplitude = 5%: raycast+mask: expected decided_wrong_px 3, found decided_wrong_px 0",
        );
        if times == "measured" {
            assert!(failed < at("warm-up"), "{}", ran.stderr);
        }
        assert!(ran.text().contains("0 of 1 expectations"), "{}", ran.text());
        assert!(
            folder.path("out/01-cube/cube.json").exists()
                || folder.path("out/01-cube/cube.5_.json").exists()
        );
    }
}

#[test]
fn a_dry_run_lists_what_would_be_measured_and_leaves_nothing() {
    let folder = Scratch::new("dry");
    folder.write("01-cube.toml", CUBE);
    let ran = folder
        .run("measure 01-cube.toml --dry-run --out out")
        .exits(0);
    for phrase in [
        "amplitude = 2%",
        "amplitude = 5%",
        "grid:8+vds:64",
        "cutaway measure 01-cube.toml --only=cube:2_",
    ] {
        assert!(ran.text().contains(phrase), "{}", ran.text());
    }
    assert_eq!(folder.files(), ["01-cube.toml"]);
}

#[test]
fn bad_input_is_refused_before_anything_is_measured() {
    let folder = Scratch::new("refused");
    folder.write("01-cube.toml", CUBE);
    let lost = CUBE.replace("shape = \"cube\"", "mesh = \"nowhere.stl\"");
    folder.write("02-lost.toml", lost);
    folder.write("03-spong.toml", CUBE.replace("\"cube\" }]", "\"spong\" }]"));
    let lost = "question = \"Is it lost?\"\nanalysis = \"It is.\"\n\n[[run]]\nname = \"lost\"\ncases = [\"1\", \"99\"]\n";
    folder.write("04-cases.toml", lost);
    folder.write("file", "");
    fs::create_dir_all(folder.path("other")).unwrap();
    fs::copy(
        folder.path("01-cube.toml"),
        folder.path("other/01-cube.toml"),
    )
    .unwrap();
    for (line, phrase) in [
        ("measure nowhere.toml", "nowhere.toml"),
        ("measure 03-spong.toml --dry-run", "did you mean `sponge`"),
        ("measure 01-cube.toml --only cub", "did you mean `cube`"),
        ("measure 01-cube.toml --out file", "not a folder"),
        (
            "measure 01-cube.toml 02-lost.toml --out out",
            "`part.0.mesh`: there is no file nowhere.stl",
        ),
        (
            "measure 01-cube.toml 04-cases.toml --out out",
            "04-cases.toml: run `lost`: hard case `99`",
        ),
        (
            "measure 01-cube.toml other/01-cube.toml --out out",
            "another experiment is called",
        ),
        (
            "measure 01-cube.toml --adapter nobody --out out",
            "--adapter nobody",
        ),
    ] {
        let ran = folder.run(line).exits(2);
        assert!(ran.stderr.contains(phrase), "{line}: {}", ran.stderr);
        assert!(!folder.path("out").exists(), "{line}");
    }
}

#[test]
fn what_is_said_of_a_scene_stands_in_its_record_and_is_said_once_with_its_place() {
    let folder = Scratch::new("remarks");
    let text = CUBE.replace("-z=50%", "z=900");
    let text = text.replace("rounds = 2", "rounds = 2\ntruth = { \"camera.zoom\" = 1 }");
    folder.write("01-cube.toml", &text);
    let ran = folder
        .run("measure 01-cube.toml --quick --out out")
        .exits(0);
    let said = "warning: 01-cube, cube, amplitude = 5%: section";
    assert_eq!(ran.stderr.matches(said).count(), 1, "{}", ran.stderr);
    assert_eq!(
        ran.stderr.matches("misses the model").count(),
        1,
        "{}",
        ran.stderr
    );
    let record = json(&folder, "out/01-cube/cube.5_.json");
    let warnings = record["warnings"].as_array().unwrap();
    let opening = warnings.iter().find(|w| w["kind"] == "opening").unwrap();
    assert!(
        opening["text"]
            .as_str()
            .unwrap()
            .contains("misses the model"),
        "{opening}"
    );
    assert!(
        opening["help"].as_str().unwrap().contains("percentage"),
        "{opening}"
    );
    folder.write("01-cube.toml", CUBE);
    let ran = folder
        .run("measure 01-cube.toml --quick --out out")
        .exits(0);
    assert!(
        !ran.stderr.contains("warning"),
        "the control: {}",
        ran.stderr
    );
    assert!(
        ran.stderr.contains("01-cube, cube: 1 of 1 points, "),
        "{}",
        ran.stderr
    );
    let ran = folder
        .run("measure 01-cube.toml --quick --force --quiet --out out")
        .exits(0);
    assert_eq!(ran.stderr, "");
    let quick = "[run.quick]\nrounds = 1\nsweep = { amplitude = [\"5%\"] }\n";
    for (text, is_said) in [(CUBE.to_owned(), false), (CUBE.replace(quick, ""), true)] {
        folder.write("01-cube.toml", &text);
        let line = "measure 01-cube.toml --quick --rounds 1 --only cube:5_ --out quick";
        let ran = folder.run(line).exits(0);
        let said = ran.stderr.contains("01-cube: --quick changes nothing");
        assert_eq!(said, is_said, "{}", ran.stderr);
    }
}

#[test]
fn a_point_is_asked_for_by_the_name_of_its_files() {
    let folder = Scratch::new("only");
    folder.write(
        "01-cube.toml",
        CUBE.replace(
            "rounds = 2",
            "rounds = 2\ndrift = { frames = 2, px = 0.5 }\npictures = \"last\"",
        ),
    );
    let ran = folder.run("measure 01-cube.toml --dry-run").exits(0);
    assert!(ran.text().contains("--only=cube:2_ "), "{}", ran.text());
    let measured = |only: &str| {
        let ran = folder.run(&format!("measure 01-cube.toml --out out --only={only}"));
        let [measured, kept] = counts(&ran.exits(0));
        measured + kept
    };
    assert_eq!(measured("cube:5_"), 1);
    let pictures = |stem: &str| {
        let record = json(&folder, &format!("out/01-cube/{stem}.json"));
        record["pictures"].as_array().unwrap().len()
    };
    assert!(!folder.path("out/01-cube/cube.2_.json").exists());
    assert_eq!(measured("c*:*_"), 2);
    assert_eq!(
        [pictures("cube.2_"), pictures("cube.5_")],
        [0, 3],
        "of the last alone"
    );
    for (only, phrase) in [
        ("cube:7_", "no point of the run"),
        ("cubs:5_", "did you mean `cube`"),
    ] {
        let ran = folder
            .run(&format!("measure 01-cube.toml --only={only}"))
            .exits(2);
        assert!(ran.stderr.contains(phrase), "{}", ran.stderr);
    }
}

#[cfg(unix)]
#[test]
fn an_interrupt_says_what_is_lost() {
    use std::io::{BufRead, BufReader};
    use std::process::{Command, Stdio};

    let folder = Scratch::new("lost");
    folder.write("01-cube.toml", CUBE);
    let line = "measure 01-cube.toml --out out --rounds 10000 --only cube:2_ --verbose";
    let mut child = (folder.command(line))
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut lines = BufReader::new(child.stderr.take().unwrap()).lines();
    assert!(
        lines.any(|l| l.unwrap().ends_with("round 3 of 10000")),
        "it got there"
    );
    let pid = child.id().to_string();
    let killed = Command::new("kill").args(["-INT", &pid]).status();
    assert!(killed.unwrap().success());
    lines.for_each(|l| drop(l.unwrap()));
    let ran = Ran::of(line, child.wait_with_output().unwrap()).exits(130);
    let lost =
        (ran.text().lines()).find_map(|l| l.strip_prefix("lost: 01-cube, cube, amplitude = 2%: "));
    let rounds = lost.and_then(|l| l.strip_suffix(" of 10000 rounds are lost"));
    let rounds: u32 = rounds
        .unwrap_or_else(|| panic!("{}", ran.text()))
        .parse()
        .unwrap();
    assert!((2..10000).contains(&rounds), "{rounds}");
}

#[cfg(unix)]
#[test]
fn an_interrupted_run_keeps_what_is_complete_and_goes_on() {
    use std::process::{Command, Stdio};
    use std::time::Duration;

    let folder = Scratch::new("interrupted");
    let many: Vec<String> = (1..=40).map(|i| format!("\"{i}%\"")).collect();
    folder.write(
        "01-cube.toml",
        CUBE.replace("[\"2%\", \"5%\"]", &format!("[{}]", many.join(", "))),
    );
    let line = "measure 01-cube.toml --out out --rounds 1";
    let mut child = folder
        .command(line)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    while !folder.path("out/01-cube/cube.1_.json").exists() {
        assert!(child.try_wait().unwrap().is_none(), "it ended by itself");
        std::thread::sleep(Duration::from_millis(5));
    }
    let pid = child.id().to_string();
    assert!(
        Command::new("kill")
            .args(["-INT", &pid])
            .status()
            .unwrap()
            .success()
    );
    let ran = Ran::of(line, child.wait_with_output().unwrap()).exits(130);
    assert!(
        ran.text().contains("go on with\n  cutaway measure"),
        "{}",
        ran.text()
    );
    let [complete, _] = counts(&ran);
    assert!((1..40).contains(&complete), "{complete}");
    let ran = folder.run(line).exits(0);
    assert_eq!(counts(&ran), [40 - complete, complete]);
}
