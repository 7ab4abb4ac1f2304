//! Frame sequences: one mesh file per frame, such as simulations write.
//!
//! Every frame is a mesh of its own; the number of vertices and triangles, and even that of solids, may change from frame to
//! frame. All frames are loaded at once, in parallel, and stay in memory: what is drawn at a time is a frame as it was
//! loaded, never something between two frames, and asking for the same frame again gives the same [`Arc`] of
//! its mesh.

mod pattern;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use rayon::prelude::*;

use super::file::OpenMesh;
use super::{Material, Part, load_mesh_file};
use crate::error::{Error, Result};
pub use pattern::Pattern;

/// Frames per second where nobody says how many.
pub const USUAL_FPS: f64 = 24.0;

/// Share of a frame by which a time may fall short of it: `3 / fps * fps` need not be 3.
const SLACK: f64 = 1e-6;

/// Meshes in a row.
#[derive(Clone, Debug)]
pub struct Sequence {
    frames: Arc<[Vec<Part>]>,
    fps: f64,
    loops: bool,
    notes: Arc<[String]>,
}

impl Sequence {
    /// Opens all files of a pattern such as `frames/walk_%04d.ply`, counted from 0 or 1 up until one is missing. It begins
    /// anew after its last frame.
    pub fn open(pattern: &str, fps: f64) -> Result<Self> {
        let open_mesh = |path: &Path| {
            let loaded = load_mesh_file(path)?;
            Ok((loaded.parts, loaded.notes))
        };
        Self::open_by(pattern, fps, &open_mesh)
    }

    /// As [`Sequence::open`], by another reader of mesh files.
    pub fn open_by(pattern: &str, fps: f64, open_mesh: &OpenMesh<'_>) -> Result<Self> {
        let pattern = Pattern::parse(pattern)?;
        Self::open_with(&pattern, None, open_mesh)?.timed(fps, true)
    }

    /// Opens all files of a pattern, counted up from `first`, by a reader of mesh files.
    pub(super) fn open_with(
        pattern: &Pattern,
        first: Option<u32>,
        open_mesh: &OpenMesh<'_>,
    ) -> Result<Self> {
        let (files, gap) = pattern.files(first)?;
        let opened: Vec<(Vec<Part>, Vec<String>)> = files
            .par_iter()
            .map(|path| whole(path, open_mesh(path)?))
            .collect::<Result<_>>()?;
        let mut notes: Vec<String> = gap.into_iter().collect();
        notes.extend(summary(&files, &opened));
        let several = opened.iter().any(|(parts, _)| parts.len() > 1);
        let stem = pattern.stem();
        let named = |(index, mut part): (usize, Part)| {
            part.name = if several {
                format!("{stem}/{index}")
            } else {
                stem.clone()
            };
            part
        };
        let frames = opened
            .into_iter()
            .map(|(parts, _)| parts.into_iter().enumerate().map(named).collect())
            .collect();
        Ok(Self {
            frames,
            fps: USUAL_FPS,
            loops: true,
            notes: notes.into(),
        })
    }

    /// The same frames at another rate. Without a loop the last frame stays.
    pub fn timed(self, fps: f64, loops: bool) -> Result<Self> {
        if !(fps.is_finite() && fps > 0.0) {
            let mend = "write how many frames make a second, for example 24";
            return Err(Error::input(
                format!("fps {fps}"),
                "it must be above 0",
                mend,
            ));
        }
        Ok(Self { fps, loops, ..self })
    }

    /// How many frames there are.
    pub fn frame_count(&self) -> usize {
        self.frames.len()
    }

    /// How long all frames take.
    pub fn duration_s(&self) -> f64 {
        self.frames.len() as f64 / self.fps
    }

    /// When each frame begins, the first time round.
    pub fn times_s(&self) -> impl Iterator<Item = f64> {
        (0..self.frames.len()).map(|i| i as f64 / self.fps)
    }

    /// Which frame is shown at a time, counted from 0.
    pub fn frame_at(&self, time_s: f64) -> usize {
        let count = self.frames.len();
        let frame = (time_s.max(0.0) * self.fps + SLACK).floor();
        if self.loops {
            (frame % count as f64) as usize % count
        } else {
            (frame as usize).min(count - 1)
        }
    }

    /// The solids of the frame that is shown at a time: one is named after the pattern without its number, several after it
    /// and their number in the file.
    pub fn parts_at(&self, time_s: f64) -> &[Part] {
        &self.frames[self.frame_at(time_s)]
    }

    /// The solids of each frame.
    pub fn frames(&self) -> impl Iterator<Item = &[Part]> {
        self.frames.iter().map(Vec::as_slice)
    }

    /// What the user should know: frames left out, and what was mended in them.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// The same sequence, its parts not named as any of `taken`.
    #[must_use]
    pub(super) fn renamed(mut self, taken: &BTreeSet<String>) -> Self {
        let frames = self.frames.iter().flatten();
        let own: BTreeSet<&str> = frames.map(|p| p.name.as_str()).collect();
        let clashes = |suffix: &str| own.iter().any(|n| taken.contains(&format!("{n}{suffix}")));
        if clashes("") {
            let free = (2..).map(|i| format!("_{i}")).find(|s| !clashes(s));
            let suffix = free.unwrap_or_default();
            let rename = |parts: &Vec<Part>| {
                let parts = parts.iter().cloned().map(|mut part| {
                    part.name.push_str(&suffix);
                    part
                });
                parts.collect()
            };
            self.frames = self.frames.iter().map(rename).collect();
        }
        self
    }

    /// The same sequence with its plain parts coloured as parts of a scene that has `count` parts already.
    #[must_use]
    pub(super) fn coloured(mut self, count: usize) -> Self {
        let colour = |parts: &Vec<Part>| {
            let parts = parts.iter().cloned().enumerate().map(|(i, mut part)| {
                if part.material == Material::of_index(i) {
                    part.material = Material::of_index(count + i);
                }
                part
            });
            parts.collect()
        };
        self.frames = self.frames.iter().map(colour).collect();
        self
    }
}

/// A frame that can be drawn.
fn whole(
    path: &Path,
    (parts, notes): (Vec<Part>, Vec<String>),
) -> Result<(Vec<Part>, Vec<String>)> {
    let mend = "export the frame again, or leave out this and later ones";
    if parts.is_empty() {
        return Err(Error::file(path, "the frame holds no solid", mend));
    }
    match parts.iter().find_map(|p| p.mesh.defect()) {
        Some(defect) => Err(Error::file(path, format!("the frame: {defect}"), mend)),
        None => Ok((parts, notes)),
    }
}

/// The notes of the first frame that has any, and how many others have some too: what happens to one happens to most.
fn summary(files: &[PathBuf], opened: &[(Vec<Part>, Vec<String>)]) -> Vec<String> {
    let mut noted = files.iter().zip(opened).filter(|(_, (_, n))| !n.is_empty());
    let Some((path, (_, notes))) = noted.next() else {
        return Vec::new();
    };
    let mut notes = notes.clone();
    let others = noted.count();
    if others > 0 {
        notes.push(format!(
            "{}: {others} more frames have notes like these",
            path.display()
        ));
    }
    notes
}
