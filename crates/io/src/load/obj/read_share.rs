//! Reads a share of the lines of an OBJ file.
//!
//! Indices that count backwards, and whether an index is defined yet, depend on the number of elements before the share, so these are
//! counted first.

use std::borrow::Cow;
use std::path::Path;

use cutaway::error::{Error, Result};
use glam::DVec3;

use super::share::{Label, ObjShare};
use crate::load::lines::{Lines, lines_ending};

/// First words of lines that do not affect the surface, such as parameter coordinates, smoothing, points, lines and display settings.
const PASSED_OVER: [&str; 13] = [
    "",
    "vp",
    "s",
    "mg",
    "p",
    "l",
    "bevel",
    "c_interp",
    "d_interp",
    "lod",
    "maplib",
    "usemap",
    "shadow_obj",
];

/// Number of elements and lines.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct ElementCounts {
    pub(super) lines: usize,
    pub(super) positions: usize,
    pub(super) places: usize,
    pub(super) normals: usize,
}

impl ElementCounts {
    /// Counts the elements of a text.
    pub(super) fn of(text: &str, line_end: char) -> Self {
        let mut counts = Self::default();
        let mut statements = Statements::of(text, line_end, 0);
        for (_, line) in statements.by_ref() {
            match first_word(&line) {
                "v" => counts.positions += 1,
                "vt" => counts.places += 1,
                "vn" => counts.normals += 1,
                _ => {}
            }
        }
        counts.lines = statements.number;
        counts
    }

    pub(super) fn and(self, other: Self) -> Self {
        Self {
            lines: self.lines + other.lines,
            positions: self.positions + other.positions,
            places: self.places + other.places,
            normals: self.normals + other.normals,
        }
    }
}

/// Indices of a face corner, from 0.
#[derive(Clone, Copy, Debug)]
struct ObjCorner {
    position: u32,
    place: Option<u32>,
    normal: Option<u32>,
}

/// Reader of the lines of a share.
struct ShareReader<'a> {
    path: &'a Path,
    before: ElementCounts,
    share: ObjShare,
    polygon: Vec<ObjCorner>,
    /// Number of the label in force, once a triangle has it.
    label: Option<u32>,
}

/// Reads a share of the lines of a file, after the elements `before` it.
pub(super) fn read(
    path: &Path,
    text: &str,
    line_end: char,
    before: ElementCounts,
) -> Result<ObjShare> {
    let mut reader = ShareReader {
        path,
        before,
        share: ObjShare::default(),
        polygon: Vec::new(),
        label: None,
    };
    for (number, line) in Statements::of(text, line_end, before.lines) {
        reader.line(number, &line)?;
    }
    Ok(reader.share)
}

/// The lines of a text with their numbers. Lines that end with a backslash go on in the next line, and have its number.
struct Statements<'a> {
    lines: Lines<'a>,
    number: usize,
}

impl<'a> Statements<'a> {
    fn of(text: &'a str, line_end: char, lines_before: usize) -> Self {
        Self {
            lines: lines_ending(text, line_end),
            number: lines_before,
        }
    }
}

impl<'a> Iterator for Statements<'a> {
    type Item = (usize, Cow<'a, str>);

    fn next(&mut self) -> Option<Self::Item> {
        let mut continued = String::new();
        loop {
            let line = self.lines.next()?;
            self.number += 1;
            if let Some(head) = line.strip_suffix('\\') {
                continued.push_str(head);
                continued.push(' ');
            } else if continued.is_empty() {
                return Some((self.number, line.into()));
            } else {
                return Some((self.number, (continued + line).into()));
            }
        }
    }
}

/// The first word of a line; empty if there is none before a comment.
fn first_word(line: &str) -> &str {
    let line = line.trim_start();
    let end = line.find(|c: char| c.is_whitespace() || c == '#');
    &line[..end.unwrap_or(line.len())]
}

/// The first word of a line, and what follows it, without its comment.
fn split_word(line: &str) -> (&str, &str) {
    let word = first_word(line);
    let rest = &line.trim_start()[word.len()..];
    let rest = rest.split('#').next().unwrap_or(rest);
    (word, rest.trim())
}

impl ShareReader<'_> {
    fn line(&mut self, number: usize, line: &str) -> Result<()> {
        let (word, rest) = split_word(line);
        match word {
            "v" => {
                let p = self.three(number, rest, "a vertex")?;
                self.share.paint.color(self.share.positions.len(), rest);
                self.share.positions.push(DVec3::from(p));
            }
            "vt" => self.share.paint.place(rest),
            "vn" => {
                let n = DVec3::from(self.three(number, rest, "a normal")?);
                self.share.normals.push(n.normalize_or_zero().as_vec3());
            }
            "f" | "fo" => self.face(number, rest)?,
            "o" => self.relabel().object = Some(rest.to_owned()),
            "g" => self.relabel().group = Some(rest.to_owned()),
            "usemtl" => self.relabel().material = Some(rest.to_owned()),
            "mtllib" => self.share.libraries.push(rest.to_owned()),
            _ if PASSED_OVER.contains(&word) => {}
            _ => self.share.unknown_words.add(number, word),
        }
        Ok(())
    }

