//! Promise: `cutaway section` says what planes cut out of a model: areas, outlines to scale, planes, and where an outline does not
//! close. It needs no adapter. What it writes is read back here by readers of our own.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::fs;

use serde_json::Value;

use crate::common::command;
mod dxf;
mod hostile;
mod svg;
mod trimmed;

use command::Scratch;

fn number(value: &Value) -> f64 {
    value
        .as_f64()
        .unwrap_or_else(|| panic!("{value} is not a number"))
}

fn vector(value: &Value) -> [f64; 3] {
    [0, 1, 2].map(|i| number(&value[i]))
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-9 * b.abs().max(1.0)
}

/// Twice the area around the origin, counter-clockwise positive.
fn shoelace(points: &[[f64; 2]]) -> f64 {
    let next = points.iter().cycle().skip(1);
    let terms = points.iter().zip(next);
    terms.map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum()
}

fn uv(curve: &Value) -> Vec<[f64; 2]> {
    let points = curve["uv"].as_array().unwrap();
    points
        .iter()
        .map(|p| [0, 1].map(|i| number(&p[i])))
        .collect()
}

/// Everything that must hold of the JSON whatever was cut: sums, planes, loops, and points on the plane twice told.
fn check(json: &Value) {
    for section in json["sections"].as_array().unwrap() {
        let plane = &section["plane"];
        let [origin, normal, u, v] = ["origin", "normal", "u", "v"].map(|k| vector(&plane[k]));
        let cross = [0, 1, 2].map(|i| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            u[j] * v[k] - u[k] * v[j]
        });
        for i in 0..3 {
            assert!(near(cross[i], -normal[i]), "u x v is not -normal: {plane}");
        }
        assert!(near(dot(normal, normal), 1.0), "{plane}");
        let (mut area, mut perimeter) = (0.0, 0.0);
        for part in section["parts"].as_array().unwrap() {
            area += number(&part["area"]);
            perimeter += number(&part["perimeter"]);
            let curves = ["loops", "open_chains"].map(|k| part[k].as_array().unwrap());
            for curve in curves.into_iter().flatten() {
                let at = uv(curve);
                let world = curve["world"].as_array().unwrap();
                assert_eq!(at.len(), world.len(), "points are told twice");
                for ([a, b], p) in at.into_iter().zip(world) {
                    let p = vector(p);
                    for i in 0..3 {
                        assert!(
                            near(origin[i] + a * u[i] + b * v[i], p[i]),
                            "{p:?} is elsewhere"
                        );
                    }
                }
            }
            assert!(part["defects"].is_array(), "{part}");
            assert!(part["color"].as_str().unwrap().starts_with('#'), "{part}");
            let closed = part["closed"].as_bool().unwrap();
            assert!(!closed || curves[1].is_empty(), "closed, with open chains");
        }
        assert!(near(number(&section["area"]), area), "the sum of areas");
        assert!(
            near(number(&section["perimeter"]), perimeter),
            "of perimeters"
        );
    }
}

fn json_of(folder: &Scratch, line: &str) -> Value {
    let json = folder
        .run(&format!("section {line} --json -"))
        .exits(0)
        .json();
    check(&json);
    json
}

#[test]
fn a_cube_has_the_area_of_a_square() {
    let folder = Scratch::new("section-cube");
    for section in ["z=50%", "-x=25%", "y=0", "0,0,1@0,0,0.3"] {
        let json = json_of(&folder, &format!("shape:cube --section {section}"));
        let part = &json["sections"][0]["parts"][0];
        assert!(near(number(&part["area"]), 1.0), "{section}: {part}");
        assert!(near(number(&part["perimeter"]), 4.0), "{section}: {part}");
        let outline = uv(&part["loops"][0]);
        assert!(near(shoelace(&outline), 2.0), "counter-clockwise: {part}");
    }
    // A diagonal, and a corner: sqrt 2, and a triangle of side sqrt(2) / 2.
    let json = json_of(&folder, "shape:cube --section 1,1,0,0");
    assert!(near(number(&json["sections"][0]["area"]), 2.0_f64.sqrt()));
    let json = json_of(&folder, "shape:cube --section 1,1,1,1");
    let side = 0.5 * 2.0_f64.sqrt();
    assert!(near(
        number(&json["sections"][0]["area"]),
        side * side * 3.0_f64.sqrt() / 4.0
    ));
    // The table says the same in short.
    let ran = folder.run("section shape:cube --section z=50%").exits(0);
    let row = ran.text().lines().nth(2).unwrap();
    let cells: Vec<&str> = row.split_whitespace().collect();
    assert_eq!(cells, ["z=50%", "cube", "1", "4", "1", "0"], "{row}");
    assert!(folder.files().is_empty(), "nothing was asked for");
}

