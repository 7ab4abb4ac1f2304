//! Reads Wavefront OBJ: `v`, `vn`, `f`, `o`, `g`, `usemtl`, `mtllib`. Other lines are ignored.
//!
//! This reader exists because available OBJ crates drop data that topology needs. Here positions stay shared across objects, groups and
//! materials, by their index in the file, and every error gives its line. Polygons become fans from their first corner. The fan of a
//! concave polygon may overlap itself, but its outline and thus the parity of every ray are unchanged. A face only needs positions. Colours
//! and texture coordinates are used if valid ([`obj_vertex_paint`](super::obj_vertex_paint)). An invalid normal index is dropped with a
//! note, as is a line whose first word is unknown.
//!
//! Cost: one pass over the text. If a file is truncated between two lines, that is only detected if a face refers to a missing vertex.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use cutaway::error::{Diagnostic, Error, Result};
use glam::{DVec3, Vec3};

use super::lines::lines;
use super::obj_vertex_paint::ObjVertexPaint;
use super::painted::Paint;
use super::{Draft, Files, Group, mtl, without_mark};

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

/// Triangles belong to the same group if they have the same label.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
struct Label {
    object: String,
    group: String,
    material: String,
}

/// The largest index that a face used before it was defined, and the line of that face.
type ForwardReference = Option<(usize, usize)>;

/// A kind of element that is left out, with the line and text of its first occurrence, and its total count.
#[derive(Debug, Default)]
struct LeftOut {
    first: Option<(usize, String)>,
    count: usize,
}

impl LeftOut {
    fn add(&mut self, line: usize, what: &str) {
        self.first.get_or_insert_with(|| (line, what.to_owned()));
        self.count += 1;
    }
}

/// Indices of a face corner, from 0.
#[derive(Clone, Copy, Debug)]
struct ObjCorner {
    position: u32,
    place: Option<u32>,
    normal: Option<u32>,
}

struct ObjReader<'a> {
    path: &'a Path,
    draft: Draft,
    normals: Vec<Vec3>,
    corner_normals: Vec<[Vec3; 3]>,
    /// For each corner, its index into `normals`. Resolved at the end, because a face may precede its normals.
    normal_of_corner: Vec<Option<[u32; 3]>>,
    vertex_paint: ObjVertexPaint,
    label: Label,
    labels: HashMap<Label, u32>,
    group: Option<u32>,
    libraries: Vec<String>,
    ahead: [ForwardReference; 2],
    unknown_words: LeftOut,
    no_normals: LeftOut,
}

pub(super) fn read(
    path: &Path,
    bytes: &[u8],
    store: &dyn Files,
    notes: &mut Vec<Diagnostic>,
    files: &mut Vec<PathBuf>,
) -> Result<Draft> {
    if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) {
        let what = "the text is encoded in UTF-16";
        return Err(Error::file(path, what, "save it as plain text in UTF-8"));
    }
    let text = String::from_utf8_lossy(without_mark(bytes));
    let mut reader = ObjReader {
        path,
        draft: Draft::default(),
        normals: Vec::new(),
        corner_normals: Vec::new(),
        normal_of_corner: Vec::new(),
        vertex_paint: ObjVertexPaint::default(),
        label: Label::default(),
        labels: HashMap::new(),
        group: None,
        libraries: Vec::new(),
        ahead: [None; 2],
        unknown_words: LeftOut::default(),
        no_normals: LeftOut::default(),
    };
    let mut continued = String::new();
    for (number, line) in (1..).zip(lines(&text)) {
        if let Some(head) = line.strip_suffix('\\') {
            continued.push_str(head);
            continued.push(' ');
        } else if continued.is_empty() {
            reader.line(number, line)?;
        } else {
            continued.push_str(line);
            reader.line(number, &std::mem::take(&mut continued))?;
        }
    }
    reader.finish(store, notes, files)
}

