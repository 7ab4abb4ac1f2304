//! The command as a user runs it: the built binary, files in a folder of its own, exit codes and both streams.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::fs;
use std::path::Path;

use serde_json::Value;

mod cameras;
mod completions;
mod doctor;
use crate::common::command;
mod gallery;
mod saved;
mod settings;

use command::{Ran, Scratch};

fn json_of(path: &Path) -> Value {
    serde_json::from_slice(&fs::read(path).unwrap()).unwrap()
}

/// A cube seen from the front, its front half cut away: the picture's middle is cap.
const CUT_CUBE: &str = "shape:cube --section -z=50% --camera-azimuth-angle 0 --camera-elevation-angle 0 --resolution 64,48";

#[test]
fn render_writes_a_picture_with_caps_and_nothing_else() {
    let folder = Scratch::new("render");
    for strategy in ["raycast+mask", "grid:16+vds:128", "exact"] {
        let ran = folder
            .run(&format!(
                "render {CUT_CUBE} --strategy {strategy} -o out.png --supersample 1"
            ))
            .exits(0);
        assert!(ran.stdout.is_empty(), "stdout is for what was asked for");
        assert_eq!(ran.stderr, "", "nothing to complain of, drivers included");
        assert_eq!(folder.files(), ["out.png"]);
        let picture = image::open(folder.path("out.png")).unwrap();
        assert_eq!(picture.color(), image::ColorType::Rgba8);
        let picture = picture.to_rgba8();
        assert_eq!(picture.dimensions(), (64, 48));
        let [r, _, b, a] = picture.get_pixel(32, 24).0;
        assert!(
            r > b && a == 255,
            "{strategy}: the cap is warm, not {r} against {b}"
        );
        fs::remove_file(folder.path("out.png")).unwrap();
    }
    // The control: without the cut there is no cap to be seen.
    folder.run("render shape:cube --camera-azimuth-angle 0 --camera-elevation-angle 0 --resolution 64,48 -o out.png").exits(0);
    let [r, _, b, _] = image::open(folder.path("out.png"))
        .unwrap()
        .to_rgba8()
        .get_pixel(32, 24)
        .0;
    assert!(r < b, "the mesh is cool, not {r} against {b}");
}

#[test]
fn render_says_what_it_did_as_json_and_layers() {
    let folder = Scratch::new("facts");
    let ran = folder
        .run(&format!(
            "render {CUT_CUBE} -o deep/er/out.png --json - --layers layers.exr"
        ))
        .exits(0);
    let json = ran.json();
    assert_eq!(json["outcome"], "complete");
    assert_eq!(json["strategy"], "raycast+mask");
    assert_eq!(json["resolution"], serde_json::json!([64, 48]));
    assert!(json["cap_px"].as_u64().unwrap() > 100, "{json}");
    assert!(json["bytes"]["frame"].as_u64().unwrap() > 0, "{json}");
    assert!(json["time_ms"]["frame"].as_f64().unwrap() > 0.0, "{json}");
    assert!(json["adapter"]["name"].is_string(), "{json}");
    assert_eq!(folder.files(), ["deep", "layers.exr"]);
    let magic = fs::read(folder.path("layers.exr")).unwrap();
    assert_eq!(magic[..4], [0x76, 0x2f, 0x31, 0x01], "an OpenEXR file");
    let exact = folder
        .run(&format!(
            "render {CUT_CUBE} --strategy exact -o out.png --json -"
        ))
        .exits(0)
        .json();
    assert_eq!(
        exact["cap_px"], json["cap_px"],
        "the strategy agrees with exact here"
    );
}

#[test]
fn a_picture_can_go_to_standard_output() {
    let folder = Scratch::new("stdout");
    let ran = folder
        .run(&format!("render {CUT_CUBE} -o - --no-background"))
        .exits(0);
    let picture = image::load_from_memory(&ran.stdout).unwrap().to_rgba8();
    assert_eq!(
        picture.get_pixel(0, 0).0[3],
        0,
        "nothing is behind the cube"
    );
    assert_eq!(picture.get_pixel(32, 24).0[3], 255);
    assert!(folder.files().is_empty(), "{:?}", folder.files());
}

