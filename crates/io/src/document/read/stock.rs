//! What the parts of a scene are made of: meshes, shapes and frames, opened once.
//!
//! The numbers of a document may change from time to time, its texts may not: whatever is named by text is opened when the document
//! is. All parts have names of their own: of those that a file gives, a name that is taken gets a number. Parts that neither their
//! file nor the document colours have colours by their shape.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use cutaway::error::{Error, Result};
use cutaway::scene::{Bounds, Material, Part};
use cutaway::slice::close_holes_of;
use glam::DAffine3;

use super::known::AllKnown;
use super::parts::{KEYS, MATERIAL};
use super::reader::{Entry, Table};
use super::solids::{Solid, Splits, chosen};
use super::{cap_materials, defects, hatches};
use crate::document::Origin;
use crate::load::frames::{Pattern, Sequence, USUAL_FPS};
use crate::load::{Assets, doubt};

/// What one entry `[[part]]` is made of.
#[derive(Clone, Debug)]
pub(crate) struct PartSource {
    /// One, or one for each frame.
    frames: Vec<Vec<Solid>>,
    sequence: Option<Sequence>,
    /// What each solid is called in its file, at any time, and what its part is called.
    names: BTreeMap<String, String>,
    /// Of the solids by their index, each as the first frame has it that has so many.
    forms: Vec<Form>,
    /// Bounds of all solids at all times, in the space of the file where they share it, else in the world.
    pub(super) rest: Bounds,
    /// Whether the file puts all solids in one space.
    pub(super) share_a_space: bool,
}

impl PartSource {
    fn of(mut frames: Vec<Vec<Solid>>, sequence: Option<Sequence>) -> Self {
        frames.iter_mut().flatten().for_each(Solid::measure);
        let mut forms: Vec<Form> = Vec::new();
        for frame in &frames {
            let new = frame.iter().skip(forms.len());
            forms.extend(new.map(|solid| Form::of(&solid.part)));
        }
        let solids = || frames.iter().flatten();
        let share_a_space = solids().all(|s| s.part.world_from_part == DAffine3::IDENTITY);
        let bounds = |s: &Solid| match share_a_space {
            true => s.rest,
            false => s.part.bounds_in_world(),
        };
        let rest = solids().map(bounds).fold(Bounds::EMPTY, Bounds::union);
        Self {
            names: BTreeMap::new(),
            forms,
            frames,
            sequence,
            rest,
            share_a_space,
        }
    }

    /// The solids at a time.
    pub(super) fn at(&self, time_s: f64) -> &[Solid] {
        let frame = self.sequence.as_ref().map_or(0, |s| s.frame_at(time_s));
        &self.frames[frame]
    }

    /// How the frames are played, if there are some.
    pub(crate) fn sequence(&self) -> Option<&Sequence> {
        self.sequence.as_ref()
    }

    /// The name of a part from that of its solid.
    pub(super) fn name(&self, of_solid: &str) -> &str {
        self.names.get(of_solid).map_or("", String::as_str)
    }

    /// The names of all parts that the entry has at any time.
    pub(in crate::document) fn names(&self) -> impl Iterator<Item = &String> {
        self.names.values()
    }

    /// What files call the materials of its parts.
    pub(super) fn materials(&self) -> impl Iterator<Item = &str> {
        let solids = self.frames.iter().flatten();
        (solids.flat_map(|solid| &solid.part.materials)).map(String::as_str)
    }

    /// Names the parts after the entry, if it has a name, or else after their solids, unlike those that are taken.
    fn call(&mut self, of_entry: Option<&str>, taken: &mut BTreeSet<String>) {
        let mut known = BTreeSet::new();
        let solids: Vec<&Solid> = (self.frames.iter().flatten())
            .filter(|solid| known.insert(solid.part.name.as_str()))
            .collect();
        let wanted = |solid: &Solid| match (of_entry, &solid.below) {
            (None, _) => solid.part.name.clone(),
            (Some(name), Some(below)) if solids.len() > 1 => format!("{name}/{below}"),
            (Some(name), _) => name.to_owned(),
        };
        let mut names = BTreeMap::new();
        for solid in &solids {
            let wanted = wanted(solid);
            let numbered = (2..).map(|count| format!("{wanted}_{count}"));
            let mut free = std::iter::once(wanted.clone()).chain(numbered);
            let name = free.find(|n| !taken.contains(n)).unwrap_or_default();
            taken.insert(name.clone());
            names.insert(solid.part.name.clone(), name);
        }
        self.names = names;
    }

