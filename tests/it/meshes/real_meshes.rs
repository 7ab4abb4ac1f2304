//! Promise: meshes that others made load, and their facts are what others measured.
//!
//! The meshes are not part of the repository. They are looked for in `$CUTAWAY_DATA`, then in `../shared/data`; where
//! neither exists the tests say so and pass, because the suite must pass on a machine that has only the repository.
//! `facts.json` there was measured by other code, with vertices welded wherever positions are bit-equal. `cutaway-io` welds
//! only what is open, and never across parts; the rows of [`EXCEPTIONS`] say where that changes a count, and why.

#![allow(
    clippy::unwrap_used,
    reason = "the helpers of a test fail by panicking, too"
)]

use crate::common::data;

use cutaway::scene::Topology;
use cutaway_io::load::{Loaded, load_mesh_file};
use data::data;
use serde_json::Value;

/// Relative; the facts were summed in another order, and skins blended in f32.
const VOLUME_AND_AREA: f64 = 1e-6;

/// Relative to the diagonal; f32 skinning moves corners of the bounds by some 1e-8.
const BOUNDS: f64 = 1e-6;

/// What is not compared.
#[derive(Clone, Copy, PartialEq)]
enum Except {
    /// Numbers of vertices and edges, Euler characteristic, pieces.
    Counts,
    /// Counts, and the number of triangles.
    CountsAndFaces,
}

/// Files that count differently, and why.
const EXCEPTIONS: &[(&str, Except, &str)] = &[
    (
        "messy/openscad_nonmanifold.obj",
        Except::Counts,
        "closed by its own indices: solids that touch along 18 edges stay apart",
    ),
    (
        "messy/offset1.obj",
        Except::Counts,
        "closed by its own indices: 4 touching edges stay apart",
    ),
    (
        "messy/chair.obj",
        Except::Counts,
        "every edge has an even number of uses by the file's own indices, so nothing is welded",
    ),
    (
        "dense/spinal_implant_lattice.ply",
        Except::CountsAndFaces,
        "closed by its own indices: welding would flatten 4,120 slivers and join beams that touch",
    ),
    (
        "assembly/cube_gears.glb",
        Except::CountsAndFaces,
        "closed by its own indices: welding would flatten 24 slivers",
    ),
    (
        "cad/featuretype.stl",
        Except::Counts,
        "288 pairs of vertices within 1e-8 of the size are welded too, which closes it",
    ),
    (
        "messy/antique_camera.glb",
        Except::Counts,
        "the facts weld its two nodes together",
    ),
    (
        "animated/Knight.glb",
        Except::Counts,
        "the facts weld its 15 nodes together",
    ),
];

/// Files the facts call open because bit-equal welding makes edges with more than two uses; by parity they are closed.
const CLOSED_BY_PARITY: &[&str] = &[
    "cad/featuretype.stl",
    "assembly/cycloidal_drive.ply",
    "messy/openscad_nonmanifold.obj",
    "messy/offset1.obj",
    "messy/chair.obj",
    "dense/spinal_implant_lattice.ply",
];

fn facts(folder: &std::path::Path) -> Vec<Value> {
    let text = std::fs::read_to_string(folder.join("facts.json")).unwrap();
    serde_json::from_str(&text).unwrap()
}

fn load(folder: &std::path::Path, file: &str) -> (Loaded, Topology) {
    let loaded = load_mesh_file(&folder.join(file)).unwrap_or_else(|e| panic!("{e}"));
    let topology = Topology::from_parts(&loaded.parts);
    (loaded, topology)
}

fn close(ours: f64, theirs: f64, tolerance: f64) -> bool {
    (ours - theirs).abs() <= tolerance * theirs.abs()
}

/// What differs between our topology and one entry of the facts.
fn differences(file: &str, ours: &Topology, theirs: &Value) -> Vec<String> {
    let except = EXCEPTIONS.iter().find(|e| e.0 == file).map(|e| e.1);
    let mut wrong = Vec::new();
    let mut same = |name: &str, ours: i64, key: &str| {
        let theirs = theirs[key].as_i64().unwrap();
        if ours != theirs {
            wrong.push(format!("{file}: {name} {ours}, not {theirs}"));
        }
    };
    if except != Some(Except::CountsAndFaces) {
        same("faces", ours.faces as i64, "faces");
    }
    if except.is_none() {
        same("vertices", ours.vertices as i64, "vertices");
        same("boundary", ours.boundary_edges as i64, "boundary_edges");
        same(
            "non-manifold",
            ours.non_manifold_edges as i64,
            "nonmanifold_edges",
        );
        same("euler", ours.euler, "euler");
        same("pieces", ours.components as i64, "bodies");
    }
    let closed = theirs["watertight"].as_bool().unwrap() || CLOSED_BY_PARITY.contains(&file);
    if ours.closed != closed {
        wrong.push(format!("{file}: closed {}", ours.closed));
    }
    let consistent = theirs["winding_ok"].as_bool().unwrap();
    if consistent && ours.closed && ours.inconsistent_edges > 0 {
        wrong.push(format!(
            "{file}: {} inconsistent edges",
            ours.inconsistent_edges
        ));
    }
    if ours.closed && ours.odd_ray_share != 0.0 {
        wrong.push(format!(
            "{file}: closed, yet {} of the rays are odd",
            ours.odd_ray_share
        ));
    }
    let number = |key: &str| theirs[key].as_f64().unwrap();
    if !close(ours.area, number("area"), VOLUME_AND_AREA) {
        wrong.push(format!(
            "{file}: area {}, not {}",
            ours.area, theirs["area"]
        ));
    }
    // The volume of an open mesh depends on the origin, that of the chair's doubled faces is 0.
    let off = (ours.volume - number("volume")).abs();
    if closed && off > VOLUME_AND_AREA * number("volume").abs().max(1e-12) {
        wrong.push(format!(
            "{file}: volume {}, not {}",
            ours.volume, theirs["volume"]
        ));
    }
    for (ours, key) in [(ours.bounds.min, "bbox_min"), (ours.bounds.max, "bbox_max")] {
        let diagonal: f64 = (0..3)
            .map(|i| {
                let at = |key: &str| theirs[key][i].as_f64().unwrap();
                (at("bbox_max") - at("bbox_min")).powi(2)
            })
            .sum::<f64>()
            .sqrt();
        for (i, c) in ours.iter().enumerate() {
            let theirs = theirs[key][i].as_f64().unwrap();
            if (c - theirs).abs() > BOUNDS * diagonal {
                wrong.push(format!("{file}: {key}[{i}] is {c}, not {theirs}"));
            }
        }
    }
    wrong
}