#[test]
fn the_image_test_passes_on_the_same_and_fails_on_another_picture() {
    let folder = Scratch::new("reference");
    folder
        .run(&format!("render {CUT_CUBE} -o good.png"))
        .exits(0);
    folder
        .run(&format!(
            "render {CUT_CUBE} -o out.png --reference good.png"
        ))
        .exits(0);
    assert_eq!(folder.files(), ["good.png", "out.png"]);
    let ran = folder
        .run(&format!(
            "render {CUT_CUBE} --flip -o out.png --reference good.png"
        ))
        .exits(1);
    assert!(ran.stderr.contains("failed: out.png:"), "{}", ran.stderr);
    assert_eq!(folder.files(), ["good.png", "out.diff.png", "out.png"]);
    let ran = folder
        .run(&format!(
            "render {CUT_CUBE} -o new.png --reference none.png"
        ))
        .exits(2);
    assert!(ran.stderr.contains("none.png"), "{}", ran.stderr);
    assert!(
        !folder.path("none.png").exists(),
        "a missing reference is never made"
    );
    assert!(!folder.path("new.png").exists(), "nothing is drawn");
}

#[test]
fn compare_reports_every_field_and_keeps_expectations() {
    let folder = Scratch::new("compare");
    // From the side: face on, even a coarse cap covers the right pixels.
    let scene = "shape:cube --section -z=50% --relief waves --resolution 64,48 --rounds 3";
    let json = folder
        .run(&format!(
            "compare {scene} --strategies raycast+mask,grid:4+vds:64 --json - --heatmaps maps"
        ))
        .exits(0)
        .json();
    for field in [
        "scene",
        "resolution",
        "adapter",
        "exact",
        "draw_only_ms",
        "strategies",
    ] {
        assert!(!json[field].is_null(), "{field}");
    }
    for field in [
        "cap_px",
        "surface_px",
        "background_px",
        "undecided_px",
        "overlap_px",
        "time_ms",
    ] {
        assert!(json["exact"][field].is_number(), "exact.{field}");
    }
    assert_eq!(json["draw_only_ms"]["samples"].as_array().unwrap().len(), 3);
    let strategies = json["strategies"].as_array().unwrap();
    assert_eq!(strategies.len(), 2);
    for strategy in strategies {
        assert_eq!(strategy["outcome"], "complete", "{strategy}");
        assert!(strategy["reason"].is_null(), "{strategy}");
        for field in [
            "missed_cap_px",
            "leaked_cap_px",
            "wrong_part_px",
            "crack_px",
            "interior_wrong_px",
            "edge_wrong_px",
            "decided_wrong_px",
            "odd_parity_px",
            "overlap_px",
            "depth_error_max",
            "depth_error_mean",
            "normal_error_deg_max",
            "normal_error_deg_mean",
        ] {
            assert!(
                strategy[field].is_number(),
                "{field} of {}",
                strategy["name"]
            );
        }
        for clock in ["solid", "cut", "frame"] {
            assert!(strategy["bytes"][clock].is_number(), "bytes.{clock}");
            assert!(
                strategy["time_ms"][clock]["median"].is_number(),
                "time_ms.{clock}"
            );
        }
        assert_eq!(
            strategy["time_ms"]["frame"]["samples"]
                .as_array()
                .unwrap()
                .len(),
            3
        );
        let pass = &strategy["passes"][0];
        for field in ["name", "clock", "median_ms"] {
            assert!(!pass[field].is_null(), "passes.{field}");
        }
    }
    assert_eq!(
        strategies[0]["decided_wrong_px"], 0,
        "raycast+mask is exact"
    );
    for name in [
        "exact.png",
        "legend.png",
        "raycast+mask.heatmap.png",
        "grid-4+vds-64.png",
    ] {
        assert!(folder.path("maps").join(name).is_file(), "{name}");
    }

    // Four cells across cannot follow the waves: an expectation of no error must fail.
    let ran = folder
        .run(&format!(
            "compare {scene} --strategies raycast+mask,grid:4+vds:64 --max-decided-wrong 0"
        ))
        .exits(1);
    assert!(
        ran.stderr.contains("failed: grid:4+vds:64"),
        "{}",
        ran.stderr
    );
    assert!(
        !ran.stderr.contains("failed: raycast+mask"),
        "{}",
        ran.stderr
    );
    assert!(
        ran.text().contains("draw only"),
        "the table is what was asked for"
    );
    folder
        .run(&format!(
            "compare {scene} --strategies raycast+mask --max-decided-wrong 0"
        ))
        .exits(0);
}