impl ObjReader<'_> {
    fn line(&mut self, number: usize, line: &str) -> Result<()> {
        let line = line.split('#').next().unwrap_or(line).trim();
        let (word, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
        let rest = rest.trim_start();
        match word {
            "v" => {
                let p = self.three(number, rest, "a vertex")?;
                self.vertex_paint
                    .color(self.draft.mesh.positions.len(), rest);
                self.draft.mesh.positions.push(DVec3::from(p));
            }
            "vt" => self.vertex_paint.place(rest),
            "vn" => {
                let n = DVec3::from(self.three(number, rest, "a normal")?);
                self.normals.push(n.normalize_or_zero().as_vec3());
            }
            "f" | "fo" => self.face(number, rest)?,
            "o" => self.relabel(|l| l.object = rest.to_owned()),
            "g" => self.relabel(|l| l.group = rest.to_owned()),
            "usemtl" => self.relabel(|l| l.material = rest.to_owned()),
            "mtllib" => self.libraries.push(rest.to_owned()),
            _ if PASSED_OVER.contains(&word) => {}
            _ => self.unknown_words.add(number, word),
        }
        Ok(())
    }

    fn error(&self, line: usize, what: impl Into<String>) -> Error {
        let help = "correct the line, or export the file again if it is damaged or cut off";
        Error::file_line(self.path, line, what, help)
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

    fn relabel(&mut self, change: impl FnOnce(&mut Label)) {
        change(&mut self.label);
        self.group = None;
    }

    fn face(&mut self, line: usize, rest: &str) -> Result<()> {
        let mut polygon: Vec<ObjCorner> = Vec::with_capacity(4);
        for word in rest.split_ascii_whitespace() {
            polygon.push(self.corner(line, word)?);
        }
        if polygon.len() < 3 {
            let found = polygon.len();
            return Err(self.error(line, format!("a face has {found} corners, it needs 3")));
        }
        let group = self.current_group();
        for k in 2..polygon.len() {
            let t = [polygon[0], polygon[k - 1], polygon[k]];
            self.draft.mesh.triangles.push(t.map(|c| c.position));
            self.draft.group_of_triangle.push(group);
            self.vertex_paint.corners(t.map(|c| c.place));
            self.normal_of_corner.push(match t.map(|c| c.normal) {
                [Some(a), Some(b), Some(c)] => Some([a, b, c]),
                _ => None,
            });
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
        let place = place.and_then(|index| from_zero(index, self.vertex_paint.places.len()));
        Ok(ObjCorner {
            position: self.position(line, position)?,
            place: place.and_then(|place| u32::try_from(place).ok()),
            normal: normal.and_then(|n| self.normal(line, n)),
        })
    }

    /// Parses the index of a normal. Returns `None` if the index cannot be valid.
    fn normal(&mut self, line: usize, word: &str) -> Option<u32> {
        let known = self.normals.len();
        let from_zero = word.parse().ok().and_then(|index| from_zero(index, known));
        match from_zero {
            Some(index) => {
                self.note_ahead(1, index, known, line);
                u32::try_from(index).ok()
            }
            None => {
                self.no_normals.add(line, word);
                None
            }
        }
    }

    fn position(&mut self, line: usize, word: &str) -> Result<u32> {
        let known = self.draft.mesh.positions.len();
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
        if index >= known && self.ahead[kind].is_none_or(|a| a.0 < index) {
            self.ahead[kind] = Some((index, line));
        }
    }

    fn current_group(&mut self) -> u32 {
        if let Some(group) = self.group {
            return group;
        }
        let next = self.labels.len() as u32;
        let group = *self.labels.entry(self.label.clone()).or_insert(next);
        if group == next {
            let Label {
                object,
                group,
                material,
            } = &self.label;
            let name = [object, group, material]
                .into_iter()
                .find(|n| !n.is_empty());
            self.draft.groups.push(Group {
                name: name.cloned(),
                material: Some(material.clone()).filter(|m| !m.is_empty()),
                ..Group::default()
            });
        }
        self.group = Some(group);
        group
    }

    /// Removes the normals of faces that refer to missing normals.
    fn drop_missing_normals(&mut self) {
        let there = self.normals.len();
        let Some((_, line)) = self.ahead[1].filter(|a| a.0 >= there) else {
            return;
        };
        for normals in &mut self.normal_of_corner {
            let missing = |all: &[u32; 3]| all.iter().find(|i| **i as usize >= there).copied();
            if let Some(index) = normals.as_ref().and_then(missing) {
                *normals = None;
                self.no_normals.add(line, &(index + 1).to_string());
            }
        }
    }

    fn notes_of_left_out(&self) -> Vec<Diagnostic> {
        let and_more = |count: usize| match count {
            1 => String::new(),
            count => format!(" (and {} more)", count - 1),
        };
        let mut notes = Vec::new();
        if let Some((line, word)) = &self.unknown_words.first {
            let more = and_more(self.unknown_words.count);
            let word: String = word.chars().take(40).collect();
            notes.push(
                Diagnostic::note(
                    "obj-unknown-keyword",
                    format!("ignored the line: {word:?} is not an OBJ keyword{more}"),
                )
                .at_line(self.path, *line),
            );
        }
        if let Some((line, index)) = &self.no_normals.first {
            let (there, more) = (self.normals.len(), and_more(self.no_normals.count));
            notes.push(Diagnostic::note("obj-normal-missing", format!(
                "a face refers to normal {index}, but there are {there}{more}: the file's normals are not used"
            )).at_line(self.path, *line));
        }
        notes
    }

    fn finish(
        mut self,
        store: &dyn Files,
        notes: &mut Vec<Diagnostic>,
        files: &mut Vec<PathBuf>,
    ) -> Result<Draft> {
        let vertices = self.draft.mesh.positions.len();
        if let Some((index, line)) = self.ahead[0].filter(|a| a.0 >= vertices) {
            let index = index + 1;
            let what = format!("a face refers to vertex {index}, but there are only {vertices}");
            return Err(self.error(line, what));
        }
        self.drop_missing_normals();
        notes.extend(self.notes_of_left_out());
        let with_normals = self.normal_of_corner.iter().flatten().count();
        if with_normals == self.normal_of_corner.len() {
            let pick = |t: &[u32; 3]| t.map(|i| self.normals[i as usize]);
            self.corner_normals = self.normal_of_corner.iter().flatten().map(pick).collect();
            self.draft.mesh.corner_normals = Some(self.corner_normals);
        } else if with_normals > 0 && self.no_normals.count == 0 {
            notes.push(Diagnostic::note(
                "obj-some-normals",
                "only some faces have normals: they are not used",
            ));
        }
        let paints = mtl::read_all(self.path, &self.libraries, store, (notes, files));
        let paints: Vec<Paint> = (sorted(self.labels).into_iter())
            .map(|(label, _)| paints.get(&label.material).cloned().unwrap_or_default())
            .collect();
        for (group, paint) in self.draft.groups.iter_mut().zip(&paints) {
            group.color = paint.color;
            group.is_transparent = paint.is_transparent;
        }
        let mesh = &mut self.draft.mesh;
        mesh.vertex_paint =
            self.vertex_paint
                .finish(&mesh.triangles, &self.draft.group_of_triangle, &paints);
        Ok(self.draft)
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

fn sorted(labels: HashMap<Label, u32>) -> Vec<(Label, u32)> {
    let mut all: Vec<_> = labels.into_iter().collect();
    all.sort_by_key(|(_, group)| *group);
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::load::Memory;

    fn parse(text: &str) -> Result<Draft> {
        read(
            Path::new("t.obj"),
            text.as_bytes(),
            &Memory::default(),
            &mut Vec::new(),
            &mut Vec::new(),
        )
    }

    #[test]
    fn polygons_negative_indices_and_continued_lines() {
        let text = "v 0 0 0\nv 1 0 0 0.5 0.5 0.5\nv 1 1 0 # corner\nv 0 1 0\nf -4 -3 \\\n -2 -1\n";
        let draft = parse(text).unwrap();
        assert_eq!(draft.mesh.triangles, [[0, 1, 2], [0, 2, 3]]);
        assert_eq!(draft.mesh.positions.len(), 4);
    }

    #[test]
    fn positions_stay_shared_across_normals_groups_and_materials() {
        let text = "vn 0 0 1\nvn 1 0 0\nv 0 0 0\nv 1 0 0\nv 0 1 0\ng a\nf 1//1 2//1 3//1\nusemtl m\nf 1//2 2//2 3//2\ng a\n";
        let draft = parse(text).unwrap();
        assert_eq!(draft.mesh.triangles, [[0, 1, 2]; 2]);
        assert_eq!(draft.group_of_triangle, [0, 1]);
        let normals = draft.mesh.corner_normals.unwrap();
        assert_eq!((normals[0][0], normals[1][0]), (Vec3::Z, Vec3::X));
    }

    #[test]
    fn normals_that_are_not_there_are_dropped_with_a_note() {
        let vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\n";
        for (face, is_noted) in [
            ("f 1//1 2//1 3//1", false),
            ("f 1/7/1 2/8/1 3/9/1", false),
            ("f 1//1 2//2 3//1", true),
            ("f 1//1 2//-2 3//1", true),
            ("f 1//0 2//1 3//1", true),
            ("f 1//x 2//1 3//1", true),
        ] {
            let (text, mut notes) = (format!("{vertices}{face}\n"), Vec::new());
            let draft = read(
                Path::new("t.obj"),
                text.as_bytes(),
                &Memory::default(),
                &mut notes,
                &mut Vec::new(),
            )
            .unwrap();
            assert_eq!(draft.mesh.triangles, [[0, 1, 2]], "{face}");
            assert_eq!(draft.mesh.corner_normals.is_none(), is_noted, "{face}");
            let has_note = notes.iter().any(|n| n.to_string().starts_with("t.obj:5: "));
            assert_eq!(has_note, is_noted, "{face}: {notes:?}");
        }
    }

    #[test]
    fn complaints_name_the_line() {
        for (text, line, word) in [
            ("v 0 0 0\nv 1 0 x\n", 2, "`x`"),
            ("v 0 0\n", 1, "2 of 3"),
            ("v 0 0 nan\n", 1, "nan"),
            ("v 0 0 0\nf 1 1 2\n", 2, "vertex 2"),
            ("v 0 0 0\nf 1 0 1\n", 2, "vertex 0"),
            ("v 0 0 0\nf 1 -2 1\n", 2, "vertex -2"),
            ("v 0 0 0\nf 1 1\n", 2, "2 corners"),
            ("v 0 0 0\nf 1/1/1/1 1 1\n", 2, "slashes"),
            ("v 0 0 0\nf 1 1 99999999999999999999\n", 2, "not the index"),
        ] {
            let said = parse(text).unwrap_err().to_string();
            assert!(
                said.starts_with(&format!("t.obj:{line}: ")) && said.contains(word),
                "{said}"
            );
        }
    }
}
