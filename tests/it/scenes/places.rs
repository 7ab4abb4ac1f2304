//! Promise: no output ever replaces an input, and no two outputs are one file, by whichever names: refused before anything is drawn.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common::command;

use std::fs;
use std::path::Path;

use command::Scratch;

const OBJ: &str = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl m\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";

const SCENE: &str = r#"
[[part]]
name = "solid"
mesh = "a.obj"

[relief.rock]
kind = "image"
image = "r.png"

[[cut]]
surfaces = [{ section = "z=50%", relief = "rock" }]

[[cut]]
volume = "cutter.obj"
scale = 0.1
"#;

const GLTF: &str = r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,1]},
{"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":24}],
"buffers":[{"byteLength":72,"uri":"g.bin"}]}"#;

/// A folder with an input of each kind.
fn inputs(name: &str) -> Scratch {
    let folder = Scratch::new(name);
    folder.write("a.obj", OBJ);
    folder.write("a.mtl", "newmtl m\nKd 1 0 0\n");
    folder.write("cutter.obj", OBJ);
    folder.write("s.toml", SCENE);
    folder.write("g.gltf", GLTF);
    for i in 1..=2 {
        folder.write(
            &format!("walk_{i}.obj"),
            OBJ.replace("v 1", &format!("v {i}")),
        );
    }
    let corners = [
        [0.0_f32; 3],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0],
    ];
    let corners = corners.iter().flatten().flat_map(|c| c.to_le_bytes());
    let indices = [0_u16, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2];
    let indices = indices.iter().flat_map(|i| i.to_le_bytes());
    fs::write(
        folder.path("g.bin"),
        corners.chain(indices).collect::<Vec<_>>(),
    )
    .unwrap();
    let rock = image::GrayImage::from_fn(8, 8, |x, y| image::Luma([(x * y) as u8]));
    rock.save(folder.path("r.png")).unwrap();
    let picture = image::RgbaImage::new(32, 32);
    picture.save(folder.path("good.png")).unwrap();
    picture.save(folder.path("good.diff.png")).unwrap();
    folder
}

fn contents(folder: &Scratch) -> Vec<(String, Vec<u8>)> {
    let files = folder.files().into_iter();
    let files = files.filter(|name| Path::new(&folder.path(name)).is_file());
    files
        .map(|name| {
            let bytes = fs::read(folder.path(&name)).unwrap();
            (name, bytes)
        })
        .collect()
}

/// Refused with exit code 2, with words that name the output, and nothing is changed.
#[track_caller]
fn is_refused(folder: &Scratch, line: &str, culprit: &str) {
    let (before, names) = (contents(folder), folder.files());
    let ran = folder.run(line).exits(2);
    for phrase in [culprit, "overwritten"] {
        assert!(
            ran.stderr.contains(phrase),
            "{line}: no `{phrase}` in {}",
            ran.stderr
        );
    }
    assert!(ran.stdout.is_empty(), "{line}");
    assert_eq!(contents(folder), before, "{line} changed a file");
    assert_eq!(folder.files(), names, "{line} left something");
}

#[test]
fn every_command_keeps_its_inputs() {
    let folder = inputs("places-commands");
    let small = "--resolution 32,32";
    for (line, culprit) in [
        ("inspect a.obj --json a.obj".to_owned(), "--json a.obj"),
        ("inspect a.obj --json a.mtl".to_owned(), "--json a.mtl"),
        ("inspect g.gltf --json g.bin".to_owned(), "--json g.bin"),
        (
            "inspect walk_%d.obj --json walk_2.obj".to_owned(),
            "--json walk_2.obj",
        ),
        (
            "section a.obj --section z=50% --json a.obj".to_owned(),
            "--json a.obj",
        ),
        ("plan s.toml --json s.toml".to_owned(), "--json s.toml"),
        (
            "plan a.obj --section z=50% --json ./../NAME/a.obj".to_owned(),
            "a.obj",
        ),
        (
            "plan a.obj --cutter cutter.obj --json cutter.obj".to_owned(),
            "--json cutter.obj",
        ),
        (
            format!("render s.toml {small} -o o.png --json s.toml"),
            "--json s.toml",
        ),
        (format!("render s.toml {small} -o r.png"), "--output r.png"),
        (
            format!("render s.toml {small} -o o.png --json cutter.obj"),
            "--json cutter.obj",
        ),
        (
            format!("render a.obj {small} --section z=50% --relief r.png:wrap=mirror -o r.png"),
            "--output r.png",
        ),
        (
            format!("render a.obj {small} --reference good.png -o good.png"),
            "--output good.png",
        ),
        (
            format!("render a.obj {small} --reference good.diff.png -o good.png"),
            "difference image",
        ),
        (
            format!("compare s.toml {small} --strategies raycast+mask --json a.obj"),
            "--json a.obj",
        ),
        (
            format!("animate s.toml {small} --turntable --frames 2 -o r.png"),
            "--output r.png",
        ),
        (
            format!("animate s.toml {small} --turntable --frames 2 -o o.gif --json s.toml"),
            "--json s.toml",
        ),
    ] {
        let own = folder
            .path("a")
            .parent()
            .unwrap()
            .file_name()
            .unwrap()
            .to_owned();
        is_refused(
            &folder,
            &line.replace("NAME", &own.to_string_lossy()),
            culprit,
        );
    }
}