#[test]
fn a_comparison_that_decides_little_is_a_warning_and_fails_the_gate() {
    let folder = Scratch::new("undecided");
    // Two balls so close that no rounding tells which is seen.
    let ball = |name: &str, x: &str| {
        format!("[[part]]\nname = \"{name}\"\nshape = \"sphere\"\ntranslate = [{x}, 0, 0]\n")
    };
    let scene = ball("a", "0") + &ball("b", "1e-6");
    fs::write(folder.path("scene.toml"), scene).unwrap();
    let compare = |what: &str| {
        let options = "--resolution 64,48 --rounds 1 --strategies raycast+mask";
        folder.run(&format!("compare {what} {options}"))
    };
    let alone = compare("scene.toml --section=-z=50% --json -").exits(0);
    assert!(
        alone.stderr.contains("warning: exact leaves"),
        "{}",
        alone.stderr
    );
    assert!(alone.stderr.contains("help:"), "{}", alone.stderr);
    let exact = &serde_json::from_str::<Value>(alone.text()).unwrap()["exact"];
    let [undecided, judged] = ["undecided_px", "judged_px"].map(|f| exact[f].as_u64().unwrap());
    let covered = exact["cap_px"].as_u64().unwrap() + exact["surface_px"].as_u64().unwrap();
    assert!(undecided > 20 && judged < covered, "{exact}");
    let gated = compare("scene.toml --section=-z=50% --max-decided-wrong 0").exits(1);
    assert!(gated.stderr.contains("failed: exact:"), "{}", gated.stderr);
    // The control: one ball is decided.
    let one = compare("shape:sphere --section=-z=50% --max-decided-wrong 0").exits(0);
    assert!(!one.stderr.contains("warning"), "{}", one.stderr);
}

#[test]
fn inspect_gives_each_part_and_the_total() {
    let folder = Scratch::new("inspect");
    let json = folder
        .run("inspect shape:earth shape:cube --json -")
        .exits(0)
        .json();
    let parts = json["parts"].as_array().unwrap();
    assert_eq!(parts.len(), 4);
    for part in parts.iter().chain([&json["total"]]) {
        assert_eq!(part["closed"], true, "{part}");
        for field in [
            "vertices",
            "faces",
            "coincident_faces",
            "boundary_edges",
            "non_manifold_edges",
            "inconsistent_edges",
            "components",
            "euler",
            "volume",
            "area",
            "bounds",
            "depth_complexity",
        ] {
            assert!(!part[field].is_null(), "{field}");
        }
    }
    let sum: u64 = parts.iter().map(|p| p["faces"].as_u64().unwrap()).sum();
    assert_eq!(json["total"]["faces"], sum);

    folder.write(
        "open.obj",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n",
    );
    let text = folder.run("inspect open.obj").exits(0);
    assert!(
        text.text().contains("open is open: 3 boundary edges")
            && text.text().contains("from a whole number on average"),
        "{}",
        text.text()
    );
    let json = folder.run("inspect open.obj --json -").exits(0).json();
    let stray = &json["parts"][0]["winding_stray"];
    assert_eq!(stray["points"], 1728);
    // Half of the box's points see the missing face under a large angle, and none under more than half of all directions.
    let mean = stray["mean"].as_f64().unwrap();
    assert!((0.1..0.3).contains(&mean), "{stray}");
    assert!(stray["largest"].as_f64().unwrap() <= 0.5, "{stray}");
    let closed = folder.run("inspect shape:cube --json -").exits(0).json();
    assert!(closed["parts"][0]["winding_stray"].is_null());

    // Each face twice, once turned: closed by parity, and nothing is inside.
    let faces = "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\nf 3 1 2\nf 2 1 4\nf 4 3 2\nf 1 4 3\n";
    folder.write(
        "twice.obj",
        format!("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n{faces}"),
    );
    let json = folder.run("inspect twice.obj --json -").exits(0).json();
    assert_eq!(json["parts"][0]["closed"], true);
    assert_eq!(json["parts"][0]["coincident_faces"], 8);
    assert_eq!(json["total"]["coincident_faces"], 8);
    let text = folder.run("inspect twice.obj").exits(0);
    assert!(
        text.text()
            .contains("twice has 8 faces that lie on another"),
        "{}",
        text.text()
    );
    let once = folder.run("inspect shape:cube").exits(0);
    assert!(!once.text().contains("lie on another"), "{}", once.text());
}

