//! PLY, ASCII and binary of either byte order, through `ply-rs-bw`.
//!
//! Elements `vertex` (`x`, `y`, `z`, optionally `nx`, `ny`, `nz`; any number type; `red`, `green`, `blue` of
//! `uchar`, `ushort`, `float` or `double`) and `face` (`vertex_indices` or
//! `vertex_index`, polygons become fans from their first corner). Other elements are parsed and dropped. A line of the
//! header that begins with none of its words, nor with one misspelt, is read as the comment that it was meant to be: old
//! versions of Blender wrote such lines.

use std::borrow::Cow;
use std::io::{ErrorKind, Read};
use std::path::Path;

use glam::{DVec3, Vec3};
use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{ElementDef, Encoding, Property, PropertyAccess, PropertyAccessResult};

use super::{Draft, without_mark};
use crate::error::{Error, Result};
use crate::scene::{Coat, CoatedTriangle, Mesh};

/// First words of the lines of a header.
const HEADER_WORDS: [&str; 7] = [
    "ply",
    "format",
    "comment",
    "obj_info",
    "element",
    "property",
    "end_header",
];

/// Colours of vertices.
const COLORS: [&str; 3] = ["red", "green", "blue"];

/// A header is looked for in so many bytes.
const LONGEST_HEADER: usize = 1 << 20;

/// A word that is as similar to one of [`HEADER_WORDS`] is that word misspelt.
const MISSPELT: f64 = 0.8;

#[derive(Debug, Default)]
struct Vertex {
    at: DVec3,
    normal: Vec3,
    /// sRGB, each in 0 to the greatest of its type, or in 0..=1.
    color: [u8; 4],
}

#[derive(Debug, Default)]
struct Face {
    corners: Corners,
}

/// The indices as the file types them: converting each list on its own would double the allocations.
#[derive(Debug, Default)]
enum Corners {
    #[default]
    None,
    Small(Vec<u32>),
    Signed(Vec<i32>),
    Unsigned(Vec<u32>),
}

#[derive(Debug, Default)]
struct Ignored;

impl PropertyAccess for Vertex {
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

impl PropertyAccess for Face {
    fn new() -> Self {
        Self::default()
    }