#[test]
fn a_drawing_is_upright_and_not_mirrored() {
    let folder = Scratch::new("section-upright");
    // What is to the right and up, seen from the removed side: as `render` sees the cap.
    for (section, u, v) in [
        ("-z=50%", [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]),
        ("z=50%", [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0]),
        ("-x=50%", [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]),
        ("-y=50%", [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]),
        ("y=50%", [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]),
    ] {
        let json = json_of(&folder, &format!("shape:cube --section {section}"));
        let plane = &json["sections"][0]["plane"];
        assert_eq!(
            [vector(&plane["u"]), vector(&plane["v"])],
            [u, v],
            "{section}"
        );
    }
}

#[test]
fn every_part_and_plane_is_told_and_filters_are_heard() {
    let folder = Scratch::new("section-parts");
    let names = |json: &Value| -> Vec<Vec<String>> {
        let of = |s: &Value| {
            let parts = s["parts"].as_array().unwrap().iter();
            parts
                .map(|p| p["part"].as_str().unwrap().to_owned())
                .collect()
        };
        json["sections"]
            .as_array()
            .unwrap()
            .iter()
            .map(of)
            .collect()
    };
    let json = json_of(&folder, "shape:gears --section z=50% --section x=40%");
    assert_eq!(names(&json), [vec!["wheel", "pinion"], vec!["wheel"]]);
    let json = json_of(&folder, "shape:gears --section z=50% --exclude pin*");
    assert_eq!(names(&json), [vec!["wheel"]]);
    folder.write(
        "scene.toml",
        r#"
[[part]]
name = "whole"
shape = "cube"
role = "interior"
[[part]]
name = "low"
shape = "cube"
priority = 1
[[part]]
name = "high"
shape = "cube"
priority = 2
[[part]]
name = "spared"
shape = "cube"
[[cut]]
name = "front"
except = ["spared"]
surfaces = [{ origin = [0, 0, 0], u = [1, 0, 0], v = [0, 1, 0] }, { section = "x=10%" }]
[[key]]
target = "cut.front.surfaces.0.origin"
times_s = [0, 1]
values = [[0, 0, 0], [0, 0, 9]]
"#,
    );
    let json = json_of(&folder, "scene.toml");
    assert_eq!(
        names(&json),
        [["low", "high"], ["low", "high"]],
        "who wins is last"
    );
    assert_eq!(json["sections"][1]["clip_surface"], 1, "{json}");
    assert_eq!(json["sections"][1]["cut"], "front", "{json}");
    let late = json_of(&folder, "scene.toml --time 1");
    assert_eq!(names(&late)[0], Vec::<String>::new(), "the plane has gone");
    assert_eq!(names(&late)[1], ["low", "high"], "the other has stayed");
}

#[test]
fn clip_surfaces_have_the_numbers_of_the_scene() {
    let folder = Scratch::new("section-numbers");
    folder.write(
        "scene.toml",
        r#"
[[part]]
name = "first"
shape = "cube"
[[part]]
name = "second"
shape = "cube"
[[cut]]
name = "off"
enabled = false
volume = "shape:sphere"
box = { min = [0, 0, 0] }
[[cut]]
name = "on"
surfaces = [{ section = "x=50%" }, { section = "z=50%" }]
"#,
    );
    let json = json_of(&folder, "scene.toml");
    let sections = json["sections"].as_array().unwrap();
    let numbers: Vec<_> = (sections.iter())
        .map(|s| s["clip_surface"].as_u64().unwrap())
        .collect();
    assert_eq!(numbers, [4, 5], "after three faces and a cutter");
    let parts = sections[0]["parts"].as_array().unwrap().iter();
    let drawn: Vec<_> = parts.map(|p| p["part"].as_str().unwrap()).collect();
    assert_eq!(drawn, ["second", "first"], "of equals the first wins");
}

