//! Promise: work that is done in shares, at once and into one folder, is the work done in one go but for times. A share that is missing is named,
//! and done again alone. Devices that are not alike are kept apart.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::fs;
use std::process::Stdio;

use serde_json::Value;

use crate::common::command::Scratch;

const CUBES: &str = r#"
question = "What does a cube cost?"
analysis = "Little."
[[run]]
name = "cube"
resolution = [32, 24]
strategies = ["raycast+mask", "grid:8+vds:64"]
rounds = 1
sweep.amplitude = { path = "cut.front.surfaces.0.amplitude", values = ["1%", "2%", "3%", "4%", "5%"] }
[run.scene]
part = [{ shape = "cube" }]
relief.waves = { kind = "waves" }
cut = [{ name = "front", surfaces = [{ section = "-z=50%", relief = "waves" }] }]
"#;

const STEMS: [&str; 5] = ["cube.1_", "cube.2_", "cube.3_", "cube.4_", "cube.5_"];

fn json(folder: &Scratch, name: &str) -> Value {
    let bytes = fs::read(folder.path(name)).unwrap_or_else(|e| panic!("{name}: {e}"));
    serde_json::from_slice(&bytes).unwrap()
}

/// Runs some lines at once.
fn at_once(folder: &Scratch, lines: &[String]) {
    let started: Vec<_> = (lines.iter())
        .map(|line| {
            let mut command = folder.command(line);
            command.stdout(Stdio::null()).stderr(Stdio::piped());
            command.spawn().unwrap()
        })
        .collect();
    for (line, child) in lines.iter().zip(started) {
        let ended = child.wait_with_output().unwrap();
        let said = String::from_utf8_lossy(&ended.stderr);
        assert!(ended.status.success(), "{line}: {said}");
    }
}

/// A record without what differs from one run to the next.
fn timeless(mut record: Value) -> Value {
    for name in ["sitting", "warnings"] {
        record.as_object_mut().unwrap().remove(name);
    }
    let strategies = record["measurement"]["strategies"].as_array().unwrap();
    let errors = strategies.iter().map(|s| {
        let of = |name: &str| s[name].clone();
        Value::Array(
            [
                "name",
                "outcome",
                "decided_wrong_px",
                "crack_px",
                "depth_error_max",
                "normal_error_deg_max",
            ]
            .map(of)
            .to_vec(),
        )
    });
    record["measurement"] = Value::Array(errors.collect());
    record
}

#[test]
fn shares_of_an_experiment_are_the_whole_of_it() {
    let folder = Scratch::new("shards");
    folder.write("cubes.toml", CUBES);
    let shares = |text: &str, count: usize| -> Vec<String> {
        (0..count)
            .map(|i| format!("{text} --shard {i}/{count}"))
            .collect()
    };
    at_once(&folder, &shares("measure cubes.toml --out many", 3));
    folder.run("measure cubes.toml --out one").exits(0);
    for stem in STEMS {
        let [many, one] =
            ["many", "one"].map(|out| json(&folder, &format!("{out}/cubes/{stem}.json")));
        assert!(
            many["sitting"]["shard"].as_str().unwrap().ends_with("/3"),
            "{stem}"
        );
        assert!(many["sitting"]["node"].is_string() && one["sitting"]["node"].is_null());
        assert_eq!(timeless(many), timeless(one), "{stem}");
    }
    folder.run("report many --complete").exits(0);
    let page = fs::read_to_string(folder.path("many/report.md")).unwrap();
    assert!(page.contains("1 experiment with 5 points"), "{page}");

    // Who is missing is named, and comes again from the share that it is of alone.
    let lost = json(&folder, "many/cubes/cube.4_.json")["sitting"]["shard"].clone();
    fs::remove_file(folder.path("many/cubes/cube.4_.json")).unwrap();
    let ran = folder.run("report many --complete").exits(1);
    assert!(
        ran.stderr.contains("4 of 5 points; missing: cubes/cube.4_"),
        "{}",
        ran.stderr
    );
    folder.run("report many").exits(0);
    for (line, share) in shares("measure cubes.toml --out many", 3).iter().zip(0..3) {
        let text = folder.run(line).exits(0).text().to_owned();
        let expected = if lost == format!("{share}/3") {
            "1 measured"
        } else {
            "0 measured"
        };
        assert!(text.contains(expected), "{line}: {text}");
    }
    folder.run("report many --complete").exits(0);

    // A share on another device.
    let other = "run.1-of-3.json";
    let elsewhere = |name: &str, at: &[&str]| {
        let mut value = json(&folder, name);
        let adapter = at.iter().fold(&mut value, |v, key| &mut v[*key]);
        adapter["name"] = Value::from("another card");
        folder.write(name, value.to_string());
    };
    elsewhere(&format!("many/{other}"), &["adapter"]);
    let mut moved = 0;
    for stem in STEMS {
        let name = format!("many/cubes/{stem}.json");
        if json(&folder, &name)["sitting"]["shard"] == "1/3" {
            elsewhere(&name, &["sitting", "adapter"]);
            moved += 1;
        }
    }
    folder.run("report many").exits(0);
    let report = json(&folder, "many/report.json");
    let runs = report["folders"].as_array().unwrap();
    let points = |run: &Value| run["experiments"][0]["records"].as_array().unwrap().len();
    assert_eq!(
        runs.iter().map(points).collect::<Vec<_>>(),
        [5 - moved, moved],
        "{moved}"
    );
    assert!(moved > 0 && runs[1]["run"]["adapter"]["name"] == "another card");
    folder
        .run("measure cubes.toml --out many --shard 1/3")
        .must_refuse(&["another card", "help:"]);
    // Neither are quick figures put beside others, nor a whole run beside shares of another device, nor figures of two programs.
    folder
        .run("measure cubes.toml --out many --shard 0/3 --quick --force")
        .must_refuse(&["quick", "help:"]);
    folder
        .run("measure cubes.toml --out many")
        .must_refuse(&["another card", "help:"]);
    let mut run = json(&folder, "many/run.2-of-3.json");
    run["commit"] = Value::from("0123456");
    folder.write("many/run.2-of-3.json", run.to_string());
    folder.run("report many").exits(0);
    let report = json(&folder, "many/report.json");
    assert_eq!(report["folders"].as_array().unwrap().len(), 3);
    // A point of a run that is not there any more is put to none of those that are.
    let name = "many/cubes/cube.1_.json";
    let mut point = json(&folder, name);
    point["sitting"]["commit"] = Value::from("fedcba9");
    folder.write(name, point.to_string());
    let ran = folder.run("report many --complete").exits(1);
    assert!(ran.stderr.contains("cubes/cube.1_"), "{}", ran.stderr);
}

