//! Promise: a file that is not a mesh is refused with its name, the reason and a mend, and never crashes the program.
//!
//! Every case is written to a folder of its own, next to an intact version of the same file that must load: a loader that
//! refuses everything fails here too.

#![allow(
    clippy::unwrap_used,
    reason = "the helpers of a test fail by panicking, too"
)]

use std::fs;
use std::path::Path;

use command::Scratch;
use cutaway::scene::Topology;
use cutaway_io::load::load_mesh_file;

use crate::common::command;
mod lenient;
mod limits;
mod packages;

/// The corners of a tetrahedron and its triangles, counter-clockwise from outside.
const CORNERS: [[f32; 3]; 4] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
const TRIANGLES: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];

fn obj() -> String {
    let v = CORNERS.map(|[x, y, z]| format!("v {x} {y} {z}\n")).concat();
    v + &TRIANGLES
        .map(|t| format!("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1))
        .concat()
}

fn stl() -> Vec<u8> {
    let mut bytes = vec![b' '; 80];
    bytes.extend((TRIANGLES.len() as u32).to_le_bytes());
    for t in TRIANGLES {
        bytes.extend([0; 12]);
        for c in t.iter().flat_map(|i| CORNERS[*i as usize]) {
            bytes.extend(c.to_le_bytes());
        }
        bytes.extend([0; 2]);
    }
    bytes
}

fn ascii_stl() -> String {
    let facet = |t: [u32; 3]| {
        let vertex = |i: u32| {
            let [x, y, z] = CORNERS[i as usize];
            format!("vertex {x} {y} {z}\n")
        };
        format!(
            "facet normal 0 0 0\nouter loop\n{}endloop\nendfacet\n",
            t.map(vertex).concat()
        )
    };
    format!("solid t\n{}endsolid t\n", TRIANGLES.map(facet).concat())
}

fn ply_header(format: &str, vertices: &str, faces: &str) -> String {
    format!(
        "ply\nformat {format} 1.0\nelement vertex {vertices}\nproperty float x\nproperty float y\nproperty float z\nelement face {faces}\nproperty list uchar int vertex_indices\nend_header\n"
    )
}

fn ascii_ply() -> String {
    let v = CORNERS.map(|[x, y, z]| format!("{x} {y} {z}\n")).concat();
    let f = TRIANGLES
        .map(|t| format!("3 {} {} {}\n", t[0], t[1], t[2]))
        .concat();
    ply_header("ascii", "4", "4") + &v + &f
}

fn binary_ply() -> Vec<u8> {
    let mut bytes = ply_header("binary_little_endian", "4", "4").into_bytes();
    bytes.extend(CORNERS.iter().flatten().flat_map(|c| c.to_le_bytes()));
    for t in TRIANGLES {
        bytes.push(3);
        bytes.extend(t.iter().flat_map(|i| i.to_le_bytes()));
    }
    bytes
}

/// Positions, then indices: 48 and 24 bytes.
fn buffer() -> Vec<u8> {
    let positions = CORNERS.iter().flatten().flat_map(|c| c.to_le_bytes());
    let indices = TRIANGLES
        .iter()
        .flatten()
        .flat_map(|i| (*i as u16).to_le_bytes());
    positions.chain(indices).collect()
}

fn gltf_json(buffer: &str) -> String {
    format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],
"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],
"accessors":[{{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,1]}},
{{"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}}],
"bufferViews":[{{"buffer":0,"byteLength":48}},{{"buffer":0,"byteOffset":48,"byteLength":24}}],
"buffers":[{buffer}]}}"#
    )
}

fn glb(json: &str, buffer: &[u8]) -> Vec<u8> {
    let mut json = json.as_bytes().to_vec();
    json.resize(json.len().next_multiple_of(4), b' ');
    let length = 12 + 8 + json.len() + 8 + buffer.len();
    let mut bytes = b"glTF\x02\0\0\0".to_vec();
    bytes.extend((length as u32).to_le_bytes());
    bytes.extend((json.len() as u32).to_le_bytes());
    bytes.extend(b"JSON");
    bytes.extend(json);
    bytes.extend((buffer.len() as u32).to_le_bytes());
    bytes.extend(b"BIN\0");
    bytes.extend(buffer);
    bytes
}