#[test]
fn files_of_folders_and_numbers_are_kept_too() {
    let folder = inputs("places-folders");
    fs::create_dir(folder.path("maps")).unwrap();
    for name in ["exact.png", "0002.png"] {
        fs::copy(folder.path("r.png"), folder.path("maps").join(name)).unwrap();
    }
    let relief = "--section z=50% --resolution 32,32 --relief maps";
    for (line, culprit) in [
        (
            format!("compare a.obj {relief}/exact.png --strategies raycast+mask --heatmaps maps"),
            "--heatmaps maps/exact.png",
        ),
        (
            format!("animate a.obj {relief}/0002.png --turntable --frames 3 -o maps/%04d.png"),
            "--output maps/0002.png",
        ),
    ] {
        is_refused(&folder, &line, culprit);
        assert_eq!(
            fs::read_dir(folder.path("maps")).unwrap().count(),
            2,
            "{line}"
        );
    }
    let line = "animate a.obj --turntable --frames 3 --resolution 32,32 -o maps/%04d.png --json maps/0003.png";
    let ran = folder.run(line).exits(2);
    assert!(
        ran.stderr.contains("--json maps/0003.png"),
        "{}",
        ran.stderr
    );
}

#[cfg(unix)]
#[test]
fn links_of_both_kinds_are_followed() {
    let folder = inputs("places-links");
    std::os::unix::fs::symlink("a.obj", folder.path("soft.json")).unwrap();
    fs::hard_link(folder.path("a.obj"), folder.path("hard.json")).unwrap();
    std::os::unix::fs::symlink(".", folder.path("here")).unwrap();
    fs::create_dir(folder.path("deep")).unwrap();
    for output in ["soft.json", "hard.json", "here/a.obj", "./deep/../a.obj"] {
        is_refused(&folder, &format!("inspect a.obj --json {output}"), output);
    }
    // The controls: another file, even one of the same contents, and what is no file.
    fs::copy(folder.path("a.obj"), folder.path("copy.json")).unwrap();
    folder.run("inspect a.obj --json copy.json").exits(0);
    folder.run("inspect a.obj --json -").exits(0);
    folder.run("inspect a.obj --json /dev/null").exits(0);
}

#[test]
fn folders_that_are_yet_to_be_made_hide_no_input() {
    let folder = inputs("places-made");
    for (from, to) in [("a.obj", "in.stl"), ("r.png", "offset.png")] {
        fs::copy(folder.path(from), folder.path(to)).unwrap();
    }
    folder
        .run("export a.obj --section z=50% -o in.stl")
        .exits(0);
    fs::create_dir(folder.path("maps")).unwrap();
    for number in 1..=3 {
        let frame = folder.path(&format!("maps/{number}.png"));
        fs::copy(folder.path("good.png"), frame).unwrap();
    }
    fs::copy(folder.path("r.png"), folder.path("maps/exact.png")).unwrap();
    let cut = "--section z=50%";
    let small = "--resolution 32,32";
    let ragged = "--relief maps/exact.png:wrap=mirror";
    for (line, culprit) in [
        (format!("export in.stl {cut} -o no/../in.stl"), "--output"),
        (
            format!("export a.obj {cut} -o no/../in.obj --json no/such/../../a.mtl"),
            "--json",
        ),
        ("inspect a.obj --json no/../a.obj".to_owned(), "--json"),
        (
            "inspect a.obj --json no/./such/../../a.obj".to_owned(),
            "--json",
        ),
        (format!("section a.obj {cut} --json no/../a.obj"), "--json"),
        (
            format!("section a.obj {cut} {ragged} -o cut.svg --json maps/no/../exact.png"),
            "--json",
        ),
        ("plan s.toml --json no/../cutter.obj".to_owned(), "--json"),
        ("plan s.toml --save no/../s.toml".to_owned(), "--save"),
        (format!("render s.toml {small} -o no/../r.png"), "--output"),
        (
            format!("render s.toml {small} -o o.png --json no/../s.toml"),
            "--json",
        ),
        (
            format!("compare s.toml {small} --strategies raycast+mask --json no/../a.obj"),
            "--json",
        ),
        (
            format!(
                "compare a.obj {cut} {ragged} {small} --strategies raycast+mask --heatmaps no/../maps"
            ),
            "--heatmaps",
        ),
        (
            format!("animate s.toml {small} --turntable --frames 2 -o no/../r.png"),
            "--output",
        ),
        (
            format!(
                "animate a.obj {cut} {ragged} {small} --turntable --frames 2 -o o.gif --json maps/no/../exact.png"
            ),
            "--json",
        ),
        (
            "encode maps/%d.png -o maps/no/../1.png".to_owned(),
            "--output",
        ),
        (
            "relief offset.png:amplitude=5% --maps no/..".to_owned(),
            "--maps",
        ),
        (
            "relief offset.png:amplitude=5% --maps .".to_owned(),
            "--maps",
        ),
    ] {
        is_refused(&folder, &line, culprit);
    }
    let line = format!("plan a.obj {cut} --save no/../s.toml");
    let said = ["--save no/../s.toml", "holds something else"];
    folder.run(&line).must_refuse(&said);
    // The control: what stands in nobody's way is written there, and no more than that is made.
    folder.run("inspect a.obj --json no/../facts.json").exits(0);
    assert!(folder.path("facts.json").is_file(), "it is written");
    assert!(!folder.path("no").exists(), "nothing is in this folder");
}

