//! `cutaway measure` as a user runs it, on pictures of 32 x 24 pixels.

use std::fs;

use serde_json::Value;

use super::command::{Ran, Scratch};

const CUBE: &str = r#"
question = "What does a cube cost?"
analysis = "Little."
[[run]]
name = "cube"
scene = ["shape:cube", "--section=-z=50%", "--relief=waves:amplitude={amplitude}"]
resolution = "32,24"
strategies = ["raycast+mask", "grid:8+vds:64"]
rounds = 2
sweep = { amplitude = ["2%", "5%"] }
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
    let again = folder.run(&format!(
        "{} --json -",
        command.strip_prefix("cutaway ").unwrap()
    ));
    let again = again.exits(0).json();
    for i in 0..2 {
        for field in ["name", "decided_wrong_px", "crack_px", "depth_error_max"] {
            let [a, b] = [&record["measurement"], &again].map(|m| &m["strategies"][i][field]);
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
        &CUBE.replace("[\"2%\", \"5%\"]", "[\"2%\", \"6%\"]"),
    );
    let ran = measure("").exits(0);
    assert_eq!(counts(&ran), [1, 1], "one is another");
    assert!(ran.stderr.contains("removed 1 records"), "{}", ran.stderr);
    assert!(
        !folder.path("out/01-cube/cube.5_.json").exists(),
        "nobody asks for it"
    );
    let ran = measure("--quick").exits(2);
    assert!(
        ran.stderr.contains("--force"),
        "full and quick do not mix: {}",
        ran.stderr
    );
}

#[test]
fn a_model_that_changed_is_measured_again() {
    let folder = Scratch::new("changed");
    let text = CUBE.replace("shape:cube", "cube.toml");
    folder.write("01-cube.toml", &text);
    let scene = "[[part]]\nname = \"cube\"\nshape = \"cube\"\n";
    folder.write("cube.toml", scene);
    let measure = || folder.run("measure 01-cube.toml --out out").exits(0);
    assert_eq!(counts(&measure()), [2, 0]);
    assert_eq!(counts(&measure()), [0, 2], "the control");
    folder.write(
        "cube.toml",
        &scene.replace("shape = \"cube\"", "shape = \"sphere\""),
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
        &CUBE.replace("decided_wrong_px = 0", "decided_wrong_px = 3"),
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
    for told in [
        "amplitude = 2%",
        "amplitude = 5%",
        "grid:8+vds:64",
        "cutaway compare shape:cube",
    ] {
        assert!(ran.text().contains(told), "{}", ran.text());
    }
    assert_eq!(folder.files(), ["01-cube.toml"]);
}

#[test]
fn bad_input_is_refused_before_anything_is_measured() {
    let folder = Scratch::new("refused");
    folder.write("01-cube.toml", CUBE);
    folder.write("02-lost.toml", &CUBE.replace("shape:cube", "nowhere.stl"));
    let lost = "question = \"?\"\n\n[[run]]\nname = \"lost\"\ncases = [\"1\", \"99\"]\n";
    folder.write("03-cases.toml", lost);
    folder.write("file", "");
    fs::create_dir_all(folder.path("other")).unwrap();
    fs::copy(
        folder.path("01-cube.toml"),
        folder.path("other/01-cube.toml"),
    )
    .unwrap();
    for (line, told) in [
        ("measure nowhere.toml", "nowhere.toml"),
        ("measure 01-cube.toml --only cub", "did you mean `cube`"),
        ("measure 01-cube.toml --out file", "not a folder"),
        (
            "measure 01-cube.toml 02-lost.toml --out out",
            "02-lost.toml: run `cube`: nowhere.stl",
        ),
        (
            "measure 01-cube.toml 03-cases.toml --out out",
            "03-cases.toml: run `lost`: hard case `99`",
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
        assert!(ran.stderr.contains(told), "{line}: {}", ran.stderr);
        assert!(!folder.path("out").exists(), "{line}");
    }
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
        &CUBE.replace("[\"2%\", \"5%\"]", &format!("[{}]", many.join(", "))),
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
