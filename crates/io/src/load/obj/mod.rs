//! Reads Wavefront OBJ: `v`, `vn`, `f`, `o`, `g`, `usemtl`, `mtllib`. Other lines are ignored.
//!
//! This reader exists because available OBJ crates drop data that topology needs. Here positions stay shared across objects, groups and
//! materials, by their index in the file, and every error gives its line. Polygons become fans from their first corner. The fan of a
//! concave polygon may overlap itself, but its outline and thus the parity of every ray are unchanged. A face only needs positions. Colours
//! and texture coordinates are used if valid ([`vertex_paint`]). An invalid normal index is dropped with a note, as is a line whose first
//! word is unknown.
//!
//! Large files are read in [shares](read_share) of their lines, in parallel.
//!
//! Cost: two passes over the text, of which the first counts elements. Memory: the mesh twice, while shares are joined. If a file is truncated
//! between two lines, that is only detected if a face refers to a missing vertex.

mod read_share;
mod share;
mod vertex_paint;

use std::path::{Path, PathBuf};

use cutaway::error::{Diagnostic, Error, Result};
use cutaway::scene::Mesh;
use rayon::prelude::*;

use super::lines::line_end;
use super::painted::Paint;
use super::{Draft, Files, Group, mtl, without_mark};
use read_share::ElementCounts;
use share::{Label, ObjShare};

/// Fewest bytes of a share.
const LEAST_SHARE: usize = 1 << 20;

/// Shares for each thread, so that threads end at about the same time.
const SHARES_PER_THREAD: usize = 4;

/// The shares of a file, joined.
struct ObjReader<'a> {
    path: &'a Path,
    whole: ObjShare,
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
    let share = bytes.len() / (SHARES_PER_THREAD * rayon::current_num_threads());
    read_in_shares(path, bytes, share.max(LEAST_SHARE), store, (notes, files))
}

fn read_in_shares(
    path: &Path,
    bytes: &[u8],
    share: usize,
    store: &dyn Files,
    (notes, files): (&mut Vec<Diagnostic>, &mut Vec<PathBuf>),
) -> Result<Draft> {
    let bytes = without_mark(bytes);
    let line_end = line_end(bytes);
    let texts: Vec<_> = shares_of(bytes, line_end as u8, share)
        .into_par_iter()
        .map(String::from_utf8_lossy)
        .collect();
    let counts: Vec<ElementCounts> = (texts.par_iter())
        .map(|text| ElementCounts::of(text, line_end))
        .collect();
    let mut before = Vec::with_capacity(counts.len());
    let mut all = ElementCounts::default();
    for counts in counts {
        before.push(all);
        all = all.and(counts);
    }
    let shares: Vec<Result<ObjShare>> = (texts.into_par_iter().zip(before))
        .map(|(text, before)| read_share::read(path, &text, line_end, before))
        .collect();
    // The first error in the file is reported.
    let shares: Vec<ObjShare> = shares.into_iter().collect::<Result<_>>()?;
    let whole = ObjShare::joined(shares);
    ObjReader { path, whole }.finish(store, notes, files)
}

/// Splits a text at ends of lines that do not continue in the next line.
fn shares_of(bytes: &[u8], line_end: u8, share: usize) -> Vec<&[u8]> {
    let ends_statement = |at: usize| {
        let line = &bytes[..at];
        bytes[at] == line_end && !line.strip_suffix(b"\r").unwrap_or(line).ends_with(b"\\")
    };
    let mut shares = Vec::new();
    let mut start = 0;
    while start < bytes.len() {
        let least = (start + share).min(bytes.len());
        let end = (least..bytes.len()).find(|at| ends_statement(*at));
        let end = end.map_or(bytes.len(), |end| end + 1);
        shares.push(&bytes[start..end]);
        start = end;
    }
    shares
}

fn error(path: &Path, line: usize, what: impl Into<String>) -> Error {
    let help = "correct the line, or export the file again if it is damaged or cut off";
    Error::file_line(path, line, what, help)
}

