//! A section is the cap: the other clip-surfaces of its cut, and other cuts, take their share of a plane away.

use std::fs;

use serde_json::Value;

use super::command::Scratch;
use super::{block, json_of, near, number, shoelace, uv};

/// Names of faces with their areas, in order.
fn faces(json: &Value) -> Vec<(String, f64)> {
    let sections = json["sections"].as_array().unwrap().iter();
    let face = |s: &Value| {
        let plane = s["face"]["plane"].as_str().unwrap().to_owned();
        (plane, number(&s["area"]))
    };
    sections.map(face).collect()
}

#[track_caller]
fn has_faces(folder: &Scratch, line: &str, expected: &[(&str, f64)]) -> Value {
    let json = json_of(folder, line);
    let found = faces(&json);
    let planes = |all: &mut dyn Iterator<Item = String>| all.collect::<Vec<_>>();
    assert_eq!(
        planes(&mut found.iter().map(|f| f.0.clone())),
        planes(&mut expected.iter().map(|f| f.0.to_owned())),
        "{line}"
    );
    for ((plane, found), (_, expected)) in found.iter().zip(expected) {
        assert!(near(*found, *expected), "{line}, {plane}: {found}");
    }
    json
}

#[test]
fn a_corner_of_a_cube_has_three_quarters_of_faces() {
    let folder = Scratch::new("section-corner");
    let json = has_faces(
        &folder,
        "shape:cube --box 0,0,0:",
        &[("-x=0", 0.25), ("-y=0", 0.25), ("-z=0", 0.25)],
    );
    for section in json["sections"].as_array().unwrap() {
        let part = &section["parts"][0];
        assert!(near(number(&part["perimeter"]), 2.0), "{part}");
        assert_eq!(section["trimmed"], true, "{section}");
        let loops = part["loops"].as_array().unwrap();
        assert_eq!(loops.len(), 1, "{part}");
        assert!(
            near(shoelace(&uv(&loops[0])), 0.5),
            "counter-clockwise: {part}"
        );
        for point in loops[0]["world"].as_array().unwrap() {
            let coordinates = [0, 1, 2].map(|i| number(&point[i]));
            assert!(
                coordinates
                    .iter()
                    .all(|c| (-1e-12..=0.5 + 1e-12).contains(c)),
                "{coordinates:?} is not in the corner"
            );
        }
    }
    // The table and the drawing say which face it is.
    let ran = folder
        .run("section shape:cube --box 0,0,0: -o corner.svg")
        .exits(0);
    assert_eq!(ran.text(), "", "the drawing is what was asked for");
    let drawing = fs::read_to_string(folder.path("corner.svg")).unwrap();
    let ran = folder.run("section shape:cube --box 0,0,0:").exits(0);
    for name in ["face 1 of 3 (-x=0)", "face 3 of 3 (-z=0)"] {
        let name = format!("box 0,0,0:, {name}");
        assert!(drawing.contains(&name), "{drawing}");
        assert!(ran.text().contains(&name), "{}", ran.text());
    }
    // The control: of the whole model each plane is a square of its own.
    let line = "shape:cube --box 0,0,0: --whole";
    let json = has_faces(
        &folder,
        line,
        &[("-x=0", 1.0), ("-y=0", 1.0), ("-z=0", 1.0)],
    );
    assert_eq!(json["sections"][0]["trimmed"], false, "{json}");
}

#[test]
fn boxes_wedges_and_intersections_have_the_areas_of_their_caps() {
    let folder = Scratch::new("section-regions");
    let inner = 0.5 * 0.3;
    for (line, expected) in [
        (
            "shape:cube --box -0.25,-0.25,-0.25:0.25,0.25,0.05",
            &[
                ("-x=-0.25", inner),
                ("x=0.25", inner),
                ("-y=-0.25", inner),
                ("y=0.25", inner),
                ("-z=-0.25", 0.25),
                ("z=0.05", 0.25),
            ][..],
        ),
        ("shape:cube --wedge z:0:90", &[("-y=0", 0.5), ("-x=0", 0.5)]),
        (
            "shape:cube --wedge z:0:60",
            &[("-y=0", 0.5), ("-0.866025,0.5,0,0", 0.5 / 0.75_f64.sqrt())],
        ),
        ("shape:cube --wedge z:0:270", &[("-y=0", 0.5), ("x=0", 0.5)]),
        (
            "shape:cube --section z=0 --section x=0 --cut intersection",
            &[("z=0", 0.5), ("x=0", 0.5)],
        ),
        (
            "shape:cube --section z=0 --section x=-0.25 --section y=0.25 --cut intersection",
            &[
                ("z=0", 0.25 * 0.75),
                ("x=-0.25", 0.5 * 0.75),
                ("y=0.25", 0.5 * 0.25),
            ],
        ),
        // Another cut: what it removes is not there.
        (
            "shape:cube --section z=0 --section x=-0.25",
            &[("z=0", 0.75), ("x=-0.25", 0.5)],
        ),
        (
            "shape:cube --section z=0.1 --section z=0.2",
            &[("z=0.1", 0.0), ("z=0.2", 1.0)],
        ),
        (
            "shape:cube --section -z=0 --box -0.25,-0.25,-0.25:0.25,0.25,0.25",
            &[
                ("-z=0", 0.75),
                ("-x=-0.25", 0.125),
                ("x=0.25", 0.125),
                ("-y=-0.25", 0.125),
                ("y=0.25", 0.125),
                ("-z=-0.25", 0.25),
                ("z=0.25", 0.0),
            ],
        ),
        // One plane twice has one cap, and between two that leave nothing there is none.
        (
            "shape:cube --section z=0 --section z=0",
            &[("z=0", 1.0), ("z=0", 0.0)],
        ),
        (
            "shape:cube --section z=0 --section -z=0",
            &[("z=0", 0.0), ("-z=0", 0.0)],
        ),
        (
            "shape:cube --section z=0 --section -z=0 --cut intersection",
            &[("z=0", 0.0), ("-z=0", 0.0)],
        ),
    ] {
        has_faces(&folder, line, expected);
    }
    let ran = folder
        .run("section shape:cube --section z=0.1 --section z=0.2")
        .exits(0);
    assert!(ran.text().contains("nothing is left"), "{}", ran.text());
}

