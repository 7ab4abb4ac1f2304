//! What the parts of a scene file are made of: meshes, shapes and frames, loaded once.
//!
//! The numbers of a file may change from time to time, its texts may not: whatever is named by text is opened when the file
//! is first read, and a file or shape that several parts name is opened once. Parts read later share the meshes.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use glam::DAffine3;

use super::parts::KEYS;
use super::reader::{Entry, Table};
use super::{Loaders, defects};
use crate::error::{Result, did_you_mean};
use crate::scene::cut::glob_matches;
use crate::scene::frames::{Pattern, Sequence, USUAL_FPS};
use crate::scene::{Bounds, Part};

/// Solids as a file or shape has them.
#[derive(Clone, Debug)]
pub(super) struct Solids {
    pub(super) parts: Vec<Part>,
    /// Bounds of each in part space.
    pub(super) rest: Vec<Bounds>,
}

impl Solids {
    fn of(parts: Vec<Part>) -> Self {
        let rest = parts.iter().map(|p| p.posed_mesh().bounds()).collect();
        Self { parts, rest }
    }
}

/// What one entry `[[part]]` is made of.
#[derive(Clone, Debug)]
pub(super) struct Held {
    /// One, or one for each frame.
    frames: Vec<Solids>,
    sequence: Option<Sequence>,
    /// Names of the solids at all times.
    names: Vec<String>,
    /// Bounds of all solids at all times, in the space of the file where they share it, else in the world.
    pub(super) rest: Bounds,
    /// Whether the file puts all solids in one space.
    pub(super) share_a_space: bool,
}

impl Held {
    fn of(frames: Vec<Solids>, sequence: Option<Sequence>) -> Self {
        let parts = || frames.iter().flat_map(|f| &f.parts);
        let mut names = Vec::new();
        for part in parts() {
            if !names.contains(&part.name) {
                names.push(part.name.clone());
            }
        }
        let share_a_space = parts().all(|p| p.world_from_part == DAffine3::IDENTITY);
        let rest = if share_a_space {
            let all = frames.iter().flat_map(|f| f.rest.iter().copied());
            all.fold(Bounds::EMPTY, Bounds::union)
        } else {
            parts()
                .map(Part::bounds_in_world)
                .fold(Bounds::EMPTY, Bounds::union)
        };
        Self {
            frames,
            sequence,
            names,
            rest,
            share_a_space,
        }
    }

    /// The solids at a time.
    pub(super) fn at(&self, time_s: f64) -> &Solids {
        let frame = self.sequence.as_ref().map_or(0, |s| s.frame_at(time_s));
        &self.frames[frame]
    }

    /// How the frames are played, if there are some.
    pub(super) fn sequence(&self) -> Option<&Sequence> {
        self.sequence.as_ref()
    }

    /// The name of a part from that of its entry and of its solid.
    pub(super) fn name(&self, of_entry: Option<&str>, of_solid: &str) -> String {
        let Some(name) = of_entry else {
            return of_solid.to_owned();
        };
        if self.names.len() == 1 {
            return name.to_owned();
        }
        // Solids of a frame are called after the frames and their number.
        let own = match &self.sequence {
            Some(_) => of_solid.rsplit('/').next().unwrap_or(of_solid),
            None => of_solid,
        };
        format!("{name}/{own}")
    }

    /// The names of all parts that the entry has at any time.
    pub(super) fn names(&self, of_entry: Option<&str>) -> impl Iterator<Item = String> {
        self.names.iter().map(move |n| self.name(of_entry, n))
    }
}

/// Opens what the parts of a file name.
pub(super) fn open(
    entries: &[Entry<'_>],
    folder: &Path,
    loaders: &Loaders<'_>,
    notes: &mut Vec<String>,
) -> Result<Vec<Held>> {
    let mut opened = Opened {
        folder,
        loaders,
        meshes: BTreeMap::new(),
        shapes: BTreeMap::new(),
    };
    entries
        .iter()
        .map(|entry| opened.entry(&entry.table(KEYS)?, notes))
        .collect()
}

/// What has been opened so far.
struct Opened<'a> {
    folder: &'a Path,
    loaders: &'a Loaders<'a>,
    meshes: BTreeMap<PathBuf, Vec<Part>>,
    shapes: BTreeMap<String, Vec<Part>>,
}