    fn error(&self, line: usize, what: impl Into<String>) -> Error {
        super::error(self.path, line, what)
    }

    fn three(&self, line: usize, rest: &str, what: &str) -> Result<[f64; 3]> {
        let mut numbers = [0.0_f64; 3];
        let mut words = rest.split_ascii_whitespace();
        for (k, n) in numbers.iter_mut().enumerate() {
            let word = words
                .next()
                .ok_or_else(|| self.error(line, format!("{what} has only {k} of 3 numbers")))?;
            *n = word
                .parse()
                .map_err(|_| self.error(line, format!("`{word}` is not a number")))?;
            if !n.is_finite() {
                return Err(self.error(line, format!("{what} has the coordinate {word}")));
            }
        }
        Ok(numbers)
    }

    fn relabel(&mut self) -> &mut Label {
        self.label = None;
        &mut self.share.label
    }

    fn face(&mut self, line: usize, rest: &str) -> Result<()> {
        self.polygon.clear();
        for word in rest.split_ascii_whitespace() {
            let corner = self.corner(line, word)?;
            self.polygon.push(corner);
        }
        if self.polygon.len() < 3 {
            let found = self.polygon.len();
            return Err(self.error(line, format!("a face has {found} corners, it needs 3")));
        }
        let label = self.current_label();
        for k in 2..self.polygon.len() {
            let t = [0, k - 1, k].map(|k| self.polygon[k]);
            let before = self.share.triangles.len();
            self.share.triangles.push(t.map(|c| c.position));
            self.share.label_of_triangle.push(label);
            self.share.paint.corners(before, t.map(|c| c.place));
            let normals = match t.map(|c| c.normal) {
                [Some(a), Some(b), Some(c)] => Some([a, b, c]),
                _ => None,
            };
            if normals.is_some() || !self.share.normal_of_corner.is_empty() {
                self.share.normal_of_corner.resize(before, None);
                self.share.normal_of_corner.push(normals);
            }
        }
        Ok(())
    }

    /// `v`, `v/vt`, `v//vn` or `v/vt/vn`.
    fn corner(&mut self, line: usize, word: &str) -> Result<ObjCorner> {
        let mut fields = word.split('/');
        let position = fields.next().unwrap_or("");
        let place = fields.next().and_then(|word| word.parse().ok());
        let normal = fields.next().filter(|f| !f.is_empty());
        if fields.next().is_some() {
            return Err(self.error(line, format!("`{word}` has more than two slashes")));
        }
        let places = self.before.places + self.share.paint.places.len();
        let place = place.and_then(|index| from_zero(index, places));
        Ok(ObjCorner {
            position: self.position(line, position)?,
            place: place.and_then(|place| u32::try_from(place).ok()),
            normal: normal.and_then(|n| self.normal(line, n)),
        })
    }

    /// Parses the index of a normal. Returns `None` if the index cannot be valid.
    fn normal(&mut self, line: usize, word: &str) -> Option<u32> {
        let known = self.before.normals + self.share.normals.len();
        let from_zero = word.parse().ok().and_then(|index| from_zero(index, known));
        match from_zero {
            Some(index) => {
                self.note_ahead(1, index, known, line);
                u32::try_from(index).ok()
            }
            None => {
                self.share.no_normals.add(line, word);
                None
            }
        }
    }

    fn position(&mut self, line: usize, word: &str) -> Result<u32> {
        let known = self.before.positions + self.share.positions.len();
        let index: i64 = word
            .parse()
            .map_err(|_| self.error(line, format!("`{word}` is not the index of a vertex")))?;
        let Some(from_zero) = from_zero(index, known) else {
            let what =
                format!("a face refers to vertex {index}, but only {known} are defined so far");
            return Err(self.error(line, what));
        };
        self.note_ahead(0, from_zero, known, line);
        u32::try_from(from_zero)
            .map_err(|_| self.error(line, format!("a face refers to vertex {index}")))
    }

    /// Records the index of a vertex or normal that may be defined later.
    fn note_ahead(&mut self, kind: usize, index: usize, known: usize, line: usize) {
        let ahead = &mut self.share.ahead[kind];
        if index >= known && ahead.is_none_or(|a| a.0 < index) {
            *ahead = Some((index, line));
        }
    }

    fn current_label(&mut self) -> u32 {
        if let Some(label) = self.label {
            return label;
        }
        let number = self.share.labels.number(&self.share.label);
        self.label = Some(number);
        number
    }
}

/// Converts an index that counts from 1, or backwards from -1, to an index that counts from 0.
fn from_zero(index: i64, known: usize) -> Option<usize> {
    let from_zero = if index > 0 {
        index - 1
    } else {
        index + known as i64
    };
    (index != 0).then_some(from_zero)?.try_into().ok()
}