fn whole_glb() -> Vec<u8> {
    glb(&gltf_json(r#"{"byteLength":72}"#), &buffer())
}

fn gzipped(bytes: &[u8]) -> Vec<u8> {
    use std::io::Write;
    let mut packed = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    packed.write_all(bytes).unwrap();
    packed.finish().unwrap()
}

fn must_load(path: &Path) {
    let loaded = load_mesh_file(path).unwrap_or_else(|e| panic!("intact, but refused: {e}"));
    let facts = Topology::from_parts(&loaded.parts);
    assert!(
        facts.closed && facts.vertices == 4 && (facts.volume - 1.0 / 6.0).abs() < 1e-6,
        "{}: {facts:?}",
        path.display()
    );
}

fn must_be_refused(path: &Path, word: &str) {
    let said = match load_mesh_file(path) {
        Ok(loaded) => panic!("{} loads: {:?}", path.display(), loaded.notes),
        Err(e) => e.to_string(),
    };
    let name = path.file_name().unwrap().to_string_lossy().into_owned();
    assert!(said.contains(&name), "names no file: {said}");
    assert!(said.contains("help:"), "tells no help: {said}");
    assert!(said.contains(word), "does not say `{word}`: {said}");
}

#[test]
fn intact_files_load() {
    let folder = Scratch::new("hostile");
    for (name, bytes) in [
        ("a.obj", obj().into_bytes()),
        ("a.STL", stl()),
        ("b.stl", ascii_stl().into_bytes()),
        ("a.ply", ascii_ply().into_bytes()),
        ("b.ply", binary_ply()),
        ("a.glb", whole_glb()),
        ("a.obj.gz", gzipped(obj().as_bytes())),
        ("a.stl.gz", gzipped(&stl())),
        ("a.ply.gz", gzipped(&binary_ply())),
        (
            "a.gltf",
            gltf_json(r#"{"byteLength":72,"uri":"a%20b.bin"}"#).into_bytes(),
        ),
    ] {
        folder.write("a b.bin", buffer());
        must_load(&folder.write(name, &bytes));
    }
}

#[test]
fn files_that_are_not_there_or_not_meshes() {
    let folder = Scratch::new("hostile");
    must_be_refused(&folder.path("missing.obj"), "cannot be read");
    must_be_refused(&folder.write("model.step", b"ISO-10303-21;"), "`.step`");
    must_be_refused(&folder.write("model.stk", b"x"), "did you mean `stl`");
    must_be_refused(&folder.write("model", b"x"), "extension");
    must_be_refused(&folder.write("a.glb.gz", gzipped(&whole_glb())), "gzipped");
    let sub = folder.path("folder.obj");
    fs::create_dir(&sub).unwrap();
    must_be_refused(&sub, "cannot be read");
    for extension in ["obj", "stl", "ply", "glb", "gltf", "3mf"] {
        must_be_refused(&folder.write(&format!("empty.{extension}"), b""), "empty");
        let noise: Vec<u8> = (0..999_u32)
            .map(|i| (i.wrapping_mul(2_654_435_761) >> 13) as u8)
            .collect();
        must_be_refused(&folder.write(&format!("noise.{extension}"), &noise), "");
    }
    let packed = gzipped(obj().as_bytes());
    must_be_refused(
        &folder.write("cut.obj.gz", &packed[..packed.len() - 9]),
        "gzip",
    );
}

#[test]
fn hostile_obj() {
    let folder = Scratch::new("hostile");
    let whole = obj();
    for (name, text, word) in [
        ("nan", whole.replacen("v 1", "v nan", 1), ":2: "),
        ("inf", whole.replacen("v 1", "v inf", 1), "inf"),
        ("huge", whole.replacen("v 1", "v 1e999", 1), "1e999"),
        ("range", whole.replacen("f 1", "f 9", 1), ":5: "),
        ("zero", whole.replacen("f 1", "f 0", 1), "vertex 0"),
        ("negative", whole.replacen("f 1", "f -5", 1), "vertex -5"),
        ("word", whole.replacen("f 1", "f one", 1), "`one`"),
        ("cut", whole[..whole.len() - 5].to_owned(), ":8: "),
        (
            "points",
            whole.lines().take(4).collect::<Vec<_>>().join("\n"),
            "no triangles",
        ),
        (
            "flat",
            "v 0 0 0\nv 1 0 0\nf 1 1 2\n".to_owned(),
            "no triangles",
        ),
    ] {
        must_be_refused(&folder.write(&format!("{name}.obj"), text.as_bytes()), word);
    }
}

#[test]
fn odd_obj_that_is_well_formed_loads() {
    let folder = Scratch::new("hostile");
    // Kd with one number, a library that is missing, and Latin-1 in a comment.
    folder.write("odd.mtl", b"newmtl m\nKd 0.5\nnewmtl n\nKd 1 0 0\n");
    let mut bytes = b"# \xe9\nmtllib odd.mtl gone.mtl\nusemtl n\n".to_vec();
    bytes.extend(obj().bytes());
    let path = folder.write("odd.obj", &bytes);
    must_load(&path);
    let loaded = load_mesh_file(&path).unwrap();
    assert_eq!(loaded.parts[0].material.color.to_array(), [1.0, 0.0, 0.0]);
    assert!(
        loaded
            .notes
            .iter()
            .any(|n| n.to_string().contains("gone.mtl")),
        "{:?}",
        loaded.notes
    );
    must_load(&folder.write("crlf.obj", obj().replace('\n', "\r\n").as_bytes()));
}

#[test]
fn hostile_stl() {
    let folder = Scratch::new("hostile");
    let whole = stl();
    must_be_refused(
        &folder.write("cut.stl", &whole[..whole.len() - 1]),
        "states 4 triangles, but the file has 3",
    );
    must_be_refused(&folder.write("header.stl", &whole[..50]), "header of 84");
    let mut huge = whole.clone();
    huge[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
    must_be_refused(&folder.write("huge.stl", &huge), "4,294,967,295");
    let mut none = whole[..84].to_vec();
    none[80..84].copy_from_slice(&0_u32.to_le_bytes());
    must_be_refused(&folder.write("none.stl", &none), "no triangles");
    let mut nan = whole;
    nan[96..100].copy_from_slice(&f32::NAN.to_le_bytes());
    must_be_refused(&folder.write("nan.stl", &nan), "NaN");
    let text = ascii_stl();
    must_be_refused(
        &folder.write("text.stl", &text.as_bytes()[..text.len() / 2]),
        "t.stl:",
    );
    must_be_refused(
        &folder.write(
            "word.stl",
            text.replacen("vertex 1", "vertex x", 1).as_bytes(),
        ),
        "`x`",
    );
    must_be_refused(
        &folder.write(
            "corner.stl",
            text.replacen("vertex 0 0 0\n", "", 1).as_bytes(),
        ),
        "2 corners",
    );
}

#[test]
fn hostile_ply() {
    let folder = Scratch::new("hostile");
    let (text, bytes) = (ascii_ply(), binary_ply());
    let mut infinite = bytes.clone();
    let first = ply_header("binary_little_endian", "4", "4").len();
    infinite[first..first + 4].copy_from_slice(&f32::NEG_INFINITY.to_le_bytes());
    for (name, bytes, word) in [
        (
            "cut",
            bytes[..bytes.len() - 1].to_vec(),
            "after 3 of 4 `face`",
        ),
        ("header", bytes[..60].to_vec(), ""),
        ("lines", text[..text.len() - 9].into(), ""),
        (
            "nan",
            text.replacen("1 0 0", "nan 0 0", 1).into(),
            ":11: `nan 0 0`",
        ),
        ("infinite", infinite, "vertex 0 has the coordinate -inf"),
        (
            "range",
            text.replacen("3 0 2 1", "3 0 2 9", 1).into(),
            "vertex 9",
        ),
        (
            "negative",
            text.replacen("3 0 2 1", "3 0 2 -1", 1).into(),
            "vertex -1",
        ),
        (
            "word",
            text.replacen("3 0 2 1", "3 0 2 x", 1).into(),
            ":14: ",
        ),
        (
            "more",
            ply_header("binary_big_endian", "4000000000", "4000000000").into(),
            "after 0 of 4000000000 `vertex`",
        ),
        (
            "list",
            text.replacen("3 0 2 1", "4000000000 0 2 1", 1).into(),
            ":14: ",
        ),
        ("xyz", text.replace("float z", "float w").into(), "lacks z"),
        (
            "cloud",
            ply_header("ascii", "1", "0")
                .replace("end_header\n", "end_header\n0 0 0\n")
                .into(),
            "no faces",
        ),
        ("format", text.replace("ascii", "utf-8").into(), ":2: "),
    ] {
        must_be_refused(&folder.write(&format!("{name}.ply"), &bytes), word);
    }
}

#[test]
fn hostile_gltf() {
    let folder = Scratch::new("hostile");
    let whole = whole_glb();
    must_be_refused(&folder.write("cut.glb", &whole[..whole.len() - 1]), "bytes");
    must_be_refused(&folder.write("header.glb", &whole[..10]), "header");
    let mut tiny = whole.clone();
    tiny[8..12].copy_from_slice(&3_u32.to_le_bytes());
    must_be_refused(&folder.write("tiny.glb", &tiny), "length of 3");
    let mut one = whole;
    one[4] = 1;
    must_be_refused(&folder.write("one.glb", &one), "version is 1");
    let json = gltf_json(r#"{"byteLength":72}"#);
    for (name, from, to, word) in [
        (
            "count",
            r#""count":4"#,
            r#""count":4000000000"#,
            "accessor 0",
        ),
        ("none", r#""count":12"#, r#""count":0"#, "accessor 1"),
        ("thirds", r#""count":12"#, r#""count":11"#, "index count 11"),
        ("type", r#""type":"VEC3""#, r#""type":"VEC2""#, ""),
        (
            "float",
            r#""componentType":5123"#,
            r#""componentType":5126"#,
            "accessor 1",
        ),
        (
            "view",
            r#""byteLength":24"#,
            r#""byteLength":23"#,
            "accessor 1",
        ),
        (
            "offset",
            r#""byteOffset":48"#,
            r#""byteOffset":18446744073709551615"#,
            "",
        ),
        (
            "stride",
            r#""byteLength":48"#,
            r#""byteStride":4,"byteLength":48"#,
            "",
        ),
        ("mesh", r#"{"mesh":0}"#, r#"{"mesh":7}"#, ""),
        (
            "cycle",
            r#"{"mesh":0}"#,
            r#"{"mesh":0,"children":[0]}"#,
            "node 0",
        ),
        (
            "spin",
            r#"{"mesh":0}"#,
            r#"{"mesh":0,"rotation":[0,0,0,0]}"#,
            "not finite",
        ),
        (
            "lines",
            r#""indices":1"#,
            r#""indices":1,"mode":1"#,
            "no node",
        ),
        ("empty", r#"{"mesh":0}"#, r#"{"name":"a"}"#, "no node"),
        (
            "buffer",
            r#"{"byteLength":72}"#,
            r#"{"byteLength":99}"#,
            "72 of 99",
        ),
        (
            "draco",
            r#""scene":0"#,
            r#""scene":0,"extensionsUsed":["X"],"extensionsRequired":["X"]"#,
            "",
        ),
        (
            "sparse",
            r#""count":4,"#,
            r#""count":4,"sparse":{"count":9,"indices":{"bufferView":1,"componentType":5123},"values":{"bufferView":0}},"#,
            "sparse",
        ),
    ] {
        assert!(json.contains(from), "{name} changes nothing");
        let bytes = glb(&json.replacen(from, to, 1), &buffer());
        must_be_refused(&folder.write(&format!("{name}.glb"), &bytes), word);
    }
    let mut nan = buffer();
    nan[..4].copy_from_slice(&f32::NAN.to_le_bytes());
    must_be_refused(&folder.write("nan.glb", glb(&json, &nan)), "NaN");
    let mut range = buffer();
    range[48..50].copy_from_slice(&9_u16.to_le_bytes());
    must_be_refused(&folder.write("range.glb", glb(&json, &range)), "vertex 9");
    for (name, uri, word) in [
        ("gone", "gone.bin", "gone.bin"),
        ("web", "https://example.org/a.bin", "nothing is fetched"),
        ("data", "data:application/octet-stream;base64,!!", "base64"),
    ] {
        let text = gltf_json(&format!(r#"{{"byteLength":72,"uri":"{uri}"}}"#));
        must_be_refused(
            &folder.write(&format!("{name}.gltf"), text.as_bytes()),
            word,
        );
    }
}

#[test]
fn no_prefix_of_any_file_crashes() {
    let folder = Scratch::new("hostile");
    for (extension, bytes) in [
        ("obj", obj().into_bytes()),
        ("stl", stl()),
        ("stl", ascii_stl().into_bytes()),
        ("ply", ascii_ply().into_bytes()),
        ("ply", binary_ply()),
        ("glb", whole_glb()),
    ] {
        for length in 0..bytes.len() {
            let path = folder.write(&format!("prefix.{extension}"), &bytes[..length]);
            // Only a text may happen to be whole without its last characters.
            if let Err(e) = load_mesh_file(&path) {
                assert!(e.to_string().contains("help:"), "{e}");
            } else {
                assert!(
                    matches!(extension, "obj" | "stl" | "ply"),
                    "{length} bytes of {extension} load"
                );
            }
        }
    }
}

#[test]
fn no_changed_byte_crashes() {
    let folder = Scratch::new("hostile");
    for (extension, bytes) in [
        ("obj", obj().into_bytes()),
        ("stl", stl()),
        ("ply", ascii_ply().into_bytes()),
        ("ply", binary_ply()),
        ("glb", whole_glb()),
    ] {
        for at in 0..bytes.len() {
            for new in [0, 0xff, b'9', b'-'] {
                let mut changed = bytes.clone();
                changed[at] = new;
                let path = folder.write(&format!("changed.{extension}"), &changed);
                // Many changes leave a mesh, if another one; what matters is that this returns.
                let _ = load_mesh_file(&path);
            }
        }
    }
}
