//! Reads PLY files, ASCII or binary in either byte order. The crate `ply-rs-bw` parses headers and binary elements.
//!
//! An element `vertex` has `x`, `y`, `z`, optionally `nx`, `ny`, `nz`, of any number type, and optionally `red`, `green`, `blue` of
//! `uchar`, `ushort`, `float` or `double`. A `face` has `vertex_indices`, under any name; polygons become fans from their first corner. In
//! `tristrips`, a negative index ends each strip. Other elements are parsed and dropped.

mod fault;
mod header;
mod text;

use std::io::{BufRead, Read};
use std::path::Path;

use cutaway::error::{Diagnostic, Error, Result};
use cutaway::scene::weld::has_three;
use cutaway::scene::{Mesh, TexturedTriangle, VertexPaint};
use glam::{DVec3, Vec3};
use ply_rs_bw::parser::{Parser, Reader};
use ply_rs_bw::ply::{
    ElementDef, Encoding, Header, Property, PropertyAccess, PropertyAccessResult, PropertyDef,
    PropertyType,
};

use super::{Draft, without_mark};

use fault::PlyError;
use text::Words;

/// Name used here for the property that lists a face's corners.
const CORNERS: &str = "vertex_indices";

/// Name of the triangle-strip element.
const STRIPS: &str = "tristrips";

const DAMAGED: &str = "the file is cut off, damaged or not a PLY: export or download it again";

/// Properties of vertex colours.
const COLORS: [&str; 3] = ["red", "green", "blue"];

#[derive(Debug, Default)]
struct PlyVertex {
    at: DVec3,
    normal: Vec3,
    /// Colour in sRGB. In the file, integer channels range from 0 to the largest value of their type, and others from 0 to 1.
    color: [u8; 4],
}

#[derive(Debug, Default)]
struct PlyFace {
    corners: Corners,
}

/// Indices in the integer type of the file. Converting each list separately would double the number of allocations.
#[derive(Debug)]
enum Corners {
    Signed(Vec<i32>),
    Unsigned(Vec<u32>),
    /// The indices are not whole numbers.
    Broken,
}

impl Corners {
    /// Converts indices that are stored as floating-point numbers, as some programs do.
    fn of_floats(all: impl Iterator<Item = f64>) -> Self {
        let whole = |n: f64| (n == f64::from(n as i32)).then_some(n as i32);
        all.map(whole)
            .collect::<Option<_>>()
            .map_or(Self::Broken, Self::Signed)
    }
}

impl Default for Corners {
    fn default() -> Self {
        Self::Unsigned(Vec::new())
    }
}

#[derive(Debug, Default)]
struct Ignored;

impl PropertyAccess for PlyVertex {
    fn new() -> Self {
        Self::default()
    }

    fn set_property(&mut self, name: &str, value: Property) -> PropertyAccessResult {
        if let Some(channel) = COLORS.iter().position(|known| *known == name) {
            self.color[channel] = match value {
                Property::UChar(n) => n,
                Property::UShort(n) => (n >> 8) as u8,
                Property::Float(n) => (n.clamp(0.0, 1.0) * 255.0).round() as u8,
                Property::Double(n) => (n.clamp(0.0, 1.0) * 255.0).round() as u8,
                _ => return PropertyAccessResult::Ignored,
            };
            return PropertyAccessResult::Set;
        }
        let number = match value {
            Property::Char(n) => f64::from(n),
            Property::UChar(n) => f64::from(n),
            Property::Short(n) => f64::from(n),
            Property::UShort(n) => f64::from(n),
            Property::Int(n) => f64::from(n),
            Property::UInt(n) => f64::from(n),
            Property::Float(n) => f64::from(n),
            Property::Double(n) => n,
            _ => return PropertyAccessResult::Ignored,
        };
        match name {
            "x" => self.at.x = number,
            "y" => self.at.y = number,
            "z" => self.at.z = number,
            "nx" => self.normal.x = number as f32,
            "ny" => self.normal.y = number as f32,
            "nz" => self.normal.z = number as f32,
            _ => return PropertyAccessResult::Ignored,
        }
        PropertyAccessResult::Set
    }
}