#[test]
fn plan_needs_no_adapter() {
    let folder = Scratch::new("plan");
    let no_driver = |line: &str| {
        let output = folder
            .command(line)
            .env("VK_ICD_FILENAMES", "/nonexistent.json")
            .env("VK_DRIVER_FILES", "/nonexistent.json")
            .output()
            .unwrap();
        Ran::of(line, output)
    };
    let json = no_driver("plan shape:cube --section z=50% --json -")
        .exits(0)
        .json();
    let passes = json["passes"].as_array().unwrap();
    assert!(passes.len() > 2, "{json}");
    for field in ["name", "clock", "reads", "writes", "reason"] {
        assert!(passes.iter().all(|p| !p[field].is_null()), "{field}");
    }
    let cut = no_driver("plan shape:cube --section z=50%").exits(0);
    let plain = no_driver("plan shape:cube").exits(0);
    assert!(
        cut.text().contains("why") && cut.text().len() > plain.text().len(),
        "no cut, no caps"
    );

    // What does need one says what to install.
    let ran = no_driver(&format!("render {CUT_CUBE} -o out.png")).exits(2);
    assert!(ran.stderr.contains("mesa-vulkan-drivers"), "{}", ran.stderr);
    assert!(folder.files().is_empty(), "{:?}", folder.files());
}

#[test]
fn a_strategy_that_refuses_says_why() {
    let folder = Scratch::new("refuse");
    let line = format!("render {CUT_CUBE} --section x=60% --strategy stencil -o out.png");
    let ran = folder.run(&line).exits(2);
    assert!(
        ran.stderr.contains("strategy stencil: ") && ran.stderr.contains("help:"),
        "{}",
        ran.stderr
    );
    let json = folder
        .run(&format!(
            "compare {CUT_CUBE} --section x=60% --strategies stencil,raycast+mask --rounds 1 --json -"
        ))
        .exits(0)
        .json();
    let [refused, drawn] = [0, 1].map(|i| &json["strategies"][i]);
    assert_eq!(refused["outcome"], "refused");
    assert!(refused["reason"].is_string(), "{refused}");
    assert!(refused["missed_cap_px"].is_null(), "not measured is not 0");
    assert_eq!(drawn["outcome"], "complete");
    assert!(drawn["time_ms"]["frame"]["median"].as_f64().unwrap() > 0.0);
}

