//! Promise: `-` is a model from standard input, whose format is found in its content; what cannot be so is refused with what helps.

use std::io::Write;
use std::process::Stdio;

use crate::common::command::{Ran, Scratch};

const OBJ: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";

/// Runs the command with bytes on its standard input.
fn run(folder: &Scratch, line: &str, bytes: &[u8]) -> Ran {
    let mut command = folder.command(line);
    command
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    let mut child = command.spawn().expect("the command starts");
    let mut stdin = child.stdin.take().expect("a pipe");
    let bytes = bytes.to_vec();
    // What is refused before it is read breaks the pipe.
    let writer = std::thread::spawn(move || stdin.write_all(&bytes));
    let output = child.wait_with_output().expect("the command ends");
    let _ = writer.join().expect("a thread");
    Ran::of(line, output)
}

fn gzipped(bytes: &[u8]) -> Vec<u8> {
    let mut packed = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    packed.write_all(bytes).expect("memory");
    packed.finish().expect("memory")
}

#[test]
fn every_format_is_known_by_its_content() {
    let folder = Scratch::new("stdin");
    folder.write("t.obj", OBJ);
    let mut models = vec![("obj", OBJ.as_bytes().to_vec())];
    for format in ["stl", "ply", "glb", "3mf"] {
        folder
            .run(&format!("export t.obj --section z=50% -o t.{format}"))
            .exits(0);
        let bytes = std::fs::read(folder.path(&format!("t.{format}"))).expect("a model");
        models.push((format, bytes));
    }
    let ascii = "solid t\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 1 0 0\nendloop\nendfacet\nendsolid t\n";
    for (format, bytes) in &models {
        for bytes in [bytes.clone(), gzipped(bytes)] {
            let facts = run(&folder, "inspect - --json -", &bytes).exits(0).json();
            assert_eq!(facts["parts"][0]["name"], "stdin", "{format}");
            assert_eq!(facts["total"]["faces"], 4, "{format}: {facts}");
            assert_eq!(facts["total"]["closed"], true, "{format}: {facts}");
        }
    }
    let facts = run(&folder, "inspect - --json -", ascii.as_bytes())
        .exits(0)
        .json();
    assert_eq!(facts["total"]["faces"], 1, "{facts}");
}

#[test]
fn commands_draw_and_cut_it_beside_other_models() {
    let folder = Scratch::new("stdin");
    let obj = OBJ.as_bytes();
    run(
        &folder,
        "render - shape:cube --section x=50% --resolution 64,48 -o a.png",
        obj,
    )
    .exits(0);
    run(&folder, "render - --resolution 64,48 -o - --quiet", obj).exits(0);
    let section = run(&folder, "section - --section z=50% --json -", obj)
        .exits(0)
        .json();
    let area = section["sections"][0]["area"].as_f64().expect("an area");
    assert!((area - 0.125).abs() < 1e-12, "{section}");
    run(&folder, "export - --section z=50% -o half.stl", obj).exits(0);
    // The sweep asks for the bounds of the model before anything is drawn.
    let sweep = "animate - --sweep z=10%:90% --frames 2 --resolution 32,32 -o %d.png";
    run(&folder, sweep, obj).exits(0);
    assert_eq!(folder.files(), ["1.png", "2.png", "a.png", "half.stl"]);
}

#[test]
fn numbered_frames_of_another_model_are_drawn_anew() {
    let folder = Scratch::new("stdin");
    let line = "animate - --section z=50% --turntable --frames 2 --resolution 32,32 -o %d.png";
    let frame = || std::fs::read(folder.path("1.png")).expect("a frame");
    run(&folder, line, OBJ.as_bytes()).exits(0);
    let first = frame();
    let other = OBJ.replace("v 0 0 1", "v 0 0 3");
    run(&folder, line, other.as_bytes()).exits(0);
    assert_ne!(first, frame());
}

#[test]
fn what_cannot_be_is_refused_with_help() {
    let folder = Scratch::new("stdin");
    let obj = OBJ.as_bytes();
    for (line, bytes, said) in [
        (
            "inspect - -",
            obj,
            &["standard input can be read once", "help:"][..],
        ),
        (
            "inspect -",
            b"",
            &["nothing came from standard input", "help:"],
        ),
        (
            "inspect -",
            b"ISO-10303-21;\nHEADER;\n",
            &["cannot be recognised", "--input-format stl"],
        ),
        ("inspect - --input-format ply", obj, &["stdin.ply", "help:"]),
        (
            "inspect shape:cube --input-format ply",
            b"",
            &["--input-format ply", "give `-`"],
        ),
        (
            "plan - --save kept.toml",
            obj,
            &[
                "--save kept.toml",
                "standard input",
                "save the model to a file",
            ],
        ),
        ("view -", obj, &["a window", "save the model to a file"]),
        ("inspect - scene.toml", obj, &["a scene file stands alone"]),
    ] {
        run(&folder, line, bytes).must_refuse(said);
    }
    let none = run(&folder, "inspect - --input-format step", obj)
        .exits(2)
        .stderr;
    assert!(
        none.contains("say one of obj, stl, ply, glb, gltf, 3mf"),
        "{none}"
    );
    let gltf = r#"{"asset":{"version":"2.0"},"buffers":[{"byteLength":4,"uri":"a.bin"}]}"#;
    folder.write("a.bin", "abcd");
    run(&folder, "inspect -", gltf.as_bytes()).must_refuse(&["a.bin", "no files beside it"]);
    let packed = gzipped(obj);
    run(&folder, "inspect -", &packed[..packed.len() - 9]).must_refuse(&["gzip", "help:"]);
    assert_eq!(folder.files(), ["a.bin"], "nothing is written");
}

#[test]
fn a_format_that_is_named_is_taken() {
    let folder = Scratch::new("stdin");
    // Comments alone say nothing in their first lines.
    let odd = format!("call a.obj\n{OBJ}");
    run(&folder, "inspect -", odd.as_bytes()).must_refuse(&["--input-format"]);
    let facts = run(
        &folder,
        "inspect - --input-format OBJ --json -",
        odd.as_bytes(),
    );
    assert_eq!(facts.exits(0).json()["total"]["faces"], 4);
}