#[test]
fn loops_are_holes_and_outlines() {
    let folder = Scratch::new("section-loops");
    let json = json_of(&folder, "shape:gears --section -z=50%");
    let mut holes = 0;
    for part in json["sections"][0]["parts"].as_array().unwrap() {
        let loops = part["loops"].as_array().unwrap();
        let areas: Vec<f64> = loops.iter().map(|l| shoelace(&uv(l)) * 0.5).collect();
        holes += areas.iter().filter(|a| **a < 0.0).count();
        let sum: f64 = areas.iter().sum();
        assert!(near(sum, number(&part["area"])), "{areas:?}");
        let lengths: f64 = loops.iter().map(|l| number(&l["length"])).sum();
        assert!(
            near(lengths, number(&part["perimeter"])),
            "{}",
            part["part"]
        );
    }
    assert_eq!(holes, 2, "one in each wheel");
    // Shells that overlap: even-odd has a void where nonzero has none.
    folder.write("two.obj", [block(0.0, 0), block(0.5, 8)].concat());
    let area = |rule: &str| {
        let line = format!("two.obj --section -z=50% --fill {rule}");
        number(&json_of(&folder, &line)["sections"][0]["area"])
    };
    assert!(near(area("even-odd"), 1.0), "{}", area("even-odd"));
    assert!(near(area("nonzero"), 1.5), "{}", area("nonzero"));
}

/// A unit cube from x on as OBJ; `first` vertices come before it.
fn block(x: f64, first: u32) -> String {
    let mut text = String::new();
    for z in [0.0, 1.0] {
        for (u, v) in [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)] {
            text.push_str(&format!("v {} {v} {z}\n", x + u));
        }
    }
    for face in [
        [4, 3, 2, 1],
        [5, 6, 7, 8],
        [1, 2, 6, 5],
        [2, 3, 7, 6],
        [3, 4, 8, 7],
        [4, 1, 5, 8],
    ] {
        let [a, b, c, d] = face.map(|i| i + first);
        text.push_str(&format!("f {a} {b} {c} {d}\n"));
    }
    text
}

#[test]
fn an_outline_that_does_not_close_is_told_and_fails() {
    let folder = Scratch::new("section-open");
    let whole = block(0.0, 0);
    let open: String = whole
        .lines()
        .filter(|l| *l != "f 2 3 7 6")
        .map(|l| format!("{l}\n"))
        .collect();
    folder.write("open.obj", &open);
    folder.write("whole.obj", &whole);
    let ran = folder
        .run("section open.obj --section z=50% --json - -o open.svg")
        .exits(1);
    let json = ran.json();
    check(&json);
    let part = &json["sections"][0]["parts"][0];
    assert_eq!(part["closed"], false, "{part}");
    assert_eq!(part["open_chains"].as_array().unwrap().len(), 1, "{part}");
    assert!(near(number(&part["area"]), 0.0), "{part}");
    let said = ran.stderr;
    assert!(
        said.contains("failed: open by z=50%: the mesh is open"),
        "{said}"
    );
    assert!(said.contains("help:"), "{said}");
    let drawing = fs::read_to_string(folder.path("open.svg")).unwrap();
    assert!(drawing.contains("class=\"open\""), "{drawing}");
    // Winding numbers complete it by a line.
    let ran = folder
        .run("section open.obj --section z=50% --close winding --json - -o closed.svg")
        .exits(0);
    let closed = ran.json();
    check(&closed);
    let part = &closed["sections"][0]["parts"][0];
    let whole_area = {
        let ran = folder
            .run("section whole.obj --section z=50% --json -")
            .exits(0);
        number(&ran.json()["sections"][0]["area"])
    };
    assert!(near(number(&part["area"]), whole_area), "{part}");
    assert_eq!(part["closed"], true, "{part}");
    assert_eq!(part["bridges"].as_array().unwrap().len(), 1, "{part}");
    let said = ran.stderr;
    assert!(
        said.contains("note: open by z=50%: the mesh is open: straight lines complete"),
        "{said}"
    );
    let drawing = fs::read_to_string(folder.path("closed.svg")).unwrap();
    assert!(drawing.contains("closed by winding numbers"), "{drawing}");
    // The controls: the same mesh where it is whole, and cut where the hole is not.
    folder.run("section whole.obj --section z=50%").exits(0);
    folder.write("top.obj", whole.replace("f 5 6 7 8\n", ""));
    folder.run("section top.obj --section z=50%").exits(0);
}

#[test]
fn no_adapter_is_needed() {
    let folder = Scratch::new("section-adapter");
    let mut command = folder.command("section shape:crank --section z=50% -o cut.svg");
    for name in ["VK_DRIVER_FILES", "VK_ICD_FILENAMES"] {
        command.env(name, "/nowhere.json");
    }
    assert!(command.output().unwrap().status.success(), "section");
    assert_eq!(folder.files(), ["cut.svg"]);
}