    fn set_property(&mut self, name: &str, value: Property) -> PropertyAccessResult {
        if !is_corner_list(name) {
            return PropertyAccessResult::Ignored;
        }
        self.corners = match value {
            Property::ListInt(all) => Corners::Signed(all),
            Property::ListUInt(all) => Corners::Unsigned(all),
            Property::ListUChar(all) => Corners::Small(all.into_iter().map(u32::from).collect()),
            Property::ListUShort(all) => Corners::Small(all.into_iter().map(u32::from).collect()),
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

fn is_corner_list(name: &str) -> bool {
    name == "vertex_indices" || name == "vertex_index"
}

/// Header and payload; lines of text that nothing introduces have become comments, each on its line.
fn with_comments<'a>(path: &Path, bytes: &'a [u8], notes: &mut Vec<String>) -> [Cow<'a, [u8]>; 2] {
    const END: &[u8] = b"\nend_header";
    let head = &bytes[..bytes.len().min(LONGEST_HEADER)];
    let end = head.windows(END.len()).position(|w| w == END);
    let Some((header, payload)) = end.map(|end| bytes.split_at(end)) else {
        return [Cow::Borrowed(bytes), Cow::Borrowed(&[])];
    };
    let is_bare = |line: &str| {
        let word = line.split_whitespace().next().unwrap_or("").to_lowercase();
        let is_like = |known: &str| strsim::jaro_winkler(known, &word) > MISSPELT;
        !word.is_empty() && !HEADER_WORDS.iter().any(|known| is_like(known))
    };
    let Some(text) = std::str::from_utf8(header)
        .ok()
        .filter(|t| t.lines().any(is_bare))
    else {
        return [Cow::Borrowed(header), Cow::Borrowed(payload)];
    };
    let mut commented = Vec::with_capacity(text.len() + 64);
    for (number, line) in (1..).zip(text.split_inclusive('\n')) {
        if is_bare(line) {
            let shown: String = line.trim().chars().take(40).collect();
            let file = path.display();
            notes.push(format!("{file}:{number}: read as a comment: {shown:?}"));
            commented.extend(b"comment ");
        }
        commented.extend(line.bytes());
    }
    [Cow::Owned(commented), Cow::Borrowed(payload)]
}

pub(super) fn read(path: &Path, bytes: &[u8], notes: &mut Vec<String>) -> Result<Draft> {
    let bytes = without_mark(bytes);
    let [header, payload] = with_comments(path, bytes, notes);
    let mut reader = Reader::new(header.as_ref().chain(payload.as_ref()));
    let header = Parser::<Ignored>::new()
        .read_header(&mut reader)
        .map_err(|e| wrong(path, bytes, &e, true))?;
    let in_lines = header.encoding == Encoding::Ascii;
    let mut vertices = Vec::new();
    let mut faces = Vec::new();
    let mut has_normals = false;
    let mut has_colors = false;
    for (name, element) in &header.elements {
        check(path, element)?;
        let complain = |e: ParseError| wrong(path, bytes, &e, in_lines);
        match name.as_str() {
            "vertex" => {
                has_normals = ["nx", "ny", "nz"].iter().all(|n| has(element, n));
                has_colors = COLORS.iter().all(|n| has(element, n));
                vertices = Parser::<Vertex>::new()
                    .read_payload_for_element(&mut reader, element, &header)
                    .map_err(complain)?;
            }
            "face" => {
                faces = Parser::<Face>::new()
                    .read_payload_for_element(&mut reader, element, &header)
                    .map_err(complain)?;
            }
            _ => {
                Parser::<Ignored>::new()
                    .read_payload_for_element(&mut reader, element, &header)
                    .map_err(complain)?;
            }
        }
    }
    if faces.is_empty() {
        return Err(Error::file(
            path,
            format!("it has {} vertices and no faces", vertices.len()),
            "a cloud of points is not a solid: reconstruct a surface first",
        ));
    }
    Ok(Draft {
        mesh: mesh_of(path, &vertices, &faces, [has_normals, has_colors])?,
        ..Draft::default()
    })
}

fn has(element: &ElementDef, property: &str) -> bool {
    element.properties.iter().any(|(name, _)| name == property)
}

/// Refuses what would be read as nothing: an element without properties takes no bytes however often it is stated.
fn check(path: &Path, element: &ElementDef) -> Result<()> {
    let missing = match element.name.as_str() {
        "vertex" => ["x", "y", "z"].into_iter().find(|n| !has(element, n)),
        "face" if !element.properties.iter().any(|(n, _)| is_corner_list(n)) => {
            Some("vertex_indices")
        }
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
    if element.name == "tristrips" && element.count > 0 {
        let what = "its faces are triangle strips, which are not read";
        return Err(Error::file(path, what, "export it with the element `face`"));
    }
    Ok(())
}

fn mesh_of(
    path: &Path,
    vertices: &[Vertex],
    faces: &[Face],
    [has_normals, has_colors]: [bool; 2],
) -> Result<Mesh> {
    let mut triangles = Vec::with_capacity(faces.len());
    for (number, face) in faces.iter().enumerate() {
        let mut fan = |all: &[u32]| {
            if let [first, rest @ ..] = all {
                triangles.extend(rest.windows(2).map(|w| [*first, w[0], w[1]]));
            }
        };
        match &face.corners {
            Corners::None => {}
            Corners::Small(all) | Corners::Unsigned(all) => fan(all),
            Corners::Signed(all) => {
                if let Some(index) = all.iter().find(|i| **i < 0) {
                    return Err(Error::file(
                        path,
                        format!("face {number} refers to vertex {index}"),
                        "the file is damaged: export it again",
                    ));
                }
                match *all.as_slice() {
                    [a, b, c] => fan(&[a as u32, b as u32, c as u32]),
                    ref more => fan(&more.iter().map(|i| *i as u32).collect::<Vec<_>>()),
                }
            }
        }
    }
    // Out of range indices are for the door to refuse by number; only then is it safe to look normals up.
    let in_range = triangles
        .iter()
        .flatten()
        .all(|i| (*i as usize) < vertices.len());
    let corner_normals = (has_normals && in_range).then(|| {
        let normal = |i: u32| vertices[i as usize].normal.normalize_or_zero();
        triangles.iter().map(|t| t.map(normal)).collect()
    });
    let coat = (has_colors && in_range).then(|| {
        let color = |i: u32| vertices[i as usize].color;
        let coated = triangles.iter().map(|t: &[u32; 3]| CoatedTriangle {
            colors: t.map(color),
            ..CoatedTriangle::default()
        });
        Coat {
            images: Vec::new(),
            triangles: coated.collect(),
        }
    });
    Ok(Mesh {
        coat,
        positions: vertices.iter().map(|v| v.at).collect(),
        triangles,
        corner_normals,
    })
}

/// The parser's complaint in one line; for text, the line at fault. The parser takes no NaN and no infinity either.
fn wrong(path: &Path, bytes: &[u8], error: &ParseError, in_lines: bool) -> Error {
    let help = "the file is cut off, damaged or no PLY: export or download it again";
    let line = error.line().filter(|_| in_lines);
    let shown = |text: &str| text.chars().take(160).collect::<String>();
    if let Some(number) = line
        && error.kind() != ErrorKind::UnexpectedEof
    {
        let text = bytes.split(|b| *b == b'\n').nth(number - 1).unwrap_or(b"");
        let text = shown(String::from_utf8_lossy(text).trim());
        let what = format!("`{text}` is not what a PLY has here");
        return Error::file_line(path, number, what, help);
    }
    let text = error.to_string();
    let text = match text.split_once(": ") {
        Some((_, rest)) if error.line().is_some() => rest,
        _ => &text,
    };
    let what = shown(text.lines().next().unwrap_or(text));
    match line {
        Some(line) => Error::file_line(path, line, what, help),
        None => Error::file(path, what, help),
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
                    assert!(notes[0].starts_with("t.ply:3: "), "{notes:?}");
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
