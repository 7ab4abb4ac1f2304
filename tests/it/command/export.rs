//! Promise: `cutaway export` writes what cuts leave of a model, and on request what they remove, as meshes with caps: closed, with the
//! parts, names and colours that the format has a place for. It needs no adapter. Refusals name the culprit and leave no file.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod colors;
mod formats;
mod refusals;
mod solids;

use std::fs;

use cutaway::scene::Topology;
use cutaway_io::load::{Loaded, load_mesh_file};
use serde_json::Value;

use crate::common::command::Scratch;

/// A file as the library reads it.
fn read(folder: &Scratch, name: &str) -> Loaded {
    load_mesh_file(&folder.path(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
}

/// The facts of all parts of a file.
fn facts(folder: &Scratch, name: &str) -> Topology {
    Topology::from_parts(&read(folder, name).parts)
}

fn number(value: &Value) -> f64 {
    value
        .as_f64()
        .unwrap_or_else(|| panic!("{value} is no number"))
}

#[test]
fn both_halves_are_closed_and_make_up_the_model() {
    let folder = Scratch::new("export-both");
    for extension in ["stl", "ply", "obj", "glb"] {
        let line = format!(
            "export shape:crank --section x=40% -o half.{extension} --both --json facts.json"
        );
        folder.run(&line).exits(0);
        let json: Value =
            serde_json::from_slice(&fs::read(folder.path("facts.json")).unwrap()).unwrap();
        let part = &json["parts"][0];
        let mut sum = 0.0;
        for (name, half) in [("half", "kept"), ("half.removed", "removed")] {
            let read = facts(&folder, &format!("{name}.{extension}"));
            let what = format!("{name}.{extension}");
            assert!(
                read.closed && read.inconsistent_edges == 0,
                "{what} is not closed"
            );
            let told = number(&part[half]["volume"]);
            assert!(
                (read.volume - told).abs() < 1e-6 * told,
                "{what}: {} and {told}",
                read.volume
            );
            assert_eq!(part[half]["open_edges"], 0, "{what}");
            assert!(part[half]["cap_triangles"].as_u64().unwrap() > 10, "{what}");
            sum += told;
        }
        let whole = Topology::from_parts(&cutaway::generate::shapes::shape("crank").unwrap());
        assert!(
            (sum - whole.volume).abs() < 1e-12,
            "{sum} and {}",
            whole.volume
        );
    }
    assert!(folder.path("half.mtl").is_file() && folder.path("half.removed.mtl").is_file());
}

#[test]
fn parts_keep_their_names_and_colours() {
    let folder = Scratch::new("export-parts");
    let whole = cutaway::generate::shapes::shape("gears").unwrap();
    for extension in ["obj", "glb"] {
        folder
            .run(&format!(
                "export shape:gears --section z=50% -o cut.{extension}"
            ))
            .exits(0);
        let loaded = read(&folder, &format!("cut.{extension}"));
        let names = |parts: &[cutaway::Part]| -> Vec<String> {
            parts.iter().map(|p| p.name.clone()).collect()
        };
        assert_eq!(names(&loaded.parts), names(&whole), "{extension}");
        for (part, of) in loaded.parts.iter().zip(&whole) {
            let topology = Topology::from_parts(std::slice::from_ref(part));
            assert!(topology.closed, "{extension}: {} is open", part.name);
            let off = (part.material.color - of.material.color)
                .abs()
                .max_element();
            assert!(
                off < 1.0 / 250.0,
                "{extension}: {} has another colour",
                part.name
            );
        }
    }
}

#[test]
fn parts_that_no_cut_names_are_written_whole() {
    let folder = Scratch::new("export-spared");
    folder
        .run("export shape:gears --section z=50% --exclude pinion -o cut.glb --json facts.json")
        .exits(0);
    let json: Value =
        serde_json::from_slice(&fs::read(folder.path("facts.json")).unwrap()).unwrap();
    for part in json["parts"].as_array().unwrap() {
        let is_spared = part["part"] == "pinion";
        let removed = part["removed"]["triangles"].as_u64().unwrap();
        assert_eq!(removed == 0, is_spared, "{part}");
        assert_eq!(
            part["cuts"].as_array().unwrap().is_empty(),
            is_spared,
            "{part}"
        );
    }
    let read = read(&folder, "cut.glb");
    assert!(read.parts.iter().any(|p| p.name == "pinion"), "it is there");
}

#[test]
fn scene_files_and_moments_are_cut_as_they_stand() {
    let folder = Scratch::new("export-scene");
    let volume = |line: &str| {
        folder.run(line).exits(0);
        facts(&folder, "out.ply").volume
    };
    let still = "[[part]]\nshape = 'cube'\nname = 'block'\n\n[[cut]]\nname = 'front'\nsurfaces = [{ section = 'z=0.25' }]\n";
    fs::write(folder.path("still.toml"), still).unwrap();
    assert!(
        (volume("export still.toml -o out.ply") - 0.25).abs() < 1e-12,
        "as the file says"
    );
    assert!(
        (volume("export still.toml --section x=0 -o out.ply") - 0.125).abs() < 1e-12,
        "and more"
    );
    assert!(
        (volume("export shape:cube --section x=0 --box 0,0,0: -o out.ply") - 0.375).abs() < 1e-12,
        "a union"
    );
    folder.write(
        "moves.toml",
        "[[part]]\nshape = 'cube'\n\n[[cut]]\nname = 'front'\nsurfaces = [{ normal = [0, 0, 1], origin = [0, 0, 0] }]\n\n\
         [[key]]\ntarget = 'cut.front.surfaces.0.origin'\ntimes_s = [0, 1]\nvalues = [[0, 0, 0], [0, 0, 0.25]]\n",
    );
    for (time, expected) in [("0", 0.5), ("1", 0.25), ("0.5", 0.375)] {
        let found = volume(&format!("export moves.toml --time {time} -o out.ply"));
        assert!((found - expected).abs() < 1e-12, "at {time} s: {found}");
    }
    let line = "export shape:cube --section x=0 --section y=0 --cut intersection -o out.ply";
    assert!((volume(line) - 0.75).abs() < 1e-12, "an intersection");
    assert!(
        (volume("export shape:cube --wedge z:0:270 -o out.ply") - 0.25).abs() < 1e-12,
        "a wide wedge"
    );
}

#[test]
fn open_models_are_told() {
    let folder = Scratch::new("export-open");
    let line = "export shape:sphere --defect holes:amount=5% --section z=50% -o half.stl";
    let ran = folder.run(line).exits(1);
    let said = &ran.stderr;
    assert!(
        said.contains("open edges") && said.contains("help:"),
        "{said}"
    );
    assert!(
        folder.path("half.stl").is_file(),
        "it is written all the same"
    );
    let closed = folder
        .run("export shape:sphere --section z=50% -o half.stl")
        .exits(0);
    assert!(!closed.stderr.contains("open edges"), "{}", closed.stderr);
}