#[test]
fn facts_agree() {
    let Some(folder) = data() else { return };
    let mut wrong = Vec::new();
    for entry in facts(&folder) {
        let file = entry["file"].as_str().unwrap();
        wrong.extend(differences(file, &load(&folder, file).1, &entry));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn the_comparison_can_fail() {
    let Some(folder) = data() else { return };
    let file = "organic/spot.obj";
    let entry = facts(&folder)
        .into_iter()
        .find(|e| e["file"] == file)
        .unwrap();
    let (loaded, whole) = load(&folder, file);
    assert!(differences(file, &whole, &entry).is_empty());
    let mut torn = loaded.parts[0].mesh.as_ref().clone();
    torn.triangles.pop();
    let said = differences(file, &Topology::new(&torn), &entry);
    for word in ["faces", "boundary", "euler", "closed", "area"] {
        assert!(
            said.iter().any(|s| s.contains(word)),
            "a missing triangle is not noticed: {word}"
        );
    }
}

#[test]
fn assemblies_come_apart() {
    let Some(folder) = data() else { return };
    for (file, parts) in [
        ("assembly/cube_gears.glb", 17),
        ("animated/MorphStressTest.glb", 2),
        ("animated/CesiumMilkTruck.glb", 3),
        ("organic/spot.obj", 1),
    ] {
        let (loaded, _) = load(&folder, file);
        assert_eq!(loaded.parts.len(), parts, "{file}: {:?}", loaded.notes);
    }
    let (gears, _) = load(&folder, "assembly/cube_gears.glb");
    assert!(gears.parts.iter().all(|p| Topology::new(&p.mesh).closed));
    let (truck, _) = load(&folder, "animated/CesiumMilkTruck.glb");
    assert!(
        std::sync::Arc::ptr_eq(&truck.parts[1].mesh, &truck.parts[2].mesh),
        "the wheels are one mesh, shown twice"
    );
}

#[test]
fn what_was_done_is_said() {
    let Some(folder) = data() else { return };
    for (file, words) in [
        (
            "cad/featuretype.stl",
            "288 pairs within 1e-8 of the size closed 576 edges",
        ),
        (
            "large/stanford_dragon.ply.gz",
            "left out 108 triangles with a repeated corner",
        ),
        (
            "organic/stanford_bunny.obj",
            "left out 1,113 vertices that no triangle uses",
        ),
    ] {
        let (loaded, _) = load(&folder, file);
        assert!(
            loaded.notes.iter().any(|n| n.to_string().contains(words)),
            "{file}: {:?}",
            loaded.notes
        );
    }
}

#[test]
fn an_independent_reader_sees_the_same_triangles() {
    let Some(folder) = data() else { return };
    for file in [
        "organic/spot.obj",
        "organic/armadillo.obj",
        "assembly/hull_body.obj",
        "dense/cheese.obj",
    ] {
        let options = tobj::LoadOptions {
            triangulate: true,
            ..tobj::LoadOptions::default()
        };
        let (models, _) = tobj::load_obj(folder.join(file), &options).unwrap();
        let theirs: Vec<[f64; 3]> = models
            .iter()
            .flat_map(|m| {
                let at = |i: &u32| std::array::from_fn(|k| m.mesh.positions[3 * *i as usize + k]);
                m.mesh.indices.iter().map(at)
            })
            .collect();
        let (loaded, _) = load(&folder, file);
        let mesh = &loaded.parts[0].mesh;
        let ours: Vec<[f64; 3]> = mesh
            .triangles
            .iter()
            .flatten()
            .map(|i| mesh.positions[*i as usize].to_array())
            .collect();
        assert!(ours == theirs, "{file}: the corners differ from tobj's");
    }
}