impl PropertyAccess for PlyFace {
    fn new() -> Self {
        Self::default()
    }

    fn set_property(&mut self, name: &str, value: Property) -> PropertyAccessResult {
        if name != CORNERS {
            return PropertyAccessResult::Ignored;
        }
        self.corners = match value {
            Property::ListInt(all) => Corners::Signed(all),
            Property::ListUInt(all) => Corners::Unsigned(all),
            Property::ListUChar(all) => Corners::Unsigned(all.into_iter().map(u32::from).collect()),
            Property::ListUShort(all) => {
                Corners::Unsigned(all.into_iter().map(u32::from).collect())
            }
            Property::ListFloat(all) => Corners::of_floats(all.into_iter().map(f64::from)),
            Property::ListDouble(all) => Corners::of_floats(all.into_iter()),
            Property::ListChar(all) => Corners::Signed(all.into_iter().map(i32::from).collect()),
            Property::ListShort(all) => Corners::Signed(all.into_iter().map(i32::from).collect()),
            _ => return PropertyAccessResult::UnsupportedType,
        };
        PropertyAccessResult::Set
    }
}

impl PropertyAccess for Ignored {
    fn new() -> Self {
        Self
    }
}

/// Elements of a mesh, with flags for whether the vertices have complete normals and complete colours.
#[derive(Default)]
struct Elements {
    vertices: Vec<PlyVertex>,
    faces: Vec<PlyFace>,
    strips: Vec<PlyFace>,
    has_normals: bool,
    has_colors: bool,
}

/// Source of the elements, in header order.
enum ElementSource<'a, 'b, R: BufRead> {
    Binary(&'a mut Reader<R>, &'a Header),
    Text(&'a mut Words<'b>),
}

impl<R: BufRead> ElementSource<'_, '_, R> {
    fn read<E: PropertyAccess>(&mut self, element: &ElementDef) -> Result<Vec<E>, PlyError> {
        match self {
            Self::Binary(reader, header) => Parser::<E>::new()
                .read_payload_for_element(reader, element, header)
                .map_err(|e| PlyError::of(&e)),
            Self::Text(words) => words.read(element),
        }
    }

    fn elements(&mut self, elements: &[ElementDef]) -> Result<Elements, PlyError> {
        let mut read = Elements::default();
        for element in elements {
            match element.name.as_str() {
                "vertex" => {
                    read.has_normals = ["nx", "ny", "nz"].iter().all(|n| has(element, n));
                    read.has_colors = COLORS.iter().all(|n| has(element, n));
                    read.vertices = self.read(element)?;
                }
                "face" => read.faces = self.read(element)?,
                STRIPS => read.strips = self.read(element)?,
                _ => _ = self.read::<Ignored>(element)?,
            }
        }
        Ok(read)
    }
}

