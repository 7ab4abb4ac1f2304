//! Opens the meshes, frames and shapes that a document names, each once, and collects notes about them.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use cutaway::error::{Diagnostic, Error, Result};
use cutaway::scene::Part;
use cutaway::slice::close_holes_of;

use super::defects;
use super::described;
use super::part_source::PartSource;
use super::reader::{Entry, Table};
use super::solids::{BodySplits, SourceSolid, chosen};
use crate::document::Origin;
use crate::document::describe::PartDesc;
use crate::load::frames::{Pattern, Sequence, USUAL_FPS};
use crate::load::{Assets, OPEN_EDGES};

/// Context for opening the files that a document names.
pub(super) struct LoadContext<'a> {
    /// Folder to which file names are relative.
    pub(super) folder: &'a Path,
    pub(super) assets: &'a mut Assets,
    /// Notes about the opened files, without duplicates.
    pub(super) notes: Vec<Diagnostic>,
    /// Files that were read.
    pub(super) files: BTreeSet<PathBuf>,
}

impl LoadContext<'_> {
    /// Opens an entry.
    pub(super) fn entry(&mut self, table: &Table<'_>) -> Result<PartSource> {
        let (origin, text, is_mesh) = match (table.get("mesh"), table.get("shape")) {
            (Some(mesh), None) => (mesh.clone(), mesh.text()?.to_owned(), true),
            (None, Some(shape)) => (shape.clone(), spec_of(&shape)?, false),
            (Some(_), Some(shape)) => {
                return Err(shape.fault("the part also has a mesh", "keep one of the two"));
            }
            (None, None) => {
                let help = "add `mesh = \"FILE\"` or `shape = \"crank\"`";
                return Err(table.entry.fault("it has neither a mesh nor a shape", help));
            }
        };
        let path = self.folder.join(&text);
        if is_mesh && !self.assets.has_mesh(&path) && text.contains('%') {
            return self.frames(&origin, table);
        }
        for key in ["fps", "first", "loop"] {
            if let Some(entry) = table.get(key) {
                let help = "remove it, or name frames as in `mesh = \"walk_%04d.ply\"`";
                return Err(entry.fault("it is only valid for numbered frames", help));
            }
        }
        let parts = if is_mesh {
            self.opened(&origin, &text, closes_holes(table)?)?
        } else {
            self.shape(&origin, &text)?
        };
        if parts.is_empty() {
            return Err(origin.fault("it contains no solid", "use a file or shape with triangles"));
        }
        let alone = parts.len() == 1;
        let below = |_, part: &Part| (!alone).then(|| part.name.clone());
        let mut solids = SourceSolid::all(&parts, below);
        if let Some(mut splits) = BodySplits::asked_for(table, &solids)? {
            self.notes.push(splits.note(&match is_mesh {
                true => path.display().to_string(),
                false => format!("shape:{text}"),
            }));
            solids = splits.applied(solids);
        }
        let solids = self.taken(table, solids, true)?;
        Ok(PartSource::of(vec![solids], None))
    }

    /// The solids that an entry keeps, after its defects are applied and its holes are closed.
    fn taken(
        &mut self,
        table: &Table<'_>,
        solids: Vec<SourceSolid>,
        is_first: bool,
    ) -> Result<Vec<SourceSolid>> {
        let mut solids = chosen(table, solids)?;
        let parts = solids.iter_mut().map(|s| &mut s.part);
        defects::apply(table, parts, &mut self.notes)?;
        if closes_holes(table)? {
            let notes = close_holes_of(solids.iter_mut().map(|s| &mut s.part));
            // Only the notes of the first frame are kept, because those of later frames would be nearly the same.
            self.notes.extend(notes.into_iter().filter(|_| is_first));
        }
        Ok(solids)
    }

    /// The solids of a mesh file.
    pub(super) fn mesh(&mut self, origin: &Entry<'_>, name: &str) -> Result<Vec<Part>> {
        self.opened(origin, name, false)
    }

    /// Like `mesh`. If holes will be closed, the note about open edges is deferred until then.
    fn opened(&mut self, origin: &Entry<'_>, name: &str, closes_holes: bool) -> Result<Vec<Part>> {
        let path = self.folder.join(name);
        if !self.assets.has_mesh(&path) {
            return Err(missing(origin, &path));
        }
        let loaded = self.assets.mesh(&path)?;
        let parts = loaded.parts.clone();
        self.files.extend(loaded.files.iter().cloned());
        let is_deferred = |n: &Diagnostic| closes_holes && n.code == OPEN_EDGES;
        let is_new = |n: &&Diagnostic| !self.notes.contains(n) && !is_deferred(n);
        let new = loaded.notes.iter().filter(is_new);
        let new: Vec<Diagnostic> = new.cloned().collect();
        self.notes.extend(new);
        Ok(parts)
    }

    /// The solids of a built-in shape.
    pub(super) fn shape(&mut self, origin: &Entry<'_>, spec: &str) -> Result<Vec<Part>> {
        let parts = self.assets.shape(spec).map_err(|e| origin.place(e))?;
        Ok(parts.to_vec())
    }

    fn frames(&mut self, origin: &Entry<'_>, table: &Table<'_>) -> Result<PartSource> {
        let pattern = Pattern::parse(origin.text()?).map_err(|e| origin.place(e))?;
        let pattern = pattern.inside(self.folder);
        let desc: PartDesc = described::read(table)?;
        let fps = desc.fps.unwrap_or(USUAL_FPS);
        let sequence = Sequence::open_from(&pattern, desc.first, self.assets)
            .and_then(|s| s.timed(fps, desc.loops.unwrap_or(true)))
            .map_err(|e| origin.place(e))?;
        self.notes.extend(sequence.notes().iter().cloned());
        self.files.extend(sequence.files().iter().cloned());
        // If a frame has several solids, they are named after the sequence and their number.
        let several = sequence.frames().any(|parts| parts.len() > 1);
        let below = |index: usize, _: &Part| several.then(|| index.to_string());
        let frames = sequence
            .frames()
            .map(|parts| SourceSolid::all(parts, below));
        let mut frames: Vec<Vec<SourceSolid>> = frames.collect();
        if let Some(mut splits) = BodySplits::asked_for(table, &frames[0])? {
            let numbered = || frames.iter().map(Vec::as_slice).zip(sequence.files());
            for (frame, file) in numbered().skip(1) {
                let first = (frames[0].as_slice(), sequence.files()[0].as_path());
                splits.must_fit(first, (frame, file))?;
            }
            self.notes.push(splits.note(origin.text()?));
            frames = (frames.into_iter().map(|f| splits.applied(f))).collect();
        }
        let frames = (frames.into_iter().enumerate()).map(|(n, f)| self.taken(table, f, n == 0));
        let frames = frames.collect::<Result<_>>()?;
        Ok(PartSource::of(frames, Some(sequence)))
    }
}

