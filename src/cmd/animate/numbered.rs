//! A PNG for each frame, under names that count from 1: `frames/%04d.png`.
//!
//! All files take their places at the end together, so that a run that fails leaves none; until then they lie beside them
//! under hidden names.

use std::path::{Path, PathBuf};

use image::RgbaImage;

use super::super::console::Console;
use super::super::output::{Pending, begun_with};
use super::super::picture::png;
use super::encoder::Encoder;
use crate::Result;
use crate::scene::frames::Pattern;

/// Frames that wait for the last.
pub(super) struct Numbered {
    pattern: Pattern,
    frames: Vec<Pending>,
}

impl Numbered {
    /// Frames with names of a pattern.
    pub(super) fn new(pattern: Pattern) -> Self {
        Self {
            pattern,
            frames: Vec::new(),
        }
    }

    fn next(&self) -> PathBuf {
        self.pattern.file(self.frames.len() as u32 + 1)
    }
}

impl Encoder for Numbered {
    fn add(&mut self, frame: &RgbaImage) -> Result<()> {
        let path: &Path = &self.next();
        self.frames.push(begun_with(path, &png(frame)?)?);
        Ok(())
    }

    fn finish(self: Box<Self>, console: &Console) -> Result<()> {
        let next = self.next();
        for frame in self.frames {
            frame.place()?;
        }
        if next.exists() {
            console.warn(format!(
                "{} is from before and does not belong to this animation\n  mend: remove it and those after it",
                next.display()
            ));
        }
        Ok(())
    }
}
