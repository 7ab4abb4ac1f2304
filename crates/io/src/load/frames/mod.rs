//! Frame sequences: one mesh file per frame, as written by simulations.
//!
//! Every frame is an independent mesh; the number of vertices, triangles and even solids may change from frame to
//! frame. All frames are loaded at once, in parallel, and stay in memory: frames are shown as loaded,
//! without interpolation, and repeated requests for a frame return the same [`Arc`] of
//! its mesh.

mod pattern;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use cutaway::error::{Diagnostic, Error, Result};
use cutaway::scene::Part;

use super::Assets;
pub use pattern::Pattern;

/// Default frames per second.
pub const USUAL_FPS: f64 = 24.0;

/// Tolerance, as a share of a frame, by which a time may fall short of a frame's start: `3 / fps * fps` need not be 3.
const SLACK: f64 = 1e-6;

/// A sequence of frames, each with its parts.
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

    /// Returns the same frames at another rate. Without a loop the last frame stays.
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

    /// Returns the index of the frame that is shown at a time, from 0.
    pub fn frame_at(&self, time_s: f64) -> usize {
        let count = self.frames.len();
        let frame = (time_s.max(0.0) * self.fps + SLACK).floor();
        if self.loops {
            (frame % count as f64) as usize % count
        } else {
            (frame as usize).min(count - 1)
        }
    }

    /// Parts of the frame shown at a time: a single part is named after the pattern without its number, several after the pattern
    /// and their number in the file.
    pub fn parts_at(&self, time_s: f64) -> &[Part] {
        &self.frames[self.frame_at(time_s)]
    }

    /// Parts of each frame.
    pub fn frames(&self) -> impl Iterator<Item = &[Part]> {
        self.frames.iter().map(Vec::as_slice)
    }

    /// The files, in order.
    pub fn files(&self) -> &[PathBuf] {
        &self.files
    }

    /// Notes for the user: frames left out, and repairs of frames.
    pub fn notes(&self) -> &[Diagnostic] {
        &self.notes
    }
}

/// Refuses a frame that cannot be drawn.
fn whole(path: &Path, parts: &[Part]) -> Result<()> {
    let help = "export the frame again, or leave out this and later ones";
    if parts.is_empty() {
        return Err(Error::file(path, "the frame holds no solid", help));
    }
    match parts.iter().find_map(|p| p.mesh.defect()) {
        Some(defect) => Err(Error::file(path, format!("the frame: {defect}"), help)),
        None => Ok(()),
    }
}

/// The notes of the first frame with notes, and the count of other frames with notes, since problems usually affect most frames.
fn summary(files: &[PathBuf], opened: &[(Vec<Part>, Vec<Diagnostic>)]) -> Vec<Diagnostic> {
    let mut noted = files.iter().zip(opened).filter(|(_, (_, n))| !n.is_empty());
    let Some((path, (_, notes))) = noted.next() else {
        return Vec::new();
    };
    let mut notes = notes.clone();
    let others = noted.count();
    if others > 0 {
        let text = format!("{others} more frames have notes like these");
        notes.push(Diagnostic::note("notes-of-frames", text).in_file(path));
    }
    notes
}
