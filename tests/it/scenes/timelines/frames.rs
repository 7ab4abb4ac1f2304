//! Frame sequences: every frame a mesh of its own.

use std::fmt::Write as _;
use std::path::Path;
use std::sync::Arc;

use cutaway::scene::Mesh;
use cutaway_io::document::{self, Document, cut, section};
use cutaway_io::load::Assets;
use cutaway_io::load::frames::Sequence;
use glam::DVec3;

use super::{Scratch, at, part};
use crate::common::meshes;

/// Meshes as one OBJ file, an object each.
fn obj(meshes: &[Mesh]) -> String {
    let mut text = String::new();
    let mut first = 1;
    for (index, mesh) in meshes.iter().enumerate() {
        let mut line = |l: std::fmt::Arguments<'_>| writeln!(text, "{l}").expect("text grows");
        line(format_args!("o solid{index}"));
        for p in &mesh.positions {
            line(format_args!("v {} {} {}", p.x, p.y, p.z));
        }
        for [a, b, c] in &mesh.triangles {
            line(format_args!("f {} {} {}", a + first, b + first, c + first));
        }
        first += mesh.positions.len() as u32;
    }
    text
}

fn block(size: f64) -> Mesh {
    meshes::block(DVec3::ZERO, DVec3::splat(size))
}

/// A cube, a ball and a torus, from frame 3 on.
fn changing(folder: &Scratch) {
    for (number, shape) in [(3, "cube"), (4, "sphere"), (5, "torus")] {
        let text = obj(&[meshes::shape(shape)]);
        folder.write(&format!("walk_{number:03}.obj"), &text);
    }
}

const SCENE: &str = r#"
[[part]]
name = "walker"
mesh = "walk_%03d.obj"
first = 3
fps = 2
[[part]]
name = "floor"
shape = "cube"
[[cut]]
surfaces = [{ section = "z=50%" }]
applies_to = ["walker"]
"#;

#[test]
fn frames_may_change_in_everything() {
    let folder = Scratch::new("changing");
    changing(&folder);
    let timeline = folder.timeline(SCENE);
    assert_eq!(
        timeline.duration_s(),
        Some(1.5),
        "three frames of two a second"
    );
    let faces = ["cube", "sphere", "torus"].map(|s| meshes::shape(s).triangles.len());
    for (time_s, frame) in [
        (0.0, 0),
        (0.49, 0),
        (0.5, 1),
        (1.0, 2),
        (1.49, 2),
        (1.5, 0),
        (2.0, 1),
        (1e6, 2),
    ] {
        let scene = at(&timeline, time_s);
        let mesh = &part(&scene, "walker").mesh;
        assert_eq!(mesh.triangles.len(), faces[frame], "at {time_s} s");
    }
    let [a, b] = [0.5, 2.2].map(|t| Arc::clone(&part(&at(&timeline, t), "walker").mesh));
    assert!(Arc::ptr_eq(&a, &b), "a frame was made anew");
    let stage = timeline.stage().expect("sound").expect("it moves");
    assert!(
        stage.size().x > 1.3,
        "the torus is wider than the cube: {stage:?}"
    );

    let once = SCENE.replace("fps = 2", "fps = 2\nloop = false");
    let scene = at(&folder.timeline(&once), 99.0);
    let mesh = &part(&scene, "walker").mesh;
    assert_eq!(mesh.triangles.len(), faces[2], "the last frame stays");
}

#[test]
fn a_frame_may_hold_fewer_solids() {
    let folder = Scratch::new("fewer");
    let two = [
        block(1.0),
        meshes::block(DVec3::splat(2.0), DVec3::splat(3.0)),
    ];
    folder.write("f1.obj", obj(&two));
    folder.write("f2.obj", obj(&two[..1]));
    let text = "[[part]]\nname = \"run\"\nmesh = \"f%d.obj\"\nfps = 1\n[[cut]]\nsurfaces = [{ section = \"z=50%\" }]\n\
                applies_to = [\"run/1\"]\n";
    let timeline = folder.timeline(text);
    let names = |time_s: f64| -> Vec<String> {
        let scene = at(&timeline, time_s);
        scene.parts.iter().map(|p| p.name.clone()).collect()
    };
    assert_eq!(names(0.0), ["run/0", "run/1"], "both");
    assert_eq!(names(1.0), ["run/0"], "one");
    let error = folder
        .load(&text.replace("run/1", "run/2"))
        .expect_err("there is none at any time");
    assert!(error.to_string().contains("run/2"), "{error}");
}