#[test]
fn shares_of_an_animation_are_the_frames_of_it() {
    let folder = Scratch::new("shards-frames");
    let scene = "shape:cube --section z=50% --turntable --frames 7 --fps 10 --resolution 48,36 --supersample 1";
    let shares: Vec<String> = (0..3)
        .map(|i| format!("animate {scene} -o many/%02d.png --shard {i}/3"))
        .collect();
    at_once(&folder, &shares);
    folder
        .run(&format!("animate {scene} -o one/%02d.png"))
        .exits(0);
    for frame in 1..=7 {
        let [many, one] = ["many", "one"]
            .map(|out| fs::read(folder.path(&format!("{out}/{frame:02}.png"))).unwrap());
        assert_eq!(many, one, "frame {frame}");
    }
    // What is whole is not drawn again, whoever drew it.
    fs::remove_file(folder.path("many/05.png")).unwrap();
    let ran = folder
        .run(&format!("animate {scene} -o many/%02d.png --json -"))
        .exits(0);
    let frames = ran.json()["frames"].as_array().unwrap().clone();
    let drawn: Vec<usize> = (0..7).filter(|i| frames[*i]["kept"] == false).collect();
    assert_eq!(drawn, [4]);

    folder.run(&format!("animate {scene} -o once.gif")).exits(0);
    folder
        .run("encode many/%02d.png -o encoded.gif --fps 10")
        .exits(0);
    let [once, encoded] =
        ["once.gif", "encoded.gif"].map(|name| fs::read(folder.path(name)).unwrap());
    assert!(
        once == encoded,
        "the colours of all frames are those of one go"
    );

    fs::remove_file(folder.path("many/05.png")).unwrap();
    folder
        .run("encode many/%02d.png -o gap.gif")
        .must_refuse(&["many/05.png", "help:"]);
    fs::copy(folder.path("many/01.png"), folder.path("many/05.png")).unwrap();
    folder
        .run("encode many/%02d.png -o twice.gif")
        .must_refuse(&["05.png", "frame 1 of 7", "help:"]);
    fs::copy(folder.path("one/05.png"), folder.path("many/05.png")).unwrap();
    // The last share is missing: nothing stands behind the gap.
    for name in ["06", "07"] {
        fs::rename(
            folder.path(&format!("many/{name}.png")),
            folder.path(&format!("{name}.png")),
        )
        .unwrap();
    }
    folder
        .run("encode many/%02d.png -o short.gif")
        .must_refuse(&["2 of 7 pictures are missing", "many/06.png", "help:"]);
    for name in ["06", "07"] {
        fs::rename(
            folder.path(&format!("{name}.png")),
            folder.path(&format!("many/{name}.png")),
        )
        .unwrap();
    }
    // One of another animation.
    folder
        .run(&format!("animate {scene} --flip -o other/%02d.png"))
        .exits(0);
    fs::copy(folder.path("other/03.png"), folder.path("many/03.png")).unwrap();
    folder
        .run("encode many/%02d.png -o mixed.gif")
        .must_refuse(&["03.png", "another command", "help:"]);
    fs::copy(folder.path("one/03.png"), folder.path("many/03.png")).unwrap();
    fs::write(folder.path("many/06.png"), &once[..40]).unwrap();
    folder
        .run("encode many/%02d.png -o bad.gif")
        .must_refuse(&["06.png", "help:"]);
    for (line, said) in [
        ("encode many/%02d.png -o again/%02d.png", "numbered already"),
        ("encode none/%02d.png -o a.gif", "none/"),
        ("encode many/01.png -o a.gif", "no frame-number format"),
        (
            "animate shape:cube --turntable -o a.gif --shard 0/2",
            "encode",
        ),
    ] {
        folder.run(line).must_refuse(&[said, "help:"]);
    }
    assert_eq!(
        folder.files(),
        ["encoded.gif", "many", "once.gif", "one", "other"]
    );
}
