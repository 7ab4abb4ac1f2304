//! Promise: a host without a file system opens what a disk would give: scene documents and all that they name, from bytes in memory.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use cutaway::scene::Bounds;
use cutaway::{Model, Result};
use cutaway_io::document::{Document, Timeline, section};
use cutaway_io::load::{Assets, Files, Memory};
use glam::DVec3;

use crate::common::command::Scratch;

const SCENE: &str = r#"
[[part]]
name = "bar"
mesh = "../models/bar.gltf"

[[part]]
mesh = "../models/pair.obj"

[[part]]
name = "walker"
mesh = "frames/walk_%02d.obj"
fps = 1

[relief.rock]
image = "../models/../maps/rock.png"

[[cut]]
surfaces = [{ section = "z=50%", relief = "rock", amplitude = "20%" }]

[[cut]]
volume = "bite.obj"
"#;

const GLTF: &str = r#"{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [2, 2, 2]},
{"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}],
"bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 24}],
"buffers": [{"byteLength": 72, "uri": "deep/my%20bar.bin"}]}"#;

const FACES: [[u16; 3]; 4] = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];

/// The buffer of the glTF file: a tetrahedron.
fn buffer(size: f32) -> Vec<u8> {
    let corners = [
        [0.0; 3],
        [size, 0.0, 0.0],
        [0.0, size, 0.0],
        [0.0, 0.0, size],
    ];
    let corners = corners.as_flattened().iter().flat_map(|x| x.to_le_bytes());
    let faces = FACES.as_flattened().iter().flat_map(|i| i.to_le_bytes());
    corners.chain(faces).collect()
}

/// A tetrahedron of an OBJ file, as its `number`th solid.
fn solid(number: usize, size: f64) -> String {
    let corners = format!("v 0 0 0\nv {size} 0 0\nv 0 {size} 0\nv 0 0 {size}\n");
    let face = |f: [u16; 3]| {
        f.map(|i| (usize::from(i) + 4 * number + 1).to_string())
            .join(" ")
    };
    let faces: String = FACES.map(|f| format!("f {}\n", face(f))).concat();
    corners + &faces
}

/// A height map of 2 x 2 texels.
fn image(heights: [u8; 4]) -> Vec<u8> {
    let image = image::GrayImage::from_raw(2, 2, heights.to_vec()).expect("four texels");
    let mut bytes = std::io::Cursor::new(Vec::new());
    let written = image.write_to(&mut bytes, image::ImageFormat::Png);
    written.expect("memory takes it");
    bytes.into_inner()
}

/// All files of the scene by their names.
fn files() -> BTreeMap<&'static str, Vec<u8>> {
    let pair = format!(
        "mtllib pair.mtl\no a\nusemtl red\n{}o b\nusemtl blue\n{}",
        solid(0, 1.0),
        solid(1, 0.5)
    );
    BTreeMap::from([
        ("scenes/scene.toml", SCENE.into()),
        ("scenes/bite.obj", solid(0, 0.25).into()),
        ("scenes/frames/walk_01.obj", solid(0, 1.0).into()),
        ("scenes/frames/walk_02.obj", solid(0, 1.5).into()),
        ("models/bar.gltf", GLTF.into()),
        ("models/deep/my bar.bin", buffer(2.0)),
        ("models/pair.obj", pair.into()),
        (
            "models/pair.mtl",
            "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n".into(),
        ),
        ("maps/rock.png", image([0, 255, 128, 64])),
    ])
}

/// All that is prepared of a scene at two times, what is said of it, and which files were read.
fn all_of(timeline: &Timeline) -> Result<[String; 4]> {
    let at = |time_s| {
        let scene = timeline.at(time_s)?;
        Ok(format!("{scene:?} {:?}", Model::new(&scene).prepared))
    };
    let files: Vec<&Path> = timeline.files().collect();
    let said = [format!("{:?}", timeline.notes()), format!("{files:?}")];
    let [notes, files] = said;
    Ok([at(0.0)?, at(1.0)?, notes, files])
}

/// The scene from files in memory.
fn opened(folder: &Path, files: &BTreeMap<&'static str, Vec<u8>>) -> Result<[String; 4]> {
    let named = files
        .iter()
        .map(|(name, bytes)| (folder.join(name), bytes.clone()));
    let memory = Arc::new(named.collect::<Memory>());
    let document = Document::read_from(&folder.join("scenes/scene.toml"), &*memory)?;
    let mut assets = Assets::from_files(memory);
    document.check(&assets)?;
    all_of(&document.timeline(&mut assets)?)
}