#[test]
fn fill_and_interference_reach_the_frame() {
    let folder = Scratch::new("fill");
    folder.write(
        "balls.toml",
        r#"
[[part]]
name = "left"
shape = "sphere?subdivisions=2"
[[part]]
name = "right"
shape = "sphere?subdivisions=2"
translate = [0.4, 0, 0]
[[cut]]
surfaces = [{ section = "-z=50%" }]
"#,
    );
    let overlap = |line: &str| {
        let json = folder.run(&format!("{line} --json -")).exits(0).json();
        json["overlap_px"].as_u64().expect("a count")
    };
    let render = "render balls.toml --resolution 96,64 --supersample 1";
    assert_eq!(
        overlap(&format!("{render} -o plain.png")),
        0,
        "nobody asked"
    );
    let found = overlap(&format!("{render} --interference -o asked.png"));
    assert!(found > 100, "{found} pixels");
    let green = format!("{render} --interference=#0f0 -o green.png");
    assert_eq!(overlap(&green), found, "the colour changes no count");
    let bytes = |name: &str| fs::read(folder.path(name)).expect(name);
    assert_ne!(bytes("plain.png"), bytes("asked.png"), "hatched");
    assert_ne!(bytes("green.png"), bytes("asked.png"), "in another colour");

    let compared = folder
        .run("compare balls.toml --resolution 96,64 --interference --rounds 1 --json -")
        .exits(0)
        .json();
    assert_eq!(
        compared["exact"]["overlap_px"],
        compared["strategies"][0]["overlap_px"]
    );
    let refused = (compared["strategies"].as_array().expect("a list").iter())
        .find(|s| s["name"] == "stencil")
        .expect("it is one of all");
    assert_eq!(refused["outcome"], "refused", "{refused}");

    // A hollow ball with both shells turned outward is full by the nonzero rule.
    let caps = |flip: u32, fill: &str| {
        let line = format!(
            "render shape:shells?flip_inner={flip} --section -z=50% {fill} --resolution 96,64 -o shells.png --json -"
        );
        let json = folder.run(&line).exits(0).json();
        json["cap_px"].as_u64().expect("a count")
    };
    assert_eq!(caps(0, ""), caps(1, ""), "parity ignores orientation");
    let [a, b] = [0, 1].map(|flip| caps(flip, "--fill nonzero"));
    assert_ne!(a, b, "nonzero does");

    // One face turned: the rule depends on it, and the user is warned.
    folder.write(
        "turned.obj",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 4 3\n",
    );
    let line = "render turned.obj --section -z=25% --fill nonzero --resolution 64,48 -o turned.png";
    let ran = folder.run(line).exits(0);
    assert!(ran.stderr.contains("3 edges"), "{}", ran.stderr);
    let line = "render turned.obj --section -z=25% --resolution 64,48 -o turned.png";
    let ran = folder.run(line).exits(0);
    assert!(!ran.stderr.contains("edges"), "{}", ran.stderr);

    for (line, phrase) in [
        ("--fill odd", "even-odd or nonzero"),
        ("--interference=pnik", "`pink`"),
    ] {
        let ran = folder.run(&format!("{render} {line} -o bad.png")).exits(2);
        assert!(ran.stderr.contains(phrase), "{}", ran.stderr);
    }
}

#[test]
fn a_section_that_misses_the_model_is_a_warning() {
    let folder = Scratch::new("miss");
    let ran = folder
        .run("render shape:cube --section z=99 --resolution 32,24 -o out.png")
        .exits(0);
    for said in [
        "warning: section z=99",
        "removed",
        "bounds: x -0.5 to 0.5",
        "help:",
    ] {
        assert!(ran.stderr.contains(said), "no `{said}` in\n{}", ran.stderr);
    }
    assert!(folder.path("out.png").is_file(), "a warning stops nothing");
    let ran = folder
        .run("render shape:cube --section z=50% --resolution 32,24 -o out.png")
        .exits(0);
    assert!(!ran.stderr.contains("warning"), "{}", ran.stderr);
}

#[test]
fn whichever_half_stays_the_cut_is_seen() {
    let folder = Scratch::new("seen");
    for section in ["x=50%", "-x=50%", "y=50%", "-y=50%", "z=50%", "-z=50%"] {
        let ran = folder
            .run(&format!(
                "render shape:sphere --section {section} --resolution 64,48 -o out.png --json -"
            ))
            .exits(0);
        let cap_px = ran.json()["cap_px"].as_u64().unwrap();
        assert!(cap_px > 100, "{section}: {cap_px} px");
    }
    for (options, said) in [
        (
            "--section x=50% --camera-azimuth-angle 90",
            "note: no cap is seen",
        ),
        (
            "--camera-position 0,0,9 --camera-focal-point 0,0,20",
            "warning: the picture is empty",
        ),
    ] {
        let ran = folder
            .run(&format!(
                "render shape:sphere {options} --resolution 64,48 -o out.png"
            ))
            .exits(0);
        assert!(ran.stderr.contains(said), "{options}: {}", ran.stderr);
    }
}

#[test]
fn an_open_mesh_is_drawn_with_a_warning() {
    let folder = Scratch::new("open");
    let tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n";
    for (last, warned) in [("", true), ("f 2 3 4\n", false)] {
        folder.write("open.obj", format!("{tetrahedron}{last}"));
        for (options, said) in [
            ("", "1 of 1 part is not closed"),
            ("--strategy raycast+mask", "px may be wrong"),
        ] {
            let ran = folder
                .run(&format!(
                    "render open.obj --section -z=30% --resolution 64,48 -o out.png {options}"
                ))
                .exits(0);
            assert_eq!(ran.stderr.contains(said), warned, "{}", ran.stderr);
        }
    }
}

