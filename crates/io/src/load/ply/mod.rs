//! Reads PLY files, ASCII or binary in either byte order. The crate `ply-rs-bw` parses headers.
//!
//! An element `vertex` has `x`, `y`, `z`, optionally `nx`, `ny`, `nz`, of any number type, and optionally `red`, `green`, `blue` of
//! `uchar`, `ushort`, `float` or `double`. A `face` has `vertex_indices`, under any name; polygons become fans from their first corner. In
//! `tristrips`, a negative index ends each strip. Other elements are parsed and dropped.

mod binary;
mod elements;
mod fault;
mod header;
mod text;

use std::path::Path;

use cutaway::error::{Diagnostic, Error, Result};
use ply_rs_bw::parser::{Parser, Reader};
use ply_rs_bw::ply::{
    ElementDef, Encoding, Property, PropertyAccess, PropertyAccessResult, PropertyDef, PropertyType,
};

use super::{Draft, without_mark};

use binary::Payload;
use elements::{CORNERS, Dropped, Elements, PolygonKind, Polygons, Rows, Vertices, lists_corners};
use fault::PlyError;
use text::Words;

/// Name of the triangle-strip element.
const STRIPS: &str = "tristrips";

const DAMAGED: &str = "the file is cut off, damaged or not a PLY: export or download it again";

/// Source of the elements, in header order.
enum ElementSource<'a, 'b> {
    Binary(Payload<'b>),
    Text(&'a mut Words<'b>),
}

impl ElementSource<'_, '_> {
    fn read<R: Rows>(
        &mut self,
        element: &ElementDef,
        empty: impl Fn(usize) -> R + Sync,
    ) -> Result<R, PlyError> {
        match self {
            Self::Binary(payload) => payload.read(element, empty),
            Self::Text(words) => words.read(element, empty(0)),
        }
    }

    fn elements(&mut self, elements: &[ElementDef]) -> Result<Elements, PlyError> {
        let mut read = Elements::default();
        for element in elements {
            let polygons = |kind| move |before| Polygons::of(element, kind, before);
            match element.name.as_str() {
                "vertex" => {
                    let vertices = Vertices::of(element);
                    read.vertices = self.read(element, |_| vertices.clone())?;
                }
                "face" => {
                    read.faces = self.read(element, polygons(PolygonKind::Face))?;
                    read.polygons += element.count;
                }
                STRIPS => {
                    read.strips = self.read(element, polygons(PolygonKind::Strip))?;
                    read.polygons += element.count;
                }
                _ => _ = self.read(element, |_| Dropped)?,
            }
        }
        Ok(read)
    }
}

/// An element of which only the header is read by the crate.
#[derive(Debug)]
struct Unread;

impl PropertyAccess for Unread {
    fn new() -> Self {
        Self
    }

