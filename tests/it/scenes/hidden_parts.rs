//! Promise: a scene with a part that is not enabled is the scene without that part, on the command line and over time; its name may still
//! be named.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::fs;

use crate::common::command::Scratch;

const ONE: &str = r##"
[[part]]
name = "block"
shape = "cube"
material = { color = "#8a94a6" }

[[cut]]
name = "front"
except = ["ball*"]
surfaces = [{ section = "z=60%" }]
"##;

const OTHER: &str = r##"
[[part]]
name = "ball"
shape = "sphere"
translate = [0.6, 0.4, 0.2]
material = { color = "#d9773f" }
"##;

#[test]
fn a_picture_without_a_part_is_that_of_a_scene_without_it() {
    let folder = Scratch::new("hidden-parts");
    folder.write("one.toml", ONE);
    folder.write("both.toml", format!("{OTHER}{ONE}"));
    let size = "--resolution 96,72";
    folder
        .run(&format!("render one.toml {size} -o one.png"))
        .exits(0);
    folder
        .run(&format!("render both.toml {size} -o both.png"))
        .exits(0);
    folder
        .run(&format!(
            "render both.toml {size} --set part.ball.enabled=false -o hidden.png"
        ))
        .exits(0);
    let bytes = |name: &str| fs::read(folder.path(name)).unwrap();
    assert_eq!(
        bytes("hidden.png"),
        bytes("one.png"),
        "as if it were not there"
    );
    assert_ne!(bytes("both.png"), bytes("one.png"), "the ball is seen");
}

#[test]
fn parts_come_and_go_and_one_has_to_stay() {
    let folder = Scratch::new("hidden-parts-moving");
    let key = |values: &str| {
        format!(
            "{OTHER}enabled = true\n{ONE}\n[[key]]\ntarget = \"part.ball.enabled\"\ntimes_s = [0, 1]\nvalues = {values}\n"
        )
    };
    let timeline = folder.timeline(&key("[false, true]"));
    let names = |time_s: f64| -> Vec<String> {
        let scene = timeline.at(time_s).unwrap();
        scene.parts.into_iter().map(|p| p.name).collect()
    };
    assert_eq!(names(0.5), ["block"]);
    assert_eq!(names(1.0), ["ball", "block"]);

    let of: Vec<Vec<&str>> = [0, 1, 2].map(|i| timeline.names_of(i).collect()).into();
    assert_eq!(of, [vec!["ball"], vec!["block"], vec![]], "hidden or not");

    let none = format!("{OTHER}enabled = false\n{ONE}")
        .replace("shape = \"cube\"\n", "shape = \"cube\"\nenabled = false\n");
    let refused = folder.load(&none).unwrap_err().to_string();
    assert!(refused.contains("no part is enabled"), "{refused}");
}
