//! Sources of the parts of an entry. They hold one or more solids, or the solids of each frame, with names and colours.
//!
//! All parts have unique names: if a name from a file is already taken, a number is appended. A part that has no colour in its file or in
//! the document gets one according to its shape.

use std::collections::{BTreeMap, BTreeSet};

use cutaway::scene::{Bounds, Material, Part};
use glam::DAffine3;

use super::solids::SourceSolid;
use crate::load::frames::Sequence;

/// Source of one entry `[[part]]`.
#[derive(Clone, Debug)]
pub(crate) struct PartSource {
    /// Solids by frame. A single mesh is one frame.
    frames: Vec<Vec<SourceSolid>>,
    sequence: Option<Sequence>,
    /// Part name for each solid name that occurs in the file at any time.
    names: BTreeMap<String, String>,
    /// Measures of the solids, by index. Each is taken from the first frame that has a solid with this index.
    forms: Vec<SolidMeasures>,
    /// Bounds of all solids at all times. If all solids share the file's space, the bounds are in that space, otherwise in world space.
    pub(super) rest: Bounds,
    /// True if all solids of the file share one space.
    pub(super) share_a_space: bool,
}

impl PartSource {
    pub(super) fn of(mut frames: Vec<Vec<SourceSolid>>, sequence: Option<Sequence>) -> Self {
        frames.iter_mut().flatten().for_each(SourceSolid::measure);
        let mut forms: Vec<SolidMeasures> = Vec::new();
        for frame in &frames {
            let new = frame.iter().skip(forms.len());
            forms.extend(new.map(|solid| SolidMeasures::of(&solid.part)));
        }
        let solids = || frames.iter().flatten();
        let share_a_space = solids().all(|s| s.part.world_from_part == DAffine3::IDENTITY);
        let bounds = |s: &SourceSolid| match share_a_space {
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
    pub(super) fn at(&self, time_s: f64) -> &[SourceSolid] {
        let frame = self.sequence.as_ref().map_or(0, |s| s.frame_at(time_s));
        &self.frames[frame]
    }

    /// The solids of all frames.
    pub(super) fn solids_mut(&mut self) -> impl Iterator<Item = &mut SourceSolid> {
        self.frames.iter_mut().flatten()
    }

    /// The frame sequence, if the entry has several frames.
    pub(crate) fn sequence(&self) -> Option<&Sequence> {
        self.sequence.as_ref()
    }

    /// The part name for a solid name.
    pub(super) fn name(&self, of_solid: &str) -> &str {
        self.names.get(of_solid).map_or("", String::as_str)
    }

    /// The names of all parts of the entry at any time.
    pub(in crate::document) fn names(&self) -> impl Iterator<Item = &String> {
        self.names.values()
    }

    /// Names of the materials of the entry's parts, from the files.
    pub(super) fn materials(&self) -> impl Iterator<Item = &str> {
        let solids = self.frames.iter().flatten();
        (solids.flat_map(|solid| &solid.part.materials)).map(String::as_str)
    }

    /// Names the parts after the entry or, if it has no name, after their solids. Names in `taken` are avoided.
    pub(super) fn call(&mut self, of_entry: Option<&str>, taken: &mut BTreeSet<String>) {
        let mut known = BTreeSet::new();
        let solids: Vec<&SourceSolid> = (self.frames.iter().flatten())
            .filter(|solid| known.insert(solid.part.name.as_str()))
            .collect();
        let wanted = |solid: &SourceSolid| match (of_entry, &solid.below) {
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

    /// Colours parts that have no colour in their file by shape, so that a hundred equal screws look alike. Adds new shapes to `shapes`.
    /// Later frames get the colours of the first.
    pub(super) fn colour(&mut self, shapes: &mut Vec<SolidMeasures>) {
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

/// Measures that equal solids share, wherever they are placed.
#[derive(Clone, Debug)]
pub(super) struct SolidMeasures {
    triangles: usize,
    volume: f64,
    area: f64,
}

impl SolidMeasures {
    fn of(part: &Part) -> Self {
        Self {
            triangles: part.mesh.triangles.len(),
            volume: part.mesh.volume(),
            area: part.mesh.area(),
        }
    }

    /// Compares with a tolerance of one ten-thousandth, because files round the vertices of each copy separately.
    fn is_like(&self, other: &Self) -> bool {
        let near = |a: f64, b: f64| (a - b).abs() <= 1e-4 * a.abs().max(b.abs());
        self.triangles == other.triangles
            && near(self.volume, other.volume)
            && near(self.area, other.area)
    }
}