    fn set_property(&mut self, _: &str, _: Property) -> PropertyAccessResult {
        PropertyAccessResult::Ignored
    }
}

pub(super) fn read(path: &Path, bytes: &[u8], notes: &mut Vec<Diagnostic>) -> Result<Draft> {
    let bytes = without_mark(bytes);
    let (header_text, payload) = header::split(path, bytes, notes);
    let refuse = |fault: PlyError| match fault.line {
        Some(line) => Error::file_line(path, line, fault.what, DAMAGED),
        None => Error::file(path, fault.what, DAMAGED),
    };
    let header = Parser::<Unread>::new()
        .read_header(&mut Reader::new(header_text.as_bytes()))
        .map_err(|e| refuse(PlyError::in_header(&e, &header_text)))?;
    let mut elements: Vec<ElementDef> = header.elements.values().cloned().collect();
    for element in &mut elements {
        name_corner_list(element);
        check(path, element)?;
    }
    let read = match header.encoding {
        Encoding::Ascii => {
            let text = String::from_utf8_lossy(payload);
            let before = header_text.lines().count();
            text::in_either_layout(&text, before, |words| {
                ElementSource::Text(words).elements(&elements)
            })
        }
        encoding => {
            let payload = Payload {
                bytes: payload,
                is_big_endian: encoding == Encoding::BinaryBigEndian,
            };
            ElementSource::Binary(payload).elements(&elements)
        }
    };
    let read = read.map_err(refuse)?;
    if read.polygons == 0 {
        return Err(Error::file(
            path,
            format!("it has {} vertices and no faces", read.vertices.len()),
            "a cloud of points is not a solid: reconstruct a surface first",
        ));
    }
    Ok(Draft {
        mesh: read.into_mesh(),
        ..Draft::default()
    })
}

/// Renames the property that lists the corners of a face or strip to the name used here. Programs call it `vertexIndices` and other names;
/// if no known name is found, the only list property is used.
fn name_corner_list(element: &mut ElementDef) {
    if element.name != "face" && element.name != STRIPS {
        return;
    }
    let is_known = |name: &str| {
        let plain = name.replace('_', "").to_lowercase();
        ["vertexindices", "vertexindex", "vertices", "indices"].contains(&plain.as_str())
    };
    let lists = || {
        let is_list = |p: &&PropertyDef| matches!(p.data_type, PropertyType::List(..));
        element.properties.values().filter(is_list)
    };
    let named = lists().find(|p| is_known(&p.name));
    let found = named.or_else(|| lists().next().filter(|_| lists().count() == 1));
    let Some(found) = found.map(|p| p.name.clone()) else {
        return;
    };
    let renamed = element.properties.values().map(|p| {
        let name = match p.name == found {
            true => CORNERS,
            false => &p.name,
        };
        (
            name.to_owned(),
            PropertyDef::new(name.to_owned(), p.data_type.clone()),
        )
    });
    element.properties = renamed.collect();
}

fn has_number(element: &ElementDef, name: &str) -> bool {
    let mut properties = element.properties.values();
    properties.any(|p| p.name == name && matches!(p.data_type, PropertyType::Scalar(_)))
}

/// Refuses elements that lack a required property or have none. Without properties an element takes no bytes, whatever its count.
fn check(path: &Path, element: &ElementDef) -> Result<()> {
    let missing = match element.name.as_str() {
        "vertex" => ["x", "y", "z"]
            .into_iter()
            .find(|n| !has_number(element, n)),
        "face" | STRIPS if !element.properties.values().any(lists_corners) => Some(CORNERS),
        _ if element.properties.iter().count() == 0 => Some("any property"),
        _ => None,
    };
    if let Some(missing) = missing {
        let what = format!("the element `{}` lacks {missing}", element.name);
        return Err(Error::file(
            path,
            what,
            "export it as a plain triangle mesh",
        ));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    const HEADER: &str = "element vertex 4\nproperty double x\nproperty float y\nproperty short z\nproperty uchar red\nelement face 2\nproperty list uchar int vertex_index\nproperty float quality\nend_header\n";

    fn ascii() -> String {
        format!(
            "ply\nformat ascii 1.0\n{HEADER}0 0 0 9\n1 0 0 9\n1 1 0 9\n0.1 1 2 9\n4 0 1 2 3 0.5\n3 0 3 1 0.5\n"
        )
    }

    fn binary(big: bool) -> Vec<u8> {
        fn put<const N: usize>(to: &mut Vec<u8>, big: bool, mut little: [u8; N]) {
            if big {
                little.reverse();
            }
            to.extend(little);
        }
        let order = if big { "big" } else { "little" };
        let mut to = format!("ply\nformat binary_{order}_endian 1.0\n{HEADER}").into_bytes();
        for (x, y, z) in [(0.0, 0.0, 0), (1.0, 0.0, 0), (1.0, 1.0, 0), (0.1, 1.0, 2)] {
            put(&mut to, big, f64::to_le_bytes(x));
            put(&mut to, big, f32::to_le_bytes(y));
            put(&mut to, big, i16::to_le_bytes(z));
            to.push(9);
        }
        for face in [&[0, 1, 2, 3][..], &[0, 3, 1]] {
            to.push(face.len() as u8);
            for i in face {
                put(&mut to, big, i32::to_le_bytes(*i));
            }
            put(&mut to, big, f32::to_le_bytes(0.5));
        }
        to
    }

    #[test]
    fn all_encodings_say_the_same() {
        let of = |bytes: &[u8]| {
            read(Path::new("t.ply"), bytes, &mut Vec::new())
                .unwrap()
                .mesh
        };
        let mesh = of(ascii().as_bytes());
        assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3], [0, 3, 1]]);
        assert_eq!(mesh.positions[3], DVec3::new(0.1, 1.0, 2.0));
        assert_eq!(of(&binary(false)), mesh);
        assert_eq!(of(&binary(true)), mesh);
    }

    #[test]
    fn rows_of_one_length_come_to_what_rows_of_any_length_come_to() {
        // More rows than a thread takes at once.
        let triangles = 40_000_u32;
        let header = "ply\nformat binary_little_endian 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n\
            element face N\nproperty list uchar uint vertex_index\nproperty uchar quality\nend_header\n";
        let file = |last: &[&[u32]]| {
            let count = triangles as usize + last.len();
            let mut to = header.replace('N', &count.to_string()).into_bytes();
            let coordinates = (0..15).map(|i| (i * i) as f32);
            to.extend(coordinates.flat_map(f32::to_le_bytes));
            let faces = (0..triangles).map(|t| [t % 5, (t + 1) % 5, (t + 2) % 5]);
            let last = last.iter().map(|face| face.to_vec());
            for face in faces.map(|f| f.to_vec()).chain(last) {
                to.push(face.len() as u8);
                to.extend(face.iter().flat_map(|i| i.to_le_bytes()));
                to.push(1);
            }
            to
        };
        let of = |bytes: &[u8]| read(Path::new("t.ply"), bytes, &mut Vec::new());
        let uniform = of(&file(&[&[0, 1, 2]])).unwrap().mesh;
        let mixed = of(&file(&[&[0, 1, 2, 3]])).unwrap().mesh;
        assert_eq!(uniform.triangles.len(), triangles as usize + 1);
        assert_eq!(uniform.triangles, mixed.triangles[..triangles as usize + 1]);
        assert_eq!(mixed.triangles.last(), Some(&[0, 2, 3]));
        assert_eq!(uniform.triangles[39_999], [4, 0, 1]);
        assert_eq!(uniform.positions, mixed.positions);
        // A row that is too short, and as many bytes after the last row as it lacks.
        let bytes = [file(&[&[0, 1], &[2, 3, 4]]), vec![9; 4]].concat();
        let last = of(&bytes).unwrap().mesh.triangles;
        assert_eq!(last[triangles as usize..], [[2, 3, 4]]);
        let short = of(&file(&[&[0, 1, 2]])[..500_000]).unwrap_err().to_string();
        assert!(short.contains("of 40001 `face`"), "{short}");
    }

    #[test]
    fn corners_that_are_no_indices_are_refused() {
        for (corners, said) in [
            ("3 0 1 -2", "face 1 refers to vertex -2"),
            ("3 0 1 4294967296", "face 1 refers to vertex 4294967296"),
            ("3 0 1 1.5", "the corners of face 1 are not whole numbers"),
            ("2 -1 0", "face 1 refers to vertex -1"),
            ("1 0.5", "the corners of face 1 are not whole numbers"),
        ] {
            let text = format!(
                "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 2\n\
                property list uchar double vertex_index\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n{corners}\n"
            );
            let error = read(Path::new("t.ply"), text.as_bytes(), &mut Vec::new());
            let error = error.unwrap_err().to_string();
            assert!(error.contains(said), "{error}");
        }
    }

    #[test]
    fn lists_of_text_hold_numbers_of_any_size() {
        let file = |list: &str, index: &str| {
            format!(
                "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n\
                property {list} vertex_index\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 {index}\n"
            )
        };
        for (list, index) in [
            ("list uchar uchar", "70000"),
            ("list uchar short", "70000"),
            ("list uchar float", "16777217"),
        ] {
            let text = file(list, index);
            let draft = read(Path::new("t.ply"), text.as_bytes(), &mut Vec::new()).unwrap();
            assert_eq!(draft.mesh.triangles, [[0, 1, index.parse().unwrap()]]);
        }
        // One number is no list, and a list no number.
        for text in [
            file("int", "2"),
            file("list uchar int", "2").replace("float x", "list uchar float x"),
        ] {
            let error = read(Path::new("t.ply"), text.as_bytes(), &mut Vec::new());
            assert!(error.unwrap_err().to_string().contains("lacks"), "{text}");
        }
    }

    #[test]
    fn elements_that_are_not_there_cost_nothing() {
        // The payload, read as a list, would be as long as itself.
        let header: String = (0..20_000)
            .map(|i| format!("element e{i} 0\nproperty list uint uchar b\n"))
            .collect();
        let mut bytes = binary(false);
        let at = bytes.iter().position(|b| *b == b'e').unwrap();
        let at = at
            + bytes[at..]
                .windows(8)
                .position(|w| w == b"element ")
                .unwrap();
        bytes.splice(at..at, header.into_bytes());
        bytes.extend(vec![0; 1 << 22]);
        let draft = read(Path::new("t.ply"), &bytes, &mut Vec::new()).unwrap();
        assert_eq!(draft.mesh.triangles.len(), 3);
    }

    #[test]
    fn bare_text_is_a_comment_and_misspelt_words_are_refused() {
        for (line, is_read) in [
            ("Created by Blender3D 2.42, source file: a.blend", true),
            ("www.blender.org", true),
            ("elemnet edge 3", false),
            ("propert float x", false),
        ] {
            for whole in [ascii().into_bytes(), binary(true)] {
                let at = whole.iter().position(|b| *b == b'\n').unwrap() + 1;
                let at = at + whole[at..].iter().position(|b| *b == b'\n').unwrap() + 1;
                let bytes = [&whole[..at], line.as_bytes(), b"\n", &whole[at..]].concat();
                let mut notes = Vec::new();
                let draft = read(Path::new("t.ply"), &bytes, &mut notes);
                assert_eq!(draft.is_ok(), is_read, "{line}");
                assert_eq!(notes.len(), usize::from(is_read), "{notes:?}");
                if let Ok(draft) = draft {
                    assert_eq!(draft.mesh.triangles.len(), 3, "{line}");
                    assert!(notes[0].to_string().starts_with("t.ply:3: "), "{notes:?}");
                }
            }
        }
    }

    #[test]
    fn cut_off_and_odd_files_are_refused() {
        let of = |bytes: &[u8]| read(Path::new("t.ply"), bytes, &mut Vec::new());
        let whole = binary(false);
        for length in [0, 3, 40, whole.len() - 60, whole.len() - 1] {
            assert!(of(&whole[..length]).is_err(), "{length} bytes");
        }
        let text = ascii();
        let said = of(&text.as_bytes()[..text.len() - 12])
            .unwrap_err()
            .to_string();
        assert!(said.starts_with("t.ply:"), "{said}");
        let empty = "ply\nformat binary_little_endian 1.0\nelement junk 4000000000\nend_header\n";
        let said = of(empty.as_bytes()).unwrap_err().to_string();
        assert!(said.contains("junk"), "{said}");
        let cloud = "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
        assert!(
            of(cloud.as_bytes())
                .unwrap_err()
                .to_string()
                .contains("no faces")
        );
    }
}
