//! One PNG per frame, numbered from 1: `frames/%04d.png`.
//!
//! Each file appears as soon as it is complete. It stores its run ([`Stamp`]), so that the same command can go on where it
//! stopped; frames of other runs are drawn again.

use std::fs::File;
use std::io::BufReader;
use std::path::PathBuf;

use cutaway::Result;
use cutaway_io::load::frames::Pattern;
use cutaway_lab::experiment::Identity;
use image::RgbaImage;
use png::{BitDepth, ColorType};

use super::encoder::{Encoder, cannot_encode};
use super::stamp::Stamp;
use crate::console::Console;
use crate::writing::output::write_file;

/// Writer of numbered frames.
pub(super) struct Numbered {
    pattern: Pattern,
    count: u32,
    run: Identity,
}

impl Numbered {
    /// Begins `count` frames of a run, named by a pattern.
    pub(super) fn new(pattern: Pattern, count: u32, run: Identity) -> Self {
        Self {
            pattern,
            count,
            run,
        }
    }

    fn file(&self, number: u32) -> PathBuf {
        self.pattern.file(number + 1)
    }

    /// A frame's metadata.
    fn stamp(&self, number: u32) -> Stamp {
        Stamp {
            run: self.run.text(),
            number: number + 1,
            count: self.count,
        }
    }
}

impl Encoder for Numbered {
    fn has(&self, number: u32) -> bool {
        let file = File::open(self.file(number)).ok();
        let found = file.and_then(|file| Stamp::of_whole(BufReader::new(file)));
        found.is_some_and(|found| found == self.stamp(number))
    }

    fn add(&mut self, number: u32, frame: &RgbaImage, is_complete: bool) -> Result<()> {
        let path = self.file(number);
        let stamp = is_complete.then(|| self.stamp(number));
        let bytes = encoded(frame, stamp.as_ref()).map_err(|e| cannot_encode(&path, e))?;
        write_file(&path, &bytes)
    }

    fn finish(self: Box<Self>, console: &Console) -> Result<()> {
        let next = self.file(self.count);
        if next.exists() {
            console.warn(format!(
                "{} is from an earlier run and does not belong to this animation\n  help: remove it and the files numbered after it",
                next.display()
            ));
        }
        Ok(())
    }
}

fn encoded(frame: &RgbaImage, stamp: Option<&Stamp>) -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Vec::new();
    let (width, height) = frame.dimensions();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(ColorType::Rgba);
    encoder.set_depth(BitDepth::Eight);
    for (keyword, text) in stamp.iter().flat_map(|stamp| stamp.chunks()) {
        encoder.add_text_chunk(keyword.to_owned(), text)?;
    }
    let mut writer = encoder.write_header()?;
    writer.write_image_data(frame)?;
    writer.finish()?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_whole_frames_of_the_same_run_are_kept() {
        let name = format!("cutaway-numbered-{}-%d.png", std::process::id());
        let pattern = std::env::temp_dir().join(name);
        let of_run = |words: &str| {
            let mut run = Identity::default();
            run.add(words);
            Numbered::new(Pattern::parse(&pattern.to_string_lossy()).unwrap(), 2, run)
        };
        let (mut numbered, frame) = (of_run("a"), RgbaImage::new(64, 48));
        assert!(!numbered.has(0), "nothing is there");
        numbered.add(0, &frame, true).unwrap();
        numbered.add(1, &frame, false).unwrap();
        assert_eq!([0, 1].map(|n| numbered.has(n)), [true, false]);
        assert!(!of_run("b").has(0), "another run");
        let first = numbered.file(0);
        assert_eq!(image::open(&first).unwrap().to_rgba8(), frame);
        let bytes = std::fs::read(&first).unwrap();
        std::fs::write(&first, &bytes[..bytes.len() - 9]).unwrap();
        assert!(!numbered.has(0), "it is cut off");
        for number in [0, 1] {
            std::fs::remove_file(numbered.file(number)).unwrap();
        }
    }
}