#[test]
fn what_two_halves_leave_is_the_whole() {
    let folder = Scratch::new("section-halves");
    for (shape, plane) in [("gears", "-z=50%"), ("crank", "1,2,3@50%,50%,50%")] {
        let measured = |other: &str| {
            let line = format!("shape:{shape} --section {plane} {other}");
            let json = json_of(&folder, &line);
            number(&json["sections"][0]["area"])
        };
        let whole = measured("");
        for side in ["x=41%", "0.3,-1,0.2@50%,50%,50%"] {
            let halves = ["", "--flip"].map(|f| measured(&format!("--section {side} {f}")));
            assert!(halves.iter().all(|h| *h > 0.05 * whole), "{halves:?}");
            assert!(
                (halves[0] + halves[1] - whole).abs() < 1e-9 * whole,
                "{shape}, {side}: {halves:?} of {whole}"
            );
        }
    }
}

#[test]
fn offsets_filters_and_cuts_that_are_off_count_as_in_the_picture() {
    let folder = Scratch::new("section-trimmed-parts");
    let scene = |more: &str| {
        format!(
            r#"
[[part]]
name = "cut"
shape = "cube"
[[part]]
name = "spared"
shape = "cube"
[[cut]]
name = "front"
surfaces = [{{ section = "z=0" }}]
[[cut]]
name = "side"
except = ["spared"]
{more}
surfaces = [{{ section = "x=0" }}]
"#
        )
    };
    let areas = |more: &str| -> Vec<f64> {
        folder.write("scene.toml", scene(more));
        // What is offset lies beside the plane that is told.
        let json = folder.run("section scene.toml --json -").exits(0).json();
        let parts = json["sections"][0]["parts"].as_array().unwrap().iter();
        // The first part is shown over the second, and is drawn last.
        parts.map(|p| number(&p["area"])).rev().collect()
    };
    for (more, of_cut) in [
        ("", 0.5),
        ("enabled = false", 1.0),
        ("offset = { \"cut\" = 0.25 }", 0.75),
    ] {
        let found = areas(more);
        assert!(
            near(found[0], of_cut) && near(found[1], 1.0),
            "{more}: {found:?}"
        );
    }
}

#[test]
fn a_hole_in_what_is_removed_is_none_of_the_section() {
    let folder = Scratch::new("section-trimmed-open");
    let open: String = block(3.0, 8)
        .lines()
        .filter(|l| *l != "f 10 11 15 14")
        .map(|l| format!("{l}\n"))
        .collect();
    folder.write("two.obj", [block(0.0, 0), open].concat());
    let line = "section two.obj --section z=0.5 --json -";
    let whole = folder.run(line).exits(1).json();
    assert_eq!(
        whole["sections"][0]["parts"][0]["open_chains"]
            .as_array()
            .unwrap()
            .len(),
        1
    );
    let trimmed = folder
        .run(&format!("{line} --section -x=2"))
        .exits(0)
        .json();
    let part = &trimmed["sections"][0]["parts"][0];
    assert!(near(number(&part["area"]), 1.0), "{part}");
    assert_eq!(part["closed"], true, "{part}");
    // A curve that is cut is as long as what is left of it.
    let half = folder
        .run(&format!("{line} --section -x=3.5"))
        .exits(1)
        .json();
    let chains = &half["sections"][0]["parts"][0]["open_chains"];
    let lengths: f64 = (chains.as_array().unwrap().iter())
        .map(|c| number(&c["length"]))
        .sum();
    assert!(near(lengths, 2.0), "1 at x = 3 and two halves: {chains}");
}