#[test]
fn a_scene_in_memory_is_the_scene_on_disk() {
    let files = files();
    let (folder, on_disk) = {
        let folder = Scratch::new("files");
        for (name, bytes) in &files {
            let path = folder.path(name);
            std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
            folder.write(name, bytes);
        }
        let timeline = Document::read(&folder.path("scenes/scene.toml"))
            .and_then(|document| document.timeline(&mut Assets::default()))
            .unwrap_or_else(|e| panic!("{e}"));
        let read = timeline.files().count();
        assert_eq!(
            read,
            files.len(),
            "{:?}",
            timeline.files().collect::<Vec<_>>()
        );
        let all = all_of(&timeline).unwrap_or_else(|e| panic!("{e}"));
        (folder.path(""), all)
    };
    assert!(!folder.exists(), "nothing is left on disk");
    assert_eq!(
        opened(&folder, &files).unwrap_or_else(|e| panic!("{e}")),
        on_disk
    );
    // What each file says counts.
    for (name, bytes) in [
        ("models/deep/my bar.bin", buffer(1.5)),
        ("models/pair.mtl", b"newmtl red\nKd 0 1 0\n".into()),
        ("maps/rock.png", image([0, 255, 128, 65])),
        ("scenes/frames/walk_02.obj", solid(0, 1.25).into()),
        ("scenes/bite.obj", solid(0, 0.3).into()),
    ] {
        let mut files = files.clone();
        files.insert(name, bytes);
        let all = opened(&folder, &files).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert_ne!(all[1], on_disk[1], "{name}");
    }
}

#[test]
fn what_is_missing_in_memory_is_named() {
    let folder = PathBuf::from("/a folder that is not there");
    let whole = opened(&folder, &files());
    let [_, _, notes, _] = whole.unwrap_or_else(|e| panic!("all files are there: {e}"));
    assert!(!notes.contains("pair.mtl"), "{notes}");
    for name in files().into_keys() {
        let mut files = files();
        files.remove(name);
        let file = Path::new(name)
            .file_name()
            .expect("a name")
            .to_string_lossy();
        match (name, opened(&folder, &files)) {
            // A colour is no reason to stop, and frames end where one is missing.
            ("models/pair.mtl", Ok([_, _, notes, _])) => {
                let message =
                    "material library pair.mtl cannot be read: it is not among the files in memory";
                assert!(notes.contains(message), "{notes}");
            }
            ("scenes/frames/walk_02.obj", Ok([.., files])) => {
                assert!(
                    files.contains("walk_01") && !files.contains("walk_02"),
                    "{files}"
                );
            }
            (_, Ok(_)) => panic!("it opens without {name}"),
            (_, Err(e)) => {
                let message = e.to_string();
                assert!(
                    message.contains(&*file) && message.contains("help:"),
                    "{name}: {message}"
                );
            }
        }
    }
}

#[test]
fn files_are_fetched_as_they_become_known() {
    let all = files();
    let text = SCENE
        .replace("walk_%02d", "walk_01")
        .replace("fps = 1\n", "");
    let document = Document::parse("scenes/scene.toml", &text).expect("a scene");
    let mut memory = Memory::default();
    let mut fetched = Vec::new();
    loop {
        let named = document.files(&memory).into_iter();
        let missing: Vec<PathBuf> = named.filter(|path| !memory.is_file(path)).collect();
        if missing.is_empty() {
            break;
        }
        for path in &missing {
            let name = path
                .to_string_lossy()
                .replace("scenes/../", "")
                .replace("models/../", "");
            let bytes = all
                .get(&*name)
                .unwrap_or_else(|| panic!("{name} is asked for"));
            memory.insert(path, bytes.clone());
        }
        fetched.push(missing.len());
    }
    assert_eq!(fetched, [5, 2], "what the scene names, and what that names");
    let timeline = document.timeline(&mut Assets::from_files(Arc::new(memory)));
    let parts = timeline.map(|t| t.rest().parts.len());
    assert_eq!(parts.unwrap_or_else(|e| panic!("{e}")), 4);
}

#[test]
fn a_clip_surface_takes_its_image_from_memory() {
    let bounds = Bounds::from_points([DVec3::ZERO, DVec3::ONE]);
    let surface = || section("z=50%").relief("rock.png");
    let memory = Memory::from_iter([("rock.png", image([0, 255, 128, 64]))]);
    let surface_of =
        |memory: Memory| surface().on_from(&bounds, &mut Assets::from_files(Arc::new(memory)));
    let relief = surface_of(memory).expect("a surface").relief;
    assert_eq!(relief.map(|map| map.size()), Some([2, 2]));
    for error in [surface_of(Memory::default()), surface().on(&bounds)] {
        let message = error.expect_err("no image").to_string();
        assert!(
            message.contains("rock.png") && message.contains("help:"),
            "{message}"
        );
    }
}