/// Returns true if the planar and small holes of an entry are closed.
fn closes_holes(table: &Table<'_>) -> Result<bool> {
    table.get("close_holes").map_or(Ok(false), |e| e.flag())
}

/// Converts a text, or a table with name and parameters, to the notation of [`shape`](cutaway::generate::shapes::shape).
pub(super) fn spec_of(entry: &Entry<'_>) -> Result<String> {
    if !entry.is_table() {
        return entry.text().map(str::to_owned);
    }
    let table = entry.open_table()?;
    let name = table.need("name", "\"crank\"")?.text()?;
    let numbers = table.all().filter(|(key, _)| *key != "name");
    let pairs: Result<Vec<String>> = numbers
        .map(|(key, value)| Ok(format!("{key}={}", value.number()?)))
        .collect();
    Ok(match pairs?.join("&") {
        pairs if pairs.is_empty() => name.to_owned(),
        pairs => format!("{name}?{pairs}"),
    })
}

/// Error for a file that is missing or is a folder.
pub(super) fn missing(origin: &Entry<'_>, path: &Path) -> Error {
    if path.is_dir() {
        let what = format!("{} is a folder", path.display());
        return origin.fault(what, "give the name of a file in that folder");
    }
    let what = format!("there is no file {}", path.display());
    let help = match origin.node.origin {
        Origin::Text { .. } => {
            "check the name, which is relative to the scene file; a built-in shape is `shape = \"crank\"`, and as a volume `shape:NAME`"
        }
        _ => "check the path; built-in shapes are written shape:NAME",
    };
    origin.fault(what, help).missing()
}