    /// Colours the parts that their file has not by their shape, of which `shapes` are known: a hundred equal screws are alike. Later
    /// frames have the colours of the first.
    fn colour(&mut self, shapes: &mut Vec<Form>) {
        let mut colours = Vec::with_capacity(self.forms.len());
        for form in &self.forms {
            let known = shapes.iter().position(|known| known.is_like(form));
            colours.push(known.unwrap_or(shapes.len()));
            shapes.extend(known.is_none().then(|| form.clone()));
        }
        for frame in &mut self.frames {
            for (solid, colour) in frame.iter_mut().zip(&colours) {
                if solid.is_plain {
                    solid.part.material = Material::of_index(*colour);
                }
            }
        }
    }
}

/// What equal solids have in common wherever they are.
#[derive(Clone, Debug)]
struct Form {
    triangles: usize,
    volume: f64,
    area: f64,
}

impl Form {
    fn of(part: &Part) -> Self {
        Self {
            triangles: part.mesh.triangles.len(),
            volume: part.mesh.volume(),
            area: part.mesh.area(),
        }
    }

    /// To a ten thousandth, for files round the corners of each copy for themselves.
    fn is_like(&self, other: &Self) -> bool {
        let near = |a: f64, b: f64| (a - b).abs() <= 1e-4 * a.abs().max(b.abs());
        self.triangles == other.triangles
            && near(self.volume, other.volume)
            && near(self.area, other.area)
    }
}

/// Opens what the parts of a document name.
pub(super) fn open(entries: &[Entry<'_>], opening: &mut Opening<'_>) -> Result<Vec<PartSource>> {
    let mut stock = Vec::with_capacity(entries.len());
    let mut given = Vec::with_capacity(entries.len());
    let mut of_caps = Vec::with_capacity(entries.len());
    let before = opening.assets.kept::<AllKnown>().unwrap_or_default();
    let mut all_known = AllKnown::with_capacity(entries.len());
    for entry in entries {
        let table = entry.table(KEYS.all())?;
        let name = table.get("name");
        if let Some(name) = &name
            && name.text()?.is_empty()
        {
            return Err(name.fault("it is empty", "give the part a name, or leave the key out"));
        }
        given.push(name.map(|n| n.text()).transpose()?);
        let known = opening.known(&table, &before)?;
        stock.push(known.source.clone());
        all_known.push(known);
        let hatch = of_material(&table, "hatch")?;
        let hatch = hatch.map(|hatch| hatches::open(&hatch, opening));
        let cap = of_material(&table, "cap")?;
        let cap = cap.map(|cap| cap_materials::open(&cap, opening));
        of_caps.push((hatch.transpose()?, cap.transpose()?));
    }
    opening.assets.keep(all_known);
    let mut taken = BTreeSet::new();
    // What the document calls its parts counts before what files call them.
    for is_given in [true, false] {
        let entries = stock.iter_mut().zip(&given);
        entries
            .filter(|(_, name)| name.is_some() == is_given)
            .for_each(|(held, name)| held.call(*name, &mut taken));
    }
    let mut shapes = Vec::new();
    stock.iter_mut().for_each(|held| held.colour(&mut shapes));
    for (held, (hatch, cap)) in stock.iter_mut().zip(of_caps) {
        for solid in held.frames.iter_mut().flatten() {
            let material = &mut solid.part.material;
            if let Some(hatch) = &hatch {
                material.hatch = hatch.clone();
            }
            material.cap.clone_from(&cap);
        }
    }
    Ok(stock)
}

/// What the material of a part says under a key.
pub(super) fn of_material<'a>(part: &Table<'a>, key: &str) -> Result<Option<Entry<'a>>> {
    let material = part.get("material").map(|m| m.table(MATERIAL.all()));
    Ok(material.transpose()?.and_then(|m| m.get(key)))
}

/// What it takes to open what a document names.
pub(super) struct Opening<'a> {
    /// The folder that files are named from.
    pub(super) folder: &'a Path,
    pub(super) assets: &'a mut Assets,
    /// What is to be said of what was opened, each once.
    pub(super) notes: Vec<String>,
    /// Files that were read.
    pub(super) files: BTreeSet<PathBuf>,
}

