//! STL, OBJ and PLY as text: lines by CR alone, blank lines, all on one line; PLY with strips and with lists of other types and names.

use super::*;
use command::Scratch;

fn obj() -> String {
    let vertices = CORNERS.map(|[x, y, z]| format!("v {x} {y} {z}\n")).concat();
    let faces = QUADS.map(|q| {
        let [a, b, c, d] = q.map(|i| i + 1);
        format!("f {a} {b} {c} {d}\n")
    });
    vertices + &faces.concat()
}

fn stl() -> String {
    let facets: String = triangles()
        .map(|t| {
            let vertices = t.map(|i| {
                let [x, y, z] = CORNERS[usize::from(i)];
                format!("      vertex {x}.0 {y}.0 {z}e0\n")
            });
            format!(
                "  facet normal 0 0 0\n    outer loop\n{}    endloop\n  endfacet\n",
                vertices.concat()
            )
        })
        .collect();
    format!("solid a box\n{facets}endsolid a box\n")
}

const VERTICES: &str = "element vertex 8\nproperty float x\nproperty float y\nproperty float z\n";

fn ply(list: &str) -> String {
    let vertices = CORNERS.map(|[x, y, z]| format!("{x} {y} {z}\n")).concat();
    let faces = QUADS.map(|[a, b, c, d]| format!("4 {a} {b} {c} {d}\n"));
    format!(
        "ply\nformat ascii 1.0\n{VERTICES}element face 6\nproperty {list}\nend_header\n{vertices}{}",
        faces.concat()
    )
}

#[track_caller]
fn must_be_read(name: &str, text: &str, count: usize, what: &str) -> Loaded {
    let folder = Scratch::new("foreign-text");
    let loaded = open(&folder.write(name, text));
    must_be_cubes(&loaded, count, what);
    loaded
}

#[test]
fn lines_may_end_by_cr_alone() {
    let list = "list uchar int vertex_indices";
    for (name, text) in [("a.stl", stl()), ("a.obj", obj()), ("a.ply", ply(list))] {
        must_be_read(name, &text.replace('\n', "\r"), 1, name);
        must_be_read(name, &text.replace('\n', "\r\n"), 1, name);
    }
    let folder = Scratch::new("foreign-text");
    folder.write("m.mtl", "newmtl m\rKd 1 0 0\r");
    let text = format!("# by hand\nmtllib m.mtl\nusemtl m\n{}", obj()).replace('\n', "\r");
    let loaded = open(&folder.write("red.obj", text));
    assert_eq!(loaded.parts[0].material.color.to_array(), [1.0, 0.0, 0.0]);
}

#[test]
fn an_stl_may_be_one_line_or_have_breaks_anywhere() {
    let one = must_be_read("a.stl", &stl().replace('\n', " "), 1, "one line");
    assert_eq!(one.notes.len(), 1, "it is welded: {:?}", one.notes);
    must_be_read("a.stl", &stl().replace(".0 ", ".0\n"), 1, "a number a line");
    must_be_read("a.stl", &stl().replace('\n', "\n\n\t\n"), 1, "blank lines");
    // Two solids on one line, the second with a name of its own.
    let two = stl()
        + &stl()
            .replace("a box", "lid")
            .replace("0.0 ", "9.0 ")
            .replace("1.0 ", "10.0 ");
    for text in [two.clone(), two.replace('\n', " ")] {
        let loaded = must_be_read("two.stl", &text, 2, "two solids");
        let names: Vec<&str> = loaded.parts.iter().map(|p| p.name.as_str()).collect();
        assert_eq!(names, ["a box", "lid"], "{text:.40}");
    }
}

#[test]
fn words_of_an_stl_in_names_are_names() {
    let text = stl().replace("a box", "outer vertex ring");
    let loaded = must_be_read(
        "a.stl",
        &(text.clone() + &text.replace("ring", "facet")),
        2,
        "odd names",
    );
    assert_eq!(loaded.parts[0].name, "outer vertex ring");
}

