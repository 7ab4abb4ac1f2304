//! Reads STL, binary and ASCII. In the file, each triangle has its own three corners. Those of a binary file are welded here, so that there is
//! never an array of them; those of an ASCII file are welded by the caller.
//!
//! A file is binary if its length matches its triangle count (84 + 50 n), whatever its first word, because some exporters begin binary
//! files with `solid`. Otherwise a file that begins with `solid` and continues as text is ASCII, and any other file is damaged. Facet
//! normals and attribute bytes are ignored. ASCII is read word by word, regardless of line breaks. Only names end with their lines.

use std::path::Path;

use cutaway::error::{Diagnostic, Error, Result};
use cutaway::scene::Mesh;
use cutaway::scene::weld::{thousands, weld_soup};
use glam::DVec3;
use rayon::prelude::*;

use super::lines::lines;
use super::{Draft, DraftWelding, Group, without_mark};

const HEADER_BYTES: usize = 84;
const FACET_BYTES: usize = 50;
const CUT_OFF: &str = "the file is cut off or damaged: export or download it again";

/// Returns true if `bytes` has exactly the length that a binary file with the stated facet count has.
pub(super) fn is_binary(bytes: &[u8]) -> bool {
    // If the bytes are text, the count is so large that the product overflows on 32-bit targets.
    stated_facets(bytes).is_some_and(|n| {
        let length = n.checked_mul(FACET_BYTES);
        length.and_then(|l| l.checked_add(HEADER_BYTES)) == Some(bytes.len())
    })
}

pub(super) fn read(path: &Path, bytes: &[u8], notes: &mut Vec<Diagnostic>) -> Result<Draft> {
    let stated = stated_facets(bytes);
    let text = without_mark(bytes);
    if !is_binary(bytes) && is_text(text) {
        return ascii(path, &String::from_utf8_lossy(text));
    }
    let Some(stated) = stated else {
        let what = format!(
            "a binary STL has a header of {HEADER_BYTES} bytes, but the file has only {}",
            bytes.len()
        );
        return Err(Error::file(path, what, CUT_OFF));
    };
    let found = (bytes.len() - HEADER_BYTES) / FACET_BYTES;
    if found < stated {
        let what = format!(
            "the header states {} triangles, but the file has {}",
            thousands(stated),
            thousands(found)
        );
        return Err(Error::file(path, what, CUT_OFF));
    }
    let extra = bytes.len() - HEADER_BYTES - FACET_BYTES * stated;
    if extra > 0 {
        notes.push(Diagnostic::note(
            "trailing-bytes",
            format!("ignored {extra} bytes after the last triangle"),
        ));
    }
    Ok(binary(
        &bytes[HEADER_BYTES..HEADER_BYTES + FACET_BYTES * stated],
    ))
}

/// The triangle count in the header of a binary file.
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
    let count = facets.len() / FACET_BYTES;
    let corner = |index: usize| {
        // The normal comes first: 12 bytes.
        let at = FACET_BYTES * (index / 3) + 12 * (1 + index % 3);
        let number = |k: usize| {
            let bytes = facets[at + 4 * k..].first_chunk();
            f64::from(bytes.map_or(f32::NAN, |b| f32::from_le_bytes(*b)))
        };
        DVec3::new(number(0), number(1), number(2))
    };
    let corners = (0..3 * count).into_par_iter().with_min_len(1 << 14);
    if count == 0 || !corners.clone().all(|index| corner(index).is_finite()) {
        // What is wrong with the file is found in its own order of corners.
        let triangle = |t: usize| [0, 1, 2].map(|k| (3 * t + k) as u32);
        return Draft {
            mesh: Mesh {
                positions: corners.map(corner).collect(),
                triangles: (0..count).map(triangle).collect(),
                ..Mesh::default()
            },
            ..Draft::default()
        };
    }
    let soup = weld_soup(count, corner);
    Draft {
        mesh: Mesh {
            positions: soup.positions,
            triangles: soup.triangles,
            ..Mesh::default()
        },
        welding: Some(DraftWelding {
            note: soup.note,
            open: soup.open,
        }),
        ..Draft::default()
    }
}

fn push_triangle(mesh: &mut Mesh, corners: [DVec3; 3]) {
    let first = mesh.positions.len() as u32;
    mesh.positions.extend(corners);
    mesh.triangles.push([first, first + 1, first + 2]);
}

/// The words that begin a statement in an ASCII file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Keyword {
    Solid,
    Facet,
    Outer,
    Vertex,
    EndLoop,
    EndFacet,
    EndSolid,
}

impl Keyword {
    const NAMED: [(&'static str, Self); 7] = [
        ("vertex", Self::Vertex),
        ("facet", Self::Facet),
        ("outer", Self::Outer),
        ("endloop", Self::EndLoop),
        ("endfacet", Self::EndFacet),
        ("solid", Self::Solid),
        ("endsolid", Self::EndSolid),
    ];

    fn named(word: &str) -> Option<Self> {
        let mut all = Self::NAMED.iter();
        let found = all.find(|(name, _)| word.eq_ignore_ascii_case(name));
        found.map(|(_, keyword)| *keyword)
    }
}

/// An ASCII file, read word by word.
struct AsciiReader<'a> {
    path: &'a Path,
    draft: Draft,
    corners: Vec<DVec3>,
    /// If a vertex is incomplete, the number and the values of the coordinates that have been read.
    vertex: Option<(usize, [f64; 3])>,
    is_in_solid: bool,
}