impl Opening<'_> {
    /// Opens an entry.
    pub(super) fn entry(&mut self, table: &Table<'_>) -> Result<PartSource> {
        let (origin, text, is_mesh) = match (table.get("mesh"), table.get("shape")) {
            (Some(mesh), None) => (mesh.clone(), mesh.text()?.to_owned(), true),
            (None, Some(shape)) => (shape.clone(), spec_of(&shape)?, false),
            (Some(_), Some(shape)) => {
                return Err(shape.fault("the part has a mesh too", "keep one of the two"));
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
                return Err(entry.fault("only frames have it", help));
            }
        }
        let parts = if is_mesh {
            self.opened(&origin, &text, closes_holes(table)?)?
        } else {
            self.shape(&origin, &text)?
        };
        if parts.is_empty() {
            return Err(origin.fault("it holds no solid", "use a file or shape with triangles"));
        }
        let alone = parts.len() == 1;
        let below = |_, part: &Part| (!alone).then(|| part.name.clone());
        let mut solids = Solid::all(&parts, below);
        if let Some(mut splits) = Splits::asked_for(table, &solids)? {
            self.notes.push(splits.note(&match is_mesh {
                true => path.display().to_string(),
                false => format!("shape:{text}"),
            }));
            solids = splits.applied(solids);
        }
        let solids = self.taken(table, solids, true)?;
        Ok(PartSource::of(vec![solids], None))
    }

    /// The solids that an entry leaves, broken and closed as it says.
    fn taken(
        &mut self,
        table: &Table<'_>,
        solids: Vec<Solid>,
        is_first: bool,
    ) -> Result<Vec<Solid>> {
        let mut solids = chosen(table, solids)?;
        let parts = solids.iter_mut().map(|s| &mut s.part);
        defects::apply(table, parts, &mut self.notes)?;
        if closes_holes(table)? {
            let notes = close_holes_of(solids.iter_mut().map(|s| &mut s.part));
            // Those of later frames say much the same.
            self.notes.extend(notes.into_iter().filter(|_| is_first));
        }
        Ok(solids)
    }

    /// The solids of a mesh file.
    pub(super) fn mesh(&mut self, origin: &Entry<'_>, name: &str) -> Result<Vec<Part>> {
        self.opened(origin, name, false)
    }

    /// The same. Where holes are closed, what is doubtful about an open mesh is said when they are.
    fn opened(&mut self, origin: &Entry<'_>, name: &str, closes_holes: bool) -> Result<Vec<Part>> {
        let path = self.folder.join(name);
        if !self.assets.has_mesh(&path) {
            return Err(missing(origin, &path));
        }
        let loaded = self.assets.mesh(&path)?;
        let parts = loaded.parts.clone();
        self.files.extend(loaded.files.iter().cloned());
        let doubt = closes_holes.then(|| doubt(&path, &parts)).flatten();
        let is_new = |n: &&String| !self.notes.contains(n) && Some(*n) != doubt.as_ref();
        let new = loaded.notes.iter().filter(is_new);
        let new: Vec<String> = new.cloned().collect();
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
        let first = table.get("first").map(|f| f.whole::<u32>()).transpose()?;
        let fps = match table.get("fps") {
            Some(fps) => fps.positive()?,
            None => USUAL_FPS,
        };
        let loops = table.get("loop").map_or(Ok(true), |l| l.flag())?;
        let sequence = Sequence::open_from(&pattern, first, self.assets)
            .and_then(|s| s.timed(fps, loops))
            .map_err(|e| origin.place(e))?;
        self.notes.extend(sequence.notes().iter().cloned());
        self.files.extend(sequence.files().iter().cloned());
        // Solids of a frame are called after the frames and their number.
        let several = sequence.frames().any(|parts| parts.len() > 1);
        let below = |index: usize, _: &Part| several.then(|| index.to_string());
        let frames = sequence.frames().map(|parts| Solid::all(parts, below));
        let mut frames: Vec<Vec<Solid>> = frames.collect();
        if let Some(mut splits) = Splits::asked_for(table, &frames[0])? {
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

/// Whether the planar and small holes of an entry are closed.
fn closes_holes(table: &Table<'_>) -> Result<bool> {
    table.get("close_holes").map_or(Ok(false), |e| e.flag())
}

/// A built-in shape as [`shape`](cutaway::generate::shapes::shape) takes it: a text, or a table of its name and its numbers.
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

/// There is no such file, or it is a folder.
pub(super) fn missing(origin: &Entry<'_>, path: &Path) -> Error {
    if path.is_dir() {
        let what = format!("{} is a folder", path.display());
        return origin.fault(what, "give the name of a file in it");
    }
    let what = format!("there is no file {}", path.display());
    let help = match origin.node.origin {
        Origin::Text { .. } => {
            "check the name; it is relative to the scene file, and built-in shapes are `shape = \"crank\"`, cutters `shape:NAME`"
        }
        _ => "check the path; built-in shapes are written shape:NAME",
    };
    origin.fault(what, help).missing()
}