#[test]
fn damage_in_an_stl_is_still_found() {
    let folder = Scratch::new("foreign-text");
    for (from, to, words) in [
        ("vertex 1.0 1.0 0e0", "vertex 1.0 1.0", "2 of 3"),
        ("vertex 1.0 1.0 0e0", "vertex 1.0 1.0 x", "`x`"),
        ("  endfacet\n", "  endfacet\nfacit\n", "`facit`"),
        ("endsolid", "", "`a`"),
    ] {
        let text = stl().replacen(from, to, 1);
        assert_ne!(text, stl(), "{from} is there");
        let said = load_mesh_file(&folder.write("a.stl", text)).expect_err(words);
        assert!(said.to_string().contains(words), "{said}");
    }
}

#[test]
fn a_ply_may_have_blank_lines_and_any_breaks() {
    let text = ply("list uchar int vertex_indices");
    must_be_read(
        "a.ply",
        &text.replace("end_header\n", "end_header\n\n"),
        1,
        "a blank line",
    );
    let (header, payload) = text.split_once("end_header\n").unwrap();
    for (what, payload) in [
        ("one line", payload.replace('\n', " ")),
        ("a number a line", payload.replace([' ', '\n'], "\n")),
        ("blank lines", payload.replace('\n', "\n \n")),
    ] {
        must_be_read("a.ply", &format!("{header}end_header\n{payload}"), 1, what);
    }
    // A number too many shifts all that follow: it is found, and its line said.
    let folder = Scratch::new("foreign-text");
    let odd = text.replacen("4 0 3 2 1\n", "4 0 3 2\n", 1);
    let said = load_mesh_file(&folder.write("odd.ply", odd)).expect_err("a number is missing");
    assert!(said.to_string().contains("odd.ply:18: "), "{said}");
}

#[test]
fn a_ply_may_call_and_type_its_lists_otherwise() {
    for list in [
        "list uchar int vertexIndices",
        "list uchar uint vertex_index",
        "list int uchar vertex_indices",
        "list uint float Vertex_Indices",
        "list uchar double corners",
    ] {
        must_be_read("a.ply", &ply(list), 1, list);
    }
    // Binary lists of floats, too.
    let mut bytes = format!(
        "ply\nformat binary_little_endian 1.0\n{VERTICES}element face 6\nproperty list uchar float vertexIndices\nend_header\n"
    )
    .into_bytes();
    let floats = |numbers: &[u8]| -> Vec<u8> {
        numbers
            .iter()
            .flat_map(|n| f32::from(*n).to_le_bytes())
            .collect()
    };
    bytes.extend(floats(CORNERS.as_flattened()));
    for quad in QUADS {
        bytes.push(4);
        bytes.extend(floats(&quad.map(|i| i as u8)));
    }
    let folder = Scratch::new("foreign-text");
    must_be_cubes(&open(&folder.write("a.ply", bytes)), 1, "binary floats");
    let folder = Scratch::new("foreign-text");
    let half = ply("list uchar float vertex_indices").replacen("4 0 3 2 1", "4 0 3 2.5 1", 1);
    let said = load_mesh_file(&folder.write("half.ply", half)).expect_err("no whole number");
    assert!(said.to_string().contains("whole numbers"), "{said}");
}

#[test]
fn a_ply_may_have_strips() {
    let vertices = CORNERS.map(|[x, y, z]| format!("{x} {y} {z}\n")).concat();
    let strips = QUADS
        .map(|[a, b, c, d]| format!("{a} {b} {d} {c} -1 "))
        .concat();
    let text = format!(
        "ply\nformat ascii 1.0\n{VERTICES}element tristrips 1\nproperty list int int vertex_indices\nend_header\n{vertices}30 {strips}\n"
    );
    must_be_read("a.ply", &text, 1, "strips");
}
