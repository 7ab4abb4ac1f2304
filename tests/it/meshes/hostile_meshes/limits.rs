//! Promise: what is no file, leads out of its folder, unpacks without end or lies beyond all numbers is refused by name; and what many
//! parts have alike is said once.

use cutaway_io::load::load_mesh_file;

use super::{Scratch, buffer, gltf_json, gzipped, must_be_refused, must_load, obj, stl};
use std::fs;
use std::io::Write;

#[test]
fn a_buffer_is_a_file_of_the_models_folder_or_below() {
    let folder = Scratch::new("mesh");
    for below in ["model/deep/er", "model-too"] {
        fs::create_dir_all(folder.path(below)).unwrap();
    }
    for place in [
        "a.bin",
        "model-too/a.bin",
        "model/a b.bin",
        "model/deep/er/a.bin",
    ] {
        folder.write(place, buffer());
    }
    let with = |uri: &str| {
        let text = gltf_json(&format!(r#"{{"byteLength":72,"uri":"{uri}"}}"#));
        folder.write("model/m.gltf", text.as_bytes())
    };
    for uri in ["a%20b.bin", "deep/er/a.bin", "./deep/../a b.bin"] {
        must_load(&with(uri));
    }
    let absolute = folder.path("a.bin").to_string_lossy().into_owned();
    for (uri, word) in [
        ("../a.bin", "leads out"),
        ("%2e%2e/a.bin", "leads out"),
        ("..%2Fa.bin", "leads out"),
        ("deep/../../a.bin", "leads out"),
        ("..\\\\a.bin", "leads out"),
        ("../model-too/a.bin", "leads out"),
        (absolute.as_str(), "absolute"),
        ("%2Fetc%2Fpasswd", "absolute"),
        ("file:a.bin", "scheme"),
        ("file:///etc/passwd", "scheme"),
        ("https://example.org/a.bin", "nothing is fetched"),
    ] {
        must_be_refused(&with(uri), word);
    }
}

#[cfg(unix)]
#[test]
fn a_link_leads_out_of_no_folder() {
    let folder = Scratch::new("mesh");
    fs::create_dir_all(folder.path("model")).unwrap();
    for place in ["a.bin", "model/own.bin"] {
        folder.write(place, buffer());
    }
    let link = |to: &str, name: &str| std::os::unix::fs::symlink(to, folder.path(name)).unwrap();
    link("../a.bin", "model/out.bin");
    link("own.bin", "model/in.bin");
    link("..", "model/up");
    let with = |uri: &str| {
        let text = gltf_json(&format!(r#"{{"byteLength":72,"uri":"{uri}"}}"#));
        folder.write("model/m.gltf", text.as_bytes())
    };
    must_load(&with("in.bin"));
    for uri in ["out.bin", "up/a.bin"] {
        must_be_refused(&with(uri), "link");
    }
    // A link to a model takes the files beside the model along.
    with("own.bin");
    link("model/m.gltf", "linked.gltf");
    link("model/own.bin", "own.bin");
    must_load(&folder.path("linked.gltf"));
}

#[cfg(unix)]
#[test]
fn devices_pipes_and_folders_are_refused_by_name() {
    let folder = Scratch::new("mesh");
    let fifo = folder.path("pipe.obj");
    let made = std::process::Command::new("mkfifo").arg(&fifo).status();
    assert!(made.unwrap().success());
    must_be_refused(&fifo, "pipe");
    fs::create_dir(folder.path("folder.ply")).unwrap();
    must_be_refused(&folder.path("folder.ply"), "folder");
    std::os::unix::fs::symlink("/dev/zero", folder.path("zero.stl")).unwrap();
    must_be_refused(&folder.path("zero.stl"), "device");
    // What a model names is looked at like the model.
    std::os::unix::fs::symlink("/dev/zero", folder.path("zero.mtl")).unwrap();
    let path = folder.write("m.obj", format!("mtllib zero.mtl\n{}", obj()).as_bytes());
    let notes = load_mesh_file(&path).unwrap().notes;
    assert!(
        notes[0].to_string().contains("zero.mtl") && notes[0].to_string().contains("device"),
        "{notes:?}"
    );
}

#[test]
fn what_unpacks_to_hundreds_of_times_its_size_is_refused() {
    let folder = Scratch::new("mesh");
    // The control: little may pack as well as it likes.
    let spaces = " ".repeat(1 << 20);
    must_load(&folder.write(
        "spaces.obj.gz",
        gzipped(format!("{}#{spaces}", obj()).as_bytes()),
    ));
    let mut bomb = obj().into_bytes();
    bomb.resize(65 << 20, b'\n');
    let mut packed = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::best());
    packed.write_all(&bomb).unwrap();
    let packed = packed.finish().unwrap();
    assert!(packed.len() * 250 < bomb.len(), "{} bytes", packed.len());
    must_be_refused(
        &folder.write("bomb.obj.gz", &packed),
        "unpacks to more than",
    );
}

#[test]
fn coordinates_beyond_all_products_are_refused() {
    let folder = Scratch::new("mesh");
    let scaled = |by: &str| obj().replace("v 1", &format!("v 1{by}"));
    // The controls: far more than anybody needs.
    for by in ["e30", "e99", "e-30"] {
        load_mesh_file(&folder.write("far.obj", scaled(by).as_bytes())).unwrap();
    }
    for by in ["e101", "e155", "e300"] {
        must_be_refused(
            &folder.write("far.obj", scaled(by).as_bytes()),
            "reaches to 1e",
        );
    }
    let text: String = obj()
        .lines()
        .map(|line| match line.strip_prefix("v ") {
            Some(v) => format!("v {}\n", v.replace('1', "1e-160")),
            None => format!("{line}\n"),
        })
        .collect();
    must_be_refused(&folder.write("tiny.obj", text.as_bytes()), "wide");
}

#[test]
fn many_open_parts_are_one_note() {
    let folder = Scratch::new("mesh");
    let mut text = String::new();
    for part in 0..19 {
        let offset = 4 * part;
        text.push_str(&format!("o part{part}\n"));
        for [x, y, z] in super::CORNERS {
            text.push_str(&format!("v {} {y} {z}\n", x + 3.0 * part as f32));
        }
        // Closed, or without two faces, or without one.
        let faces = match part {
            7 => 2,
            p if p % 2 == 0 => 3,
            _ => 4,
        };
        for t in &super::TRIANGLES[..faces] {
            let [a, b, c] = t.map(|i| i + offset + 1);
            text.push_str(&format!("f {a} {b} {c}\n"));
        }
    }
    let loaded = load_mesh_file(&folder.write("many.obj", text.as_bytes())).unwrap();
    let [note] = loaded.notes.as_slice() else {
        panic!("one note, not {:?}", loaded.notes);
    };
    for phrase in [
        "many.obj: 19 parts, 11 open (worst: part7, 4 open edges)",
        "inspect",
    ] {
        assert!(note.to_string().contains(phrase), "{note}");
    }
    // The control: of one part it is said where.
    let open = stl();
    let one = [&open[..80], &[3, 0, 0, 0], &open[84..84 + 150]].concat();
    let notes = load_mesh_file(&folder.write("one.stl", &one))
        .unwrap()
        .notes;
    assert!(
        notes.last().unwrap().to_string().contains("one near ("),
        "{notes:?}"
    );
}
