//! GIF: one palette of 255 colours for all frames, delays in hundredths of a second, no partial transparency.
//!
//! The palette is known only after the last frame; until then frames stay in memory, compressed (about a fifth of their
//! size for smooth pictures). If no pixel is transparent, a frame holds only the rectangle that changed; within it, unchanged
//! pixels have a palette index that means "as before".

use std::fs::File;
use std::io::{BufWriter, Read, Write};
use std::path::{Path, PathBuf};

use cutaway::Result;
use flate2::Compression;
use flate2::read::DeflateDecoder;
use flate2::write::DeflateEncoder;
use gif::{DisposalMethod, EncodingError, Frame, Repeat};
use image::RgbaImage;

use super::encoder::{Encoder, Rectangle, cannot_encode};
use super::palette::{MOST_COLORS, Palette, Sampler, is_opaque};
use super::plays::Plays;
use super::times::Times;
use crate::console::Console;
use crate::writing::output::Pending;

/// The palette index for "as before", or for a transparent pixel.
const AS_BEFORE: u8 = MOST_COLORS as u8;

/// Shortest delay in hundredths of a second: browsers replace shorter ones by a tenth of a second.
const LEAST_DELAY_CS: f64 = 2.0;

/// The nearest rate to `fps` with a delay in whole hundredths of a second.
pub(super) fn nearest_fps(fps: f64) -> f64 {
    100.0 / f64::from(delay_cs(fps))
}

fn delay_cs(fps: f64) -> u16 {
    (100.0 / fps)
        .round()
        .clamp(LEAST_DELAY_CS, f64::from(u16::MAX)) as u16
}

/// Encoder of a GIF.
pub(super) struct Gif {
    path: PathBuf,
    // Declared before the pending file, so that it is dropped first: a file is removed once its writer is closed.
    file: File,
    pending: Pending,
    size_px: [u32; 2],
    delay_cs: u16,
    plays: Plays,
    frames: Vec<Vec<u8>>,
    sampler: Sampler,
    has_holes: bool,
}

impl Gif {
    /// Begins a GIF.
    pub(super) fn begin(
        path: &Path,
        size_px: [u32; 2],
        times: &Times,
        plays: Plays,
    ) -> Result<Self> {
        let (pending, file) = Pending::begin(path)?;
        let pixels = size_px[0] as usize * size_px[1] as usize;
        Ok(Self {
            path: path.to_owned(),
            pending,
            file,
            size_px,
            delay_cs: delay_cs(times.fps),
            plays,
            frames: Vec::new(),
            sampler: Sampler::new(pixels * times.count as usize),
            has_holes: false,
        })
    }
}

impl Encoder for Gif {
    fn add(&mut self, _: u32, frame: &RgbaImage, _: bool) -> Result<()> {
        self.sampler.look(frame);
        self.has_holes |= !frame.chunks_exact(4).all(is_opaque);
        let mut packer = DeflateEncoder::new(Vec::new(), Compression::fast());
        let packed = packer.write_all(frame).and_then(|()| packer.finish());
        self.frames
            .push(packed.map_err(|e| cannot_encode(&self.path, e))?);
        Ok(())
    }

    fn finish(self: Box<Self>, console: &Console) -> Result<()> {
        console.say_step("colours");
        let Self {
            path,
            pending,
            file,
            size_px,
            delay_cs,
            plays,
            frames,
            sampler,
            has_holes,
        } = *self;
        let palette = sampler.palette();
        console.say_step("writing");
        let film = GifWriter {
            palette: &palette,
            size_px,
            delay_cs,
            has_holes,
        };
        film.write(file, &frames, plays)
            .map_err(|e| cannot_encode(&path, e))?;
        pending.place()
    }
}

/// Data common to all frames.
struct GifWriter<'a> {
    palette: &'a Palette,
    size_px: [u32; 2],
    delay_cs: u16,
    has_holes: bool,
}

impl GifWriter<'_> {
    fn write(&self, file: File, frames: &[Vec<u8>], plays: Plays) -> Result<(), EncodingError> {
        let mut colors = self.palette.colors.concat();
        // The last of the 256 entries is reserved for "as before".
        colors.resize(256 * 3, 0);
        let [width, height] = self.size_px;
        let writer = BufWriter::new(file);
        let mut encoder = gif::Encoder::new(writer, width as u16, height as u16, &colors)?;
        encoder.set_repeat(match plays {
            Plays::Forever => Repeat::Infinite,
            // The format counts the repeats after the first play.
            Plays::Times(n) => Repeat::Finite(n - 1),
        })?;
        let mut last: Option<Vec<u8>> = None;
        for packed in frames {
            let mut rgba = Vec::with_capacity(width as usize * height as usize * 4);
            DeflateDecoder::new(packed.as_slice()).read_to_end(&mut rgba)?;
            let indices = self.palette.indices(&rgba, width, AS_BEFORE);
            encoder.write_frame(&self.frame(&indices, last.as_deref()))?;
            last = Some(indices);
        }
        encoder.into_inner()?.flush()?;
        Ok(())
    }

    fn frame(&self, indices: &[u8], last: Option<&[u8]>) -> Frame<'static> {
        let [width, _] = self.size_px;
        let last = last.filter(|_| !self.has_holes);
        let changed = match last {
            Some(last) => Rectangle::of_difference(last, indices, self.size_px, 1),
            None => Rectangle::whole(self.size_px),
        };
        let mut buffer: Vec<u8> = changed.rows(indices, width, 1).flatten().copied().collect();
        if let Some(last) = last {
            for (new, old) in buffer
                .iter_mut()
                .zip(changed.rows(last, width, 1).flatten())
            {
                if new == old {
                    *new = AS_BEFORE;
                }
            }
        }
        let [left, top, width, height] = [
            changed.at[0],
            changed.at[1],
            changed.size[0],
            changed.size[1],
        ]
        .map(|v| v as u16);
        Frame {
            delay: self.delay_cs,
            dispose: if self.has_holes {
                DisposalMethod::Background
            } else {
                DisposalMethod::Keep
            },
            transparent: Some(AS_BEFORE),
            top,
            left,
            width,
            height,
            buffer: buffer.into(),
            ..Frame::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_are_those_that_delays_can_have() {
        for (asked, given) in [
            (25.0, 25.0),
            (24.0, 25.0),
            (10.0, 10.0),
            (60.0, 50.0),
            (1000.0, 50.0),
            (0.01, 0.01),
        ] {
            assert!(
                (nearest_fps(asked) - given).abs() < 1e-9,
                "{asked}: {}",
                nearest_fps(asked)
            );
        }
    }
}
