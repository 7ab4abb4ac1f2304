//! Files that commands of the documents name and a reader brings along: small ones of the same names.

use std::fmt::Write as _;

use serde_json::json;

use super::command::Scratch;
use crate::scenes::motions::document::{Document, cube};

/// A scene that has what commands set by `--set`.
const SCENE: &str = "[[part]]\nshape = \"cube\"\n\n[[cut]]\nname = \"front\"\nsurfaces = [{ section = \"-z=50%\" }]\n";

/// Fills a folder.
pub(super) fn fill(folder: &Scratch) {
    for name in ["bracket.stl", "engine.stl", "part.stl"] {
        folder.write(name, stl(&[1.0]));
    }
    // One body within another.
    folder.write("gearbox.stl", stl(&[1.0, 0.5]));
    for name in ["part.ply", "scan.ply"] {
        folder.write(name, ply());
    }
    let walk = walk().text();
    for name in ["engine.glb", "walk.glb"] {
        folder.write(name, &walk);
    }
    let rock = image::GrayImage::from_fn(16, 16, |x, y| image::Luma([(x * y) as u8]));
    rock.save(folder.path("rock.png")).unwrap();
    folder.write("scene.toml", SCENE);
}

/// Cubes with these sides about one middle.
fn stl(sides: &[f32]) -> String {
    let (positions, triangles) = cube();
    let mut text = String::from("solid s\n");
    for side in sides {
        for corners in &triangles {
            text.push_str("facet normal 0 0 0\nouter loop\n");
            for corner in corners {
                let [x, y, z] = positions[*corner as usize].map(|c| (c - 0.5) * side);
                writeln!(text, "vertex {x} {y} {z}").unwrap();
            }
            text.push_str("endloop\nendfacet\n");
        }
    }
    text + "endsolid s\n"
}

/// A cube.
fn ply() -> String {
    let (positions, triangles) = cube();
    let mut text = format!(
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\nelement face {}\n\
         property list uchar int vertex_indices\nend_header\n",
        positions.len(),
        triangles.len()
    );
    for [x, y, z] in &positions {
        writeln!(text, "{x} {y} {z}").unwrap();
    }
    for [a, b, c] in &triangles {
        writeln!(text, "3 {a} {b} {c}").unwrap();
    }
    text
}

/// A cube that the clip `run` moves.
fn walk() -> Document {
    let mut document = Document::new();
    let (positions, triangles) = cube();
    let positions = document.floats(&positions);
    let indices = document.indices(&triangles);
    let primitive = json!({"attributes": {"POSITION": positions}, "indices": indices});
    document.push("meshes", json!({ "primitives": [primitive] }));
    let moved = document.floats(&[[0.0, 0.0, 0.0], [0.0, 0.0, 1.0]]);
    document.clip(0, "translation", "LINEAR", &[0.0, 1.0], moved);
    document.json["animations"][0]["name"] = json!("run");
    document
}
