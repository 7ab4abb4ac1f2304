//! STL, binary and ASCII. Corners are stored one by one; welding is left to the caller.
//!
//! A file is binary if its length is what its count says (84 + 50 n), whatever its first word: some exporters begin binary
//! files with `solid`. Otherwise it is ASCII if it begins with `solid` and goes on as text, else a damaged binary file.
//! Facet normals and attribute bytes are passed over: the corners say it all.

use std::path::Path;

use glam::DVec3;

use super::{Draft, Group, without_mark};
use crate::error::{Error, Result};
use crate::scene::Mesh;
use crate::scene::weld::thousands;

const HEADER_BYTES: usize = 84;
const FACET_BYTES: usize = 50;
const CUT_OFF: &str = "the file is cut off or damaged: export or download it again";

/// Whether bytes are as long as a binary file with their count of facets.
pub(super) fn is_binary(bytes: &[u8]) -> bool {
    // Text read as a number of facets is too large for the product to fit where addresses have 32 bits.
    stated_facets(bytes).is_some_and(|n| {
        let length = n.checked_mul(FACET_BYTES);
        length.and_then(|l| l.checked_add(HEADER_BYTES)) == Some(bytes.len())
    })
}

pub(super) fn read(path: &Path, bytes: &[u8], notes: &mut Vec<String>) -> Result<Draft> {
    let stated = stated_facets(bytes);
    let text = without_mark(bytes);
    if !is_binary(bytes) && is_text(text) {
        return ascii(path, &String::from_utf8_lossy(text));
    }
    let Some(stated) = stated else {
        let what = format!(
            "a binary STL has a header of {HEADER_BYTES} bytes, the file has {}",
            bytes.len()
        );
        return Err(Error::file(path, what, CUT_OFF));
    };
    let found = (bytes.len() - HEADER_BYTES) / FACET_BYTES;
    if found < stated {
        let what = format!(
            "the header states {} triangles, the file holds {}",
            thousands(stated),
            thousands(found)
        );
        return Err(Error::file(path, what, CUT_OFF));
    }
    let extra = bytes.len() - HEADER_BYTES - FACET_BYTES * stated;
    if extra > 0 {
        notes.push(format!("passed over {extra} bytes after the last triangle"));
    }
    Ok(binary(
        &bytes[HEADER_BYTES..HEADER_BYTES + FACET_BYTES * stated],
    ))
}

/// The count in the header of a binary file.
fn stated_facets(bytes: &[u8]) -> Option<usize> {
    let count = bytes.get(HEADER_BYTES - 4..HEADER_BYTES)?;
    Some(u32::from_le_bytes(count.try_into().ok()?) as usize)
}

fn is_text(bytes: &[u8]) -> bool {
    let start = bytes.trim_ascii_start();
    let head = &start[..start.len().min(512)];
    start.len() >= 5 && start[..5].eq_ignore_ascii_case(b"solid") && !head.contains(&0)
}

fn binary(facets: &[u8]) -> Draft {
    let mut mesh = Mesh::default();
    for facet in facets.chunks_exact(FACET_BYTES) {
        // Twelve bytes of normal first.
        let mut numbers = facet[12..48].chunks_exact(4).map(|b| {
            let number = b.first_chunk().map_or(f32::NAN, |b| f32::from_le_bytes(*b));
            f64::from(number)
        });
        let mut next = || numbers.next().unwrap_or(f64::NAN);
        push_triangle(
            &mut mesh,
            std::array::from_fn(|_| DVec3::from_array(std::array::from_fn(|_| next()))),
        );
    }
    Draft {
        mesh,
        ..Draft::default()
    }
}

fn push_triangle(mesh: &mut Mesh, corners: [DVec3; 3]) {
    let first = mesh.positions.len() as u32;
    mesh.positions.extend(corners);
    mesh.triangles.push([first, first + 1, first + 2]);
}

