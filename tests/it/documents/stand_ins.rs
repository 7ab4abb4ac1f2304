//! Files that commands of the documents name and a reader brings along: small ones of the same names.

use cutaway::generate::shapes::shape;
use serde_json::json;

use super::command::Scratch;
use crate::motions::document::{Document, cube};

/// Meshes by name, and the shapes that stand for them.
const MESHES: [(&str, &str); 6] = [
    ("bracket.stl", "shells"),
    ("engine.stl", "gears?teeth=8"),
    ("gearbox.stl", "shells"),
    ("part.stl", "cube"),
    ("part.ply", "cube"),
    ("scan.ply", "cube"),
];

/// A scene that has what commands set by `--set`.
const SCENE: &str = "[[part]]\nshape = \"cube\"\n\n[[cut]]\nname = \"front\"\nsurfaces = [{ section = \"-z=50%\" }]\n";

/// Fills a folder.
pub(super) fn fill(folder: &Scratch) {
    for (name, of) in MESHES {
        assert!(shape(of).is_ok(), "{of}");
        let line = format!("export shape:{of} --section z=1% -o {name} --quiet");
        folder.run(&line).exits(0);
    }
    folder
        .run("export shape:cube --section z=1% -o engine.glb --quiet")
        .exits(0);
    folder.write("walk.glb", walk().text());
    let rock = image::GrayImage::from_fn(16, 16, |x, y| image::Luma([(x * y) as u8]));
    rock.save(folder.path("rock.png")).unwrap();
    folder.write("scene.toml", SCENE);
}

/// A cube that a clip moves.
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