#[test]
fn two_outputs_of_one_command_are_two_files() {
    let folder = inputs("places-twice");
    for (line, culprit) in [
        (
            "render a.obj --resolution 32,32 -o o.png --json ./o.png",
            "--json ./o.png",
        ),
        (
            "render a.obj --resolution 32,32 -o o.png --json no/../o.png",
            "--json",
        ),
        (
            "render a.obj --resolution 32,32 --reference good.png -o o.png --json o.diff.png",
            "difference image",
        ),
        (
            "section a.obj --section z=50% -o o.svg --json ./o.svg",
            "--json ./o.svg",
        ),
        (
            "animate a.obj --turntable --resolution 32,32 -o o.gif --json o.gif",
            "--json o.gif",
        ),
    ] {
        let before = folder.files();
        let ran = folder.run(line).exits(2);
        assert!(ran.stderr.contains(culprit), "{line}: {}", ran.stderr);
        assert_eq!(folder.files(), before, "{line}");
    }
}

#[test]
fn an_experiment_keeps_what_it_measures() {
    let folder = inputs("places-measure");
    let text = r#"
question = "Is the relief of a scene safe?"
analysis = "It is."

[[run]]
name = "r"
about = "A relief in the folder of records"
resolution = [32, 32]
strategies = ["raycast+mask"]
rounds = 1
[run.scene]
part = [{ mesh = "a.obj" }]
relief.r.image = "target/mine/r.exact.png"
cut = [{ surfaces = [{ section = "z=50%", relief = "r", wrap = "mirror" }] }]
"#;
    folder.write("mine.toml", text);
    fs::create_dir_all(folder.path("target/mine")).unwrap();
    fs::copy(folder.path("r.png"), folder.path("target/mine/r.exact.png")).unwrap();
    let ran = folder.run("measure mine.toml --out target").exits(2);
    assert!(
        ran.stderr.contains("--out target/mine/r.exact.png") && ran.stderr.contains("overwritten"),
        "{}",
        ran.stderr
    );
    assert!(
        !folder.path("target/run.json").exists(),
        "nothing is written"
    );
}

#[test]
fn a_report_keeps_the_records_it_is_made_of() {
    let folder = Scratch::new("places-report");
    fs::create_dir_all(folder.path("run/mine")).unwrap();
    for file in [
        "run/run.json",
        "run/mine/experiment.json",
        "run/mine/report.json",
    ] {
        folder.write(file, "{}");
    }
    let ran = folder.run("report run --out run/mine").exits(2);
    for phrase in ["--out run/mine/report.json", "overwritten"] {
        assert!(ran.stderr.contains(phrase), "{}", ran.stderr);
    }
    assert_eq!(fs::read_dir(folder.path("run/mine")).unwrap().count(), 2);
    // The control: a report beside the records is replaced by the next; that these are no records is found out after that.
    fs::create_dir_all(folder.path("run/pages")).unwrap();
    folder.write("run/pages/report.json", "{}");
    let ran = folder.run("report run --out run/pages").exits(2);
    assert!(!ran.stderr.contains("overwritten"), "{}", ran.stderr);
}