fn ascii(path: &Path, text: &str) -> Result<Draft> {
    let mut draft = Draft::default();
    let mut corners: Vec<DVec3> = Vec::with_capacity(3);
    let mut inside = false;
    let mut last_line = 1;
    let wrong = |line, what: String| Err(Error::file_line(path, line, what, CUT_OFF));
    for (number, line) in (1..).zip(text.lines()) {
        let line = line.trim();
        let (word, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
        if line.is_empty() {
            continue;
        }
        last_line = number;
        match word.to_ascii_lowercase().as_str() {
            "solid" => {
                inside = true;
                let name = Some(rest.trim().to_owned()).filter(|n| !n.is_empty());
                draft.groups.push(Group {
                    name,
                    ..Group::default()
                });
            }
            "endsolid" => inside = false,
            "vertex" => corners.push(vertex(path, number, rest)?),
            "endfacet" => {
                let Ok(three) = <[DVec3; 3]>::try_from(corners.as_slice()) else {
                    let found = corners.len();
                    return wrong(number, format!("a facet has {found} corners, it needs 3"));
                };
                corners.clear();
                push_triangle(&mut draft.mesh, three);
                draft.group_of_triangle.push(draft.groups.len() as u32 - 1);
            }
            "facet" | "outer" | "endloop" => {}
            other => return wrong(number, format!("`{other}` is not a word of an ASCII STL")),
        }
    }
    if inside || !corners.is_empty() {
        let found = thousands(draft.mesh.triangles.len());
        return wrong(
            last_line,
            format!("the file ends after {found} triangles, `endsolid` is missing"),
        );
    }
    Ok(draft)
}

fn vertex(path: &Path, line: usize, rest: &str) -> Result<DVec3> {
    let mut words = rest.split_ascii_whitespace();
    let mut numbers = [0.0_f64; 3];
    for (k, n) in numbers.iter_mut().enumerate() {
        let wrong = |what| Error::file_line(path, line, what, CUT_OFF);
        let word = words
            .next()
            .ok_or_else(|| wrong(format!("a vertex has {k} of 3 numbers")))?;
        *n = word
            .parse()
            .map_err(|_| wrong(format!("`{word}` is not a number")))?;
        if !n.is_finite() {
            return Err(wrong(format!("a vertex has the coordinate {word}")));
        }
    }
    Ok(DVec3::from(numbers))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn binary_file(header: &[u8], stated: u32, facets: usize) -> Vec<u8> {
        let mut bytes = header.to_vec();
        bytes.resize(80, 0);
        bytes.extend(stated.to_le_bytes());
        for k in 0..facets {
            let corners = [
                0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, k as f32,
            ];
            bytes.extend(corners.iter().flat_map(|c: &f32| c.to_le_bytes()));
            bytes.extend([0, 0]);
        }
        bytes
    }

    fn parse(bytes: &[u8]) -> Result<Draft> {
        read(Path::new("t.stl"), bytes, &mut Vec::new())
    }

    const ASCII: &str = "solid two words\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1e0 0 0\n   VERTEX 0 1 0.1\n  endloop\n endfacet\nendsolid two words\n";

    #[test]
    fn binary_that_begins_with_solid_is_binary() {
        let draft = parse(&binary_file(b"solid made by CAD", 3, 3)).unwrap();
        assert_eq!(draft.mesh.triangles.len(), 3);
        assert_eq!(draft.mesh.positions[8], DVec3::new(0.0, 1.0, 2.0));
    }

    #[test]
    fn ascii_is_read_in_f64() {
        let draft = parse(ASCII.as_bytes()).unwrap();
        assert_eq!(draft.mesh.positions[2], DVec3::new(0.0, 1.0, 0.1));
        assert_eq!(draft.groups[0].name.as_deref(), Some("two words"));
    }

    #[test]
    fn cut_off_files_name_both_counts() {
        let said = parse(&binary_file(b"", 4_000_000_000, 2)).unwrap_err();
        assert!(
            said.to_string()
                .contains("4,000,000,000 triangles, the file holds 2")
        );
        assert!(parse(&binary_file(b"", 2, 2)[..70]).is_err());
        let lines: Vec<&str> = ASCII.lines().collect();
        for kept in 1..lines.len() {
            let text = lines[..kept].join("\n");
            let said = parse(text.as_bytes()).unwrap_err().to_string();
            assert!(said.contains("endsolid"), "{kept} lines: {said}");
        }
    }

    #[test]
    fn trailing_bytes_are_noted() {
        let mut notes = Vec::new();
        let mut bytes = binary_file(b"", 2, 2);
        bytes.extend([1; 7]);
        read(Path::new("t.stl"), &bytes, &mut notes).unwrap();
        assert!(notes[0].contains("7 bytes"), "{notes:?}");
    }
}