#[test]
fn a_gap_is_told() {
    let folder = Scratch::new("gap");
    changing(&folder);
    std::fs::rename(folder.path("walk_005.obj"), folder.path("walk_009.obj"))
        .expect("a frame is moved");
    let file = folder.load(SCENE).expect("two frames are left");
    let notes = crate::common::text_of(file.notes());
    assert!(
        notes.contains("frame 5") && notes.contains("frame 9"),
        "{notes}"
    );
    assert_eq!(file.duration_s(), Some(1.0), "two frames");
}

#[test]
fn sequences_of_the_command_line_join_a_scene() {
    let folder = Scratch::new("join");
    for (number, size) in [(0, 1.0), (1, 2.0)] {
        folder.write(&format!("cube{number}.obj"), obj(&[block(size)]));
    }
    let pattern = folder.path("cube%d.obj").to_string_lossy().into_owned();
    let mut document = Document::new();
    document
        .add_part(document::part("shape:cube"))
        .expect("a shape");
    let frames = document::part(&pattern).with("fps", 10.0);
    document.add_part(frames).expect("two frames");
    document.add_cut(cut([section("z=50%")])).expect("a cut");
    let assets = &mut Assets::default();
    let timeline = document.timeline(assets).expect("a sound scene");
    assert_eq!(timeline.duration_s(), Some(0.2), "two frames");
    let stage = timeline.stage().expect("sound").expect("it moves");
    assert_eq!(stage.max, DVec3::splat(2.0), "the second frame is larger");
    let scene = at(&timeline, 0.1);
    let names: Vec<&str> = scene.parts.iter().map(|p| p.name.as_str()).collect();
    assert_eq!(names, ["cube", "cube_2"], "names differ");
    assert_eq!(scene.cuts.len(), 1, "the cut is there");
    assert_eq!(scene.parts[1].bounds_in_world().max.x, 2.0, "second frame");
    // Every frame begins at its own time, whatever the rate.
    for fps in [23.976, 24.0, 29.97, 30.0, 60.0, 7.0] {
        let sequence = Sequence::open(&pattern, fps, assets).expect("two frames");
        for i in 0..5000 {
            let frame = sequence.frame_at(f64::from(i) / fps);
            assert_eq!(frame, (i % 2) as usize, "frame {i} at {fps} fps");
        }
    }
}

/// What is broken about frames, and what has to be told.
#[test]
fn broken_frames_are_named() {
    let nan = "v 0 0 0\nv 1 0 nan\nv 0 1 0\nf 1 2 3\n";
    for (name, text, phrase) in [
        ("nan", nan, "walk_004.obj"),
        ("empty", "", "walk_004.obj"),
        ("no faces", "v 0 0 0\n", "walk_004.obj"),
    ] {
        let folder = Scratch::new("broken");
        changing(&folder);
        assert!(folder.load(SCENE).is_ok(), "the negative control");
        folder.write("walk_004.obj", text);
        let error = folder.load(SCENE).expect_err(name).to_string();
        assert!(
            error.contains(phrase) && error.contains("help:"),
            "{name}: {error}"
        );
    }
    let folder = Scratch::new("patterns");
    changing(&folder);
    for (intact, broken, culprit, phrase) in [
        ("first = 3", "first = 1", "part.walker.mesh", "walk_001.obj"),
        ("first = 3", "", "part.walker.mesh", "neither"),
        ("first = 3", "first = -3", "part.walker.first", "whole"),
        ("fps = 2", "fps = 0", "part.walker.fps", "above 0"),
        ("fps = 2", "loop = 1", "part.walker.loop", "true or false"),
        (
            "walk_%03d.obj",
            "%d/%d.obj",
            "part.walker.mesh",
            "%d/%d.obj",
        ),
        (
            "shape = \"cube\"",
            "shape = \"cube\"\nfps = 3",
            "part.floor.fps",
            "numbered frames",
        ),
    ] {
        let text = SCENE.replacen(intact, broken, 1);
        let error = folder.load(&text).expect_err(broken).to_string();
        for word in [culprit, phrase, "help:", "scene.toml:"] {
            assert!(
                error.contains(word),
                "`{broken}` does not tell `{word}`:\n{error}"
            );
        }
    }
    for (pattern, fps, phrase) in [
        ("nowhere/%d.ply", 24.0, "nowhere/0.ply"),
        ("walk.ply", 24.0, "no frame-number format"),
    ] {
        let opened = Sequence::open(pattern, fps, &mut Assets::default());
        let error = opened.expect_err(pattern).to_string();
        assert!(error.contains(phrase) && error.contains("help:"), "{error}");
    }
    let pattern = folder.path("walk_00%d.obj");
    assert!(!Path::new(&pattern).exists(), "it is a pattern");
}
