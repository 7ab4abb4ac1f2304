//! Promise: what other readers take is taken, whole, and what is left out of it is said with its line.

use cutaway_io::load::load_mesh_file;

use super::{Scratch, ascii_ply, ascii_stl, buffer, gltf_json, must_load, obj};

const MARK: &str = "\u{feff}";

#[test]
fn a_byte_order_mark_takes_no_vertex_away() {
    let folder = Scratch::new("mesh");
    folder.write("a b.bin", buffer());
    let gltf = gltf_json(r#"{"byteLength":72,"uri":"a%20b.bin"}"#);
    for (name, text) in [
        ("a.obj", obj()),
        ("a.ply", ascii_ply()),
        ("a.stl", ascii_stl()),
        ("a.gltf", gltf),
    ] {
        let path = folder.write(name, format!("{MARK}{text}").as_bytes());
        must_load(&path);
        let notes = load_mesh_file(&path).unwrap().notes;
        assert!(
            notes.iter().all(|n| !n.to_string().contains("ignored")),
            "{notes:?}"
        );
    }
    folder.write("m.mtl", format!("{MARK}newmtl m\nKd 1 0 0\n").as_bytes());
    let text = format!("{MARK}mtllib m.mtl\nusemtl m\n{}", obj());
    let red = load_mesh_file(&folder.write("red.obj", text.as_bytes())).unwrap();
    assert_eq!(red.parts[0].material.color.to_array(), [1.0, 0.0, 0.0]);
}

#[test]
fn text_in_utf_16_is_refused_by_name() {
    let folder = Scratch::new("mesh");
    let words = format!("{MARK}{}", obj());
    let bytes: Vec<u8> = words.encode_utf16().flat_map(u16::to_le_bytes).collect();
    super::must_be_refused(&folder.write("wide.obj", &bytes), "UTF-16");
}

#[test]
fn a_line_with_an_unknown_first_word_is_told_once() {
    let folder = Scratch::new("mesh");
    let known = format!("o a\ns off\nvt 0 0\nl 1 2\np 1\n{}", obj());
    let path = folder.write("known.obj", known.as_bytes());
    must_load(&path);
    assert_eq!(load_mesh_file(&path).unwrap().notes, []);
    for (word, line) in [("V 1 2 3", 1), ("vertex", 1), ("\u{a0}?", 1)] {
        let text = format!("{word}\n{}{word}\n", obj());
        let path = folder.write("unknown.obj", text.as_bytes());
        must_load(&path);
        let notes = load_mesh_file(&path).unwrap().notes;
        let word = word.split(' ').next().unwrap().trim();
        let [note] = notes.as_slice() else {
            panic!("one note, not {notes:?}");
        };
        for phrase in [&format!("unknown.obj:{line}: "), word, "1 more"] {
            assert!(note.to_string().contains(phrase), "{note} lacks {phrase}");
        }
    }
}

#[test]
fn faces_need_no_normals_and_no_texture() {
    let folder = Scratch::new("mesh");
    let corner = |face: &str| obj().replace("f 1 3 2", face);
    for (face, is_told) in [
        ("f 1/9/ 3/9/ 2/9/", false),
        ("f 1//9 3//9 2//9", true),
        ("f 1/5/-4 3 2", true),
    ] {
        let text = corner(face);
        assert!(text.contains(face), "{face} is in the file");
        let path = folder.write("bare.obj", text.as_bytes());
        must_load(&path);
        let notes = load_mesh_file(&path).unwrap().notes;
        let has_note = notes.iter().any(|n| n.to_string().contains("bare.obj:5: "));
        assert_eq!(has_note, is_told, "{face}: {notes:?}");
    }
}

#[test]
fn a_bare_line_of_a_ply_header_is_a_comment() {
    let folder = Scratch::new("mesh");
    let bare = "Created by Blender3D 2.42, source file: a.blend\n";
    for (name, bytes) in [
        ("a.ply", ascii_ply().into_bytes()),
        ("b.ply", super::binary_ply()),
    ] {
        let at = bytes.windows(7).position(|w| w == b"element").unwrap();
        let with = [&bytes[..at], bare.as_bytes(), &bytes[at..]].concat();
        let path = folder.write(name, &with);
        must_load(&path);
        let notes = load_mesh_file(&path).unwrap().notes;
        assert!(
            notes[0].to_string().contains(&format!("{name}:3: ")),
            "{notes:?}"
        );
    }
}