impl ObjReader<'_> {
    /// Removes the normals of faces that refer to missing normals.
    fn drop_missing_normals(&mut self) {
        let there = self.whole.normals.len();
        let Some((_, line)) = self.whole.ahead[1].filter(|a| a.0 >= there) else {
            return;
        };
        for normals in &mut self.whole.normal_of_corner {
            let missing = |all: &[u32; 3]| all.iter().find(|i| **i as usize >= there).copied();
            if let Some(index) = normals.as_ref().and_then(missing) {
                *normals = None;
                self.whole.no_normals.add(line, &(index + 1).to_string());
            }
        }
    }

    fn notes_of_left_out(&self) -> Vec<Diagnostic> {
        let and_more = |count: usize| match count {
            1 => String::new(),
            count => format!(" (and {} more)", count - 1),
        };
        let mut notes = Vec::new();
        if let Some((line, word)) = &self.whole.unknown_words.first {
            let more = and_more(self.whole.unknown_words.count);
            let word: String = word.chars().take(40).collect();
            notes.push(
                Diagnostic::note(
                    "obj-unknown-keyword",
                    format!("ignored the line: {word:?} is not an OBJ keyword{more}"),
                )
                .at_line(self.path, *line),
            );
        }
        if let Some((line, index)) = &self.whole.no_normals.first {
            let (there, more) = (
                self.whole.normals.len(),
                and_more(self.whole.no_normals.count),
            );
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
        let vertices = self.whole.positions.len();
        if let Some((index, line)) = self.whole.ahead[0].filter(|a| a.0 >= vertices) {
            let index = index + 1;
            let what = format!("a face refers to vertex {index}, but there are only {vertices}");
            return Err(error(self.path, line, what));
        }
        self.drop_missing_normals();
        notes.extend(self.notes_of_left_out());
        let whole = self.whole;
        let with_normals = whole.normal_of_corner.iter().flatten().count();
        let mut corner_normals = None;
        if with_normals == whole.triangles.len() {
            let pick = |t: &[u32; 3]| t.map(|i| whole.normals[i as usize]);
            let all = whole.normal_of_corner.iter().flatten().map(pick);
            corner_normals = Some(all.collect());
        } else if with_normals > 0 && whole.no_normals.count == 0 {
            notes.push(Diagnostic::note(
                "obj-some-normals",
                "only some faces have normals: they are not used",
            ));
        }
        let materials = mtl::read_all(self.path, &whole.libraries, store, (notes, files));
        let labels = whole.labels.all();
        let paint = |label: &Label| {
            let material = label.material.as_ref().and_then(|name| materials.get(name));
            material.cloned().unwrap_or_default()
        };
        let paints: Vec<Paint> = labels.iter().map(paint).collect();
        let group = |(label, paint): (&Label, &Paint)| Group {
            color: paint.color,
            is_transparent: paint.is_transparent,
            ..label.group()
        };
        let vertex_paint =
            (whole.paint).finish(&whole.triangles, &whole.label_of_triangle, &paints);
        Ok(Draft {
            groups: labels.iter().zip(&paints).map(group).collect(),
            group_of_triangle: whole.label_of_triangle,
            mesh: Mesh {
                positions: whole.positions,
                triangles: whole.triangles,
                corner_normals,
                vertex_paint,
            },
            ..Draft::default()
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::load::Memory;
    use glam::Vec3;

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

    /// Reads a text in shares of about so many bytes; what was read, and what was said about it.
    fn in_shares(text: &str, share: usize) -> (String, Vec<String>) {
        let mut notes = Vec::new();
        let said = (&mut notes, &mut Vec::new());
        let files = Memory::default();
        let read = read_in_shares(Path::new("t.obj"), text.as_bytes(), share, &files, said);
        let read = read.map_or_else(|e| e.to_string(), |draft| format!("{draft:?}"));
        (read, notes.iter().map(ToString::to_string).collect())
    }

    #[test]
    fn shares_come_to_what_the_whole_file_comes_to() {
        let whole = "v 0 0 0\nf 1 2 3\nv 1 0 0 1 0 0\n# v 9 9 9\nv 0 \\\n 1 0\no a\nf -3 -2 -1\nvt 0 0\nvt 1 0\nvt 0 1\ng b\n\
            usemtl m\nf 1/1 2/2 3/3\nv 0 0 1 0 1 0\nusemtl n\nf 1/-3 -1/-2 3/-1\nbogus\nvn 0 0 1\nf 1//1 2//-1 4//1\nusemtl m\ng\n\
            f 1//9 2//1 4//1\no\nf 4 3 2 1\nbogus 2\n";
        let crlf = whole.replace('\n', "\r\n");
        let cr = whole.replace('\n', "\r");
        let cut_off = format!("{whole}f 1 2 \\");
        let unfinished = format!("{whole}f 1 2 3");
        let ahead = format!("f 1 2 7\n{whole}f 1 2 8\nf 1 2 8\n");
        let wrong = format!("{whole}f 1 2 -9\nf 1 x 2\n");
        for text in [whole, &crlf, &cr, &cut_off, &unfinished, &ahead, &wrong] {
            let expected = in_shares(text, usize::MAX / 2);
            for share in 0..80 {
                assert_eq!(in_shares(text, share), expected, "shares of {share} bytes");
            }
        }
        // The control: what is expected differs from text to text.
        let (read, notes) = in_shares(whole, 1);
        assert!(
            read.contains("groups: [Group") && notes.len() == 2,
            "{notes:?}"
        );
        assert!(
            in_shares(&ahead, 1).0.starts_with("t.obj:28: "),
            "{:?}",
            in_shares(&ahead, 1)
        );
        assert!(in_shares(&wrong, 1).0.contains("vertex -9"));
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