impl Opened<'_> {
    fn entry(&mut self, table: &Table<'_>, notes: &mut Vec<String>) -> Result<Held> {
        if let Some(name) = table.get("name")
            && name.text()?.is_empty()
        {
            return Err(name.fault("it is empty", "give the part a name, or leave the key out"));
        }
        let (origin, text, is_mesh) = match (table.get("mesh"), table.get("shape")) {
            (Some(mesh), None) => (mesh.clone(), mesh.text()?, true),
            (None, Some(shape)) => (shape.clone(), shape.text()?, false),
            (Some(_), Some(shape)) => {
                return Err(shape.fault("the part has a mesh too", "keep one of the two"));
            }
            (None, None) => {
                let mend = "add `mesh = \"FILE\"` or `shape = \"crank\"`";
                return Err(table.entry.fault("it has neither a mesh nor a shape", mend));
            }
        };
        let path = self.folder.join(text);
        if is_mesh && !path.is_file() && text.contains('%') {
            return self.frames(&origin, table, notes);
        }
        for key in ["fps", "first", "loop"] {
            if let Some(entry) = table.get(key) {
                let mend = "remove it, or name frames as in `mesh = \"walk_%04d.ply\"`";
                return Err(entry.fault("only frames have it", mend));
            }
        }
        let parts = if is_mesh {
            self.mesh(&origin, path, notes)?
        } else {
            self.shape(&origin, text)?
        };
        if parts.is_empty() {
            return Err(origin.fault("it holds no solid", "use a file or shape with triangles"));
        }
        let mut parts = chosen(table, parts)?;
        defects::apply(table, &mut parts, notes)?;
        Ok(Held::of(vec![Solids::of(parts)], None))
    }

    fn mesh(
        &mut self,
        origin: &Entry<'_>,
        path: PathBuf,
        notes: &mut Vec<String>,
    ) -> Result<Vec<Part>> {
        if let Some(parts) = self.meshes.get(&path) {
            return Ok(parts.clone());
        }
        if !path.is_file() {
            let what = format!("there is no file {}", path.display());
            return Err(origin.fault(what, "check the name; it is relative to the scene file"));
        }
        let (parts, said) = (self.loaders.open_mesh)(&path)?;
        notes.extend(said);
        self.meshes.insert(path, parts.clone());
        Ok(parts)
    }

    fn shape(&mut self, origin: &Entry<'_>, spec: &str) -> Result<Vec<Part>> {
        if let Some(parts) = self.shapes.get(spec) {
            return Ok(parts.clone());
        }
        let parts = (self.loaders.open_shape)(spec).map_err(|e| origin.place(e))?;
        self.shapes.insert(spec.to_owned(), parts.clone());
        Ok(parts)
    }

    fn frames(
        &mut self,
        origin: &Entry<'_>,
        table: &Table<'_>,
        notes: &mut Vec<String>,
    ) -> Result<Held> {
        let pattern = Pattern::parse(origin.text()?).map_err(|e| origin.place(e))?;
        let pattern = pattern.inside(self.folder);
        let first = table.get("first").map(|f| f.whole::<u32>()).transpose()?;
        let fps = match table.get("fps") {
            Some(fps) => fps.positive()?,
            None => USUAL_FPS,
        };
        let loops = table.get("loop").map_or(Ok(true), |l| l.flag())?;
        let sequence = Sequence::open_with(&pattern, first, self.loaders.open_mesh)
            .and_then(|s| s.timed(fps, loops))
            .map_err(|e| origin.place(e))?;
        notes.extend(sequence.notes().iter().cloned());
        let frames = sequence
            .frames()
            .map(|parts| {
                let mut parts = chosen(table, parts.to_vec())?;
                defects::apply(table, &mut parts, notes)?;
                Ok(Solids::of(parts))
            })
            .collect::<Result<_>>()?;
        Ok(Held::of(frames, Some(sequence)))
    }
}

/// The solids that `only` and `except` leave.
fn chosen(table: &Table<'_>, parts: Vec<Part>) -> Result<Vec<Part>> {
    let mut left = parts.clone();
    for (key, keep) in [("only", true), ("except", false)] {
        let Some(entry) = table.get(key) else {
            continue;
        };
        for glob in entry.texts()? {
            if !parts.iter().any(|p| glob_matches(&glob, &p.name)) {
                let names = parts.iter().map(|p| p.name.as_str());
                let what = format!("there is no solid `{glob}`");
                return Err(entry.fault(what, did_you_mean(&glob, names)));
            }
        }
        let globs = entry.texts()?;
        left.retain(|p| keep == globs.iter().any(|g| glob_matches(g, &p.name)));
        if left.is_empty() {
            return Err(entry.fault("it leaves no solid", "choose fewer or others"));
        }
    }
    Ok(left)
}