fn ascii(path: &Path, text: &str) -> Result<Draft> {
    let mut reader = AsciiReader {
        path,
        draft: Draft::default(),
        corners: Vec::with_capacity(3),
        vertex: None,
        is_in_solid: false,
    };
    let mut last_line = 1;
    for (number, line) in (1..).zip(lines(text)) {
        if !line.trim().is_empty() {
            last_line = number;
            reader.line(number, line)?;
        }
    }
    if reader.is_in_solid || !reader.corners.is_empty() {
        let found = thousands(reader.draft.mesh.triangles.len());
        let what = format!("the file ends after {found} triangles without `endsolid`");
        return Err(reader.error(last_line, what));
    }
    Ok(reader.draft)
}

impl AsciiReader<'_> {
    fn error(&self, line: usize, what: String) -> Error {
        Error::file_line(self.path, line, what, CUT_OFF)
    }

    fn line(&mut self, number: usize, line: &str) -> Result<()> {
        let mut rest = line;
        let mut is_first = true;
        while let Some((word, behind)) = first_word(rest) {
            rest = behind;
            match Keyword::named(word) {
                Some(keyword) => {
                    if let Some((count, _)) = self.vertex {
                        let what = format!("a vertex has only {count} of 3 numbers");
                        return Err(self.error(number, what));
                    }
                    rest = self.statement(number, keyword, rest)?;
                }
                None if self.vertex.is_some() => self.coordinate(number, word)?,
                // The numbers of normals, and words such as `loop`, may appear anywhere.
                None if is_first && !is_passed_over(word) => {
                    let what = format!("`{word}` is not an ASCII STL keyword");
                    return Err(self.error(number, what));
                }
                None => {}
            }
            is_first = false;
        }
        Ok(())
    }

    /// Processes a statement and returns the rest of its line.
    fn statement<'t>(&mut self, line: usize, keyword: Keyword, rest: &'t str) -> Result<&'t str> {
        match keyword {
            Keyword::Solid => {
                self.is_in_solid = true;
                let (name, rest) = before_facet(rest);
                let name = Some(name.trim().to_owned()).filter(|n| !n.is_empty());
                self.draft.groups.push(Group {
                    name,
                    ..Group::default()
                });
                return Ok(rest);
            }
            Keyword::EndSolid => {
                self.is_in_solid = false;
                // The solid's name; the first facet may follow on the same line.
                let (name, facets) = before_facet(rest);
                let next = name.to_ascii_lowercase().rfind("solid ");
                return Ok(match next {
                    Some(next) if !facets.is_empty() => &rest[next..],
                    _ => "",
                });
            }
            Keyword::Vertex => self.vertex = Some((0, [0.0; 3])),
            Keyword::EndFacet => {
                let Ok(three) = <[DVec3; 3]>::try_from(self.corners.as_slice()) else {
                    let found = self.corners.len();
                    return Err(
                        self.error(line, format!("a facet has {found} corners, it needs 3"))
                    );
                };
                self.corners.clear();
                push_triangle(&mut self.draft.mesh, three);
                let group = self.draft.groups.len() as u32 - 1;
                self.draft.group_of_triangle.push(group);
            }
            Keyword::Facet | Keyword::Outer | Keyword::EndLoop => {}
        }
        Ok(rest)
    }

    fn coordinate(&mut self, line: usize, word: &str) -> Result<()> {
        let number: f64 = word
            .parse()
            .map_err(|_| self.error(line, format!("`{word}` is not a number")))?;
        if !number.is_finite() {
            return Err(self.error(line, format!("a vertex has the coordinate {word}")));
        }
        let (count, mut numbers) = self.vertex.take().unwrap_or_default();
        numbers[count] = number;
        match count {
            2 => self.corners.push(DVec3::from(numbers)),
            _ => self.vertex = Some((count + 1, numbers)),
        }
        Ok(())
    }
}

fn first_word(text: &str) -> Option<(&str, &str)> {
    let text = text.trim_start();
    let end = text.find(char::is_whitespace).unwrap_or(text.len());
    (end > 0).then(|| text.split_at(end))
}

/// Returns true for a word that may begin a line without being a statement.
fn is_passed_over(word: &str) -> bool {
    let is_number = || word.parse::<f64>().is_ok();
    word.eq_ignore_ascii_case("normal") || word.eq_ignore_ascii_case("loop") || is_number()
}

/// Splits a text at its first facet. A name extends to the end of its line, or to a facet on the same line.
fn before_facet(text: &str) -> (&str, &str) {
    let mut rest = text;
    while let Some((word, behind)) = first_word(rest) {
        let next = first_word(behind).map_or("", |(next, _)| next);
        if word.eq_ignore_ascii_case("facet") && next.eq_ignore_ascii_case("normal") {
            return text.split_at(text.len() - behind.len() - word.len());
        }
        rest = behind;
    }
    (text, "")
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
        let [_, _, corner] = draft.mesh.corners(2);
        assert_eq!(corner, DVec3::new(0.0, 1.0, 2.0));
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
                .contains("4,000,000,000 triangles, but the file has 2")
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
        assert!(notes[0].text.contains("7 bytes"), "{notes:?}");
    }
}
