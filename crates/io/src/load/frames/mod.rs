//! Frame sequences: one mesh file per frame, as written by simulations.
//!
//! Every frame is an independent mesh. The number of vertices, triangles and even solids may change from frame to frame. All frames are
//! loaded at once, in parallel, and stay in memory. They are shown as loaded, without interpolation. Repeated requests for a frame return
//! the same [`Arc`] of its mesh.

mod pattern;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use cutaway::error::{Diagnostic, Error, Result};
use cutaway::scene::Part;

use super::Assets;
pub use pattern::Pattern;

/// Default frames per second.
pub const USUAL_FPS: f64 = 24.0;

/// Fraction of a frame by which a time may fall short of a frame's start. It allows for rounding: `3 / fps * fps` may not be exactly 3.
const SLACK: f64 = 1e-6;

/// A sequence of frames. Each frame has one or more parts.
#[derive(Clone, Debug)]
pub struct Sequence {
    frames: Arc<[Vec<Part>]>,
    fps: f64,
    loops: bool,
    notes: Arc<[Diagnostic]>,
    files: Arc<[PathBuf]>,
}

impl Sequence {
    /// Opens all files of a pattern such as `frames/walk_%04d.ply`, counting up from 0 or 1 until a file is missing. The sequence
    /// restarts after its last frame.
    pub fn open(pattern: &str, fps: f64, assets: &mut Assets) -> Result<Self> {
        Self::open_from(&Pattern::parse(pattern)?, None, assets)?.timed(fps, true)
    }

    /// Opens all files of a pattern, counting up from `first`.
    pub(crate) fn open_from(
        pattern: &Pattern,
        first: Option<u32>,
        assets: &mut Assets,
    ) -> Result<Self> {
        let (files, gap) = pattern.files(first, assets.store())?;
        assets.read_meshes(&files)?;
        let opened: Vec<(Vec<Part>, Vec<Diagnostic>)> = files
            .iter()
            .map(|path| {
                let loaded = assets.mesh(path)?;
                whole(path, &loaded.parts)?;
                Ok((loaded.parts.clone(), loaded.notes.clone()))
            })
            .collect::<Result<_>>()?;
        let mut notes: Vec<Diagnostic> = gap.into_iter().collect();
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
            files: files.into(),
        })
    }

    /// Returns the same frames at another rate. If the sequence does not loop, it stays at the last frame.
    pub fn timed(self, fps: f64, loops: bool) -> Result<Self> {
        if !(fps.is_finite() && fps > 0.0) {
            let help = "give the number of frames per second, for example 24";
            return Err(Error::input(
                format!("fps {fps}"),
                "it must be above 0",
                help,
            ));
        }
        Ok(Self { fps, loops, ..self })
    }

    /// Number of frames.
    pub fn frame_count(&self) -> usize {
        self.frames.len()
    }

    /// Duration of all frames.
    pub fn duration_s(&self) -> f64 {
        self.frames.len() as f64 / self.fps
    }

    /// Start time of each frame in the first loop.
    pub fn times_s(&self) -> impl Iterator<Item = f64> {
        (0..self.frames.len()).map(|i| i as f64 / self.fps)
    }

    /// Returns the index, from 0, of the frame that is shown at a time.
    pub fn frame_at(&self, time_s: f64) -> usize {
        let count = self.frames.len();
        let frame = (time_s.max(0.0) * self.fps + SLACK).floor();
        if self.loops {
            (frame % count as f64) as usize % count
        } else {
            (frame as usize).min(count - 1)
        }
    }

    /// Parts of the frame that is shown at a time. A single part is named after the pattern without its number. Several parts are named
    /// after the pattern and their number in the file.
    pub fn parts_at(&self, time_s: f64) -> &[Part] {
        &self.frames[self.frame_at(time_s)]
    }

    /// Parts of each frame.
    pub fn frames(&self) -> impl Iterator<Item = &[Part]> {
        self.frames.iter().map(Vec::as_slice)
    }

    /// The files, in the order of the frames.
    pub fn files(&self) -> &[PathBuf] {
        &self.files
    }

    /// Notes for the user, about frames that were left out or repaired.
    pub fn notes(&self) -> &[Diagnostic] {
        &self.notes
    }
}

/// Refuses a frame that cannot be drawn.
fn whole(path: &Path, parts: &[Part]) -> Result<()> {
    let help = "export the frame again, or remove it and all later frames";
    if parts.is_empty() {
        return Err(Error::file(path, "the frame contains no solid", help));
    }
    match parts.iter().find_map(|p| p.mesh.defect()) {
        Some(defect) => Err(Error::file(path, format!("the frame: {defect}"), help)),
        None => Ok(()),
    }
}

/// The notes of the first frame that has any, and the number of other frames with notes. Problems usually affect most frames.
fn summary(files: &[PathBuf], opened: &[(Vec<Part>, Vec<Diagnostic>)]) -> Vec<Diagnostic> {
    let mut noted = files.iter().zip(opened).filter(|(_, (_, n))| !n.is_empty());
    let Some((path, (_, notes))) = noted.next() else {
        return Vec::new();
    };
    let mut notes = notes.clone();
    let others = noted.count();
    if others > 0 {
        let text = format!("{others} more frames have similar notes");
        notes.push(Diagnostic::note("notes-of-frames", text).in_file(path));
    }
    notes
}