pub(super) fn read(path: &Path, bytes: &[u8], notes: &mut Vec<Diagnostic>) -> Result<Draft> {
    let bytes = without_mark(bytes);
    let (header_text, payload) = header::split(path, bytes, notes);
    let refuse = |fault: PlyError| match fault.line {
        Some(line) => Error::file_line(path, line, fault.what, DAMAGED),
        None => Error::file(path, fault.what, DAMAGED),
    };
    let mut reader = Reader::new(header_text.as_bytes().chain(payload));
    let header = Parser::<Ignored>::new()
        .read_header(&mut reader)
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
                ElementSource::<&[u8]>::Text(words).elements(&elements)
            })
        }
        _ => ElementSource::Binary(&mut reader, &header).elements(&elements),
    };
    let read = read.map_err(refuse)?;
    if read.faces.is_empty() && read.strips.is_empty() {
        return Err(Error::file(
            path,
            format!("it has {} vertices and no faces", read.vertices.len()),
            "a cloud of points is not a solid: reconstruct a surface first",
        ));
    }
    Ok(Draft {
        mesh: mesh_of(path, &read)?,
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

fn has(element: &ElementDef, property: &str) -> bool {
    element.properties.iter().any(|(name, _)| name == property)
}

/// Refuses elements that lack a required property or have none. Without properties an element takes no bytes, whatever its count.
fn check(path: &Path, element: &ElementDef) -> Result<()> {
    let missing = match element.name.as_str() {
        "vertex" => ["x", "y", "z"].into_iter().find(|n| !has(element, n)),
        "face" | STRIPS if !has(element, CORNERS) => Some(CORNERS),
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

fn mesh_of(path: &Path, read: &Elements) -> Result<Mesh> {
    let wrong = |what: String| Error::file(path, what, "the file is damaged: export it again");
    let vertices = &read.vertices;
    let mut triangles = Vec::with_capacity(read.faces.len());
    for (number, face) in read.faces.iter().enumerate() {
        match &face.corners {
            Corners::Signed(all) => {
                if let Some(index) = all.iter().find(|i| **i < 0) {
                    return Err(wrong(format!("face {number} refers to vertex {index}")));
                }
                fan(all, |i| i as u32, &mut triangles);
            }
            Corners::Unsigned(all) => fan(all, |i| i, &mut triangles),
            Corners::Broken => {
                let what = format!("the corners of face {number} are not whole numbers");
                return Err(wrong(what));
            }
        }
    }
    for (number, strip) in read.strips.iter().enumerate() {
        let corners: Vec<i64> = match &strip.corners {
            Corners::Signed(all) => all.iter().map(|i| i64::from(*i)).collect(),
            Corners::Unsigned(all) => all.iter().map(|i| i64::from(*i)).collect(),
            Corners::Broken => {
                let what = format!("the corners of strip {number} are not whole numbers");
                return Err(wrong(what));
            }
        };
        // A negative index ends a strip.
        for strip in corners.split(|i| *i < 0) {
            let strip = strip.windows(3).enumerate().map(|(k, w)| match k % 2 {
                0 => [w[0], w[1], w[2]],
                _ => [w[1], w[0], w[2]],
            });
            let strip = strip.map(|t| t.map(|i| i as u32));
            // Strips are joined by degenerate triangles, which have repeated corners and are dropped here.
            triangles.extend(strip.filter(has_three));
        }
    }
    // The later mesh check refuses indices that are out of range. Normals are only looked up if all indices are in range.
    let in_range = triangles
        .iter()
        .flatten()
        .all(|i| (*i as usize) < vertices.len());
    let corner_normals = (read.has_normals && in_range).then(|| {
        let normal = |i: u32| vertices[i as usize].normal.normalize_or_zero();
        triangles.iter().map(|t| t.map(normal)).collect()
    });
    let vertex_paint = (read.has_colors && in_range).then(|| {
        let color = |i: u32| vertices[i as usize].color;
        let textured = triangles.iter().map(|t: &[u32; 3]| TexturedTriangle {
            colors: t.map(color),
            ..TexturedTriangle::default()
        });
        VertexPaint {
            images: Vec::new(),
            triangles: textured.collect(),
        }
    });
    Ok(Mesh {
        vertex_paint,
        positions: vertices.iter().map(|v| v.at).collect(),
        triangles,
        corner_normals,
    })
}

/// Splits a polygon into a triangle fan from its first corner.
fn fan<T: Copy>(corners: &[T], index: impl Fn(T) -> u32, triangles: &mut Vec<[u32; 3]>) {
    if let [first, rest @ ..] = corners {
        let fan = rest.windows(2).map(|w| [*first, w[0], w[1]].map(&index));
        triangles.extend(fan);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