#[test]
fn a_scene_file_is_drawn_as_it_says_and_options_win() {
    let folder = Scratch::new("scene");
    folder.write(
        "scene.toml",
        "resolution = [40, 30]\nbackground = \"#ff0000\"\n[[part]]\nshape = \"cube\"\n\
         [[cut]]\nname = \"front\"\nsurfaces = [{ section = \"-z=50%\" }]\n[strategy]\nname = \"exact\"\n",
    );
    let json = folder
        .run("render scene.toml -o out.png --json -")
        .exits(0)
        .json();
    assert_eq!(json["strategy"], "exact");
    let picture = image::open(folder.path("out.png")).unwrap().to_rgba8();
    assert_eq!(picture.dimensions(), (40, 30));
    assert_eq!(
        picture.get_pixel(0, 0).0,
        [255, 0, 0, 255],
        "the background of the scene"
    );
    let json = folder
        .run("render scene.toml -o out.png --json - --strategy raycast+mask --resolution 20,10")
        .exits(0)
        .json();
    assert_eq!(json["strategy"], "raycast+mask");
    assert_eq!(json["resolution"], serde_json::json!([20, 10]));
}

#[test]
fn the_demo_leaves_a_report_that_stands_alone() {
    let folder = Scratch::new("demo");
    let ran = folder
        .run("demo --out out --resolution 96,50 --rounds 1")
        .exits(0);
    for said in [
        "raycast+mask",
        "draw only",
        "report.html",
        "cutaway render out/scene.toml",
    ] {
        assert!(ran.text().contains(said), "no `{said}` in\n{}", ran.text());
    }
    let out = folder.path("out");
    let html = fs::read_to_string(out.join("report.html")).unwrap();
    assert!(
        html.contains("data:image/png;base64,"),
        "pictures are inside"
    );
    assert!(!html.contains("http"), "nothing is fetched");
    let page = fs::read_to_string(out.join("report.md")).unwrap();
    let pictures: Vec<&str> = page
        .split("](")
        .skip(1)
        .filter_map(|t| t.split(')').next())
        .collect();
    assert!(pictures.len() >= 5, "{pictures:?}");
    for picture in pictures {
        let file = picture.replace("%2B", "+");
        assert!(out.join(file).is_file(), "{picture}");
    }
    folder.run("report out").exits(0);
    let again = folder.run("measure out/demo.toml --dry-run").exits(0);
    assert!(again.text().contains("demo, crank: "), "{}", again.text());
    let json = json_of(&out.join("report.json"));
    let record = &json["folders"][0]["experiments"][0]["records"][0];
    assert_eq!(
        record["measurement"]["strategies"][0]["decided_wrong_px"], 0,
        "raycast+mask is exact"
    );
}

#[test]
fn the_demo_leaves_other_runs_alone() {
    let folder = Scratch::new("demo-other");
    fs::create_dir(folder.path("out")).unwrap();
    folder.write("out/run.json", b"{}");
    let ran = folder.run("demo --out out --resolution 96,50").exits(2);
    assert!(ran.stderr.contains("another run"), "{}", ran.stderr);
    assert!(!folder.path("out/demo.toml").exists(), "nothing is written");
}

#[test]
fn help_has_examples() {
    let folder = Scratch::new("help");
    let ran = folder.run("--help").exits(0);
    assert!(
        ran.text().contains("cutaway render") && ran.text().contains("Exit codes"),
        "{}",
        ran.text()
    );
    for command in ["render", "compare", "animate", "inspect", "plan", "demo"] {
        let ran = folder.run(&format!("{command} --help")).exits(0);
        assert!(ran.text().contains("Examples:"), "{}", ran.text());
        assert!(
            ran.text().contains(&format!("cutaway {command}")),
            "{}",
            ran.text()
        );
    }
    assert!(
        folder
            .run("render --help")
            .exits(0)
            .text()
            .contains("shape:NAME?param"),
        "the shapes are listed"
    );
}
