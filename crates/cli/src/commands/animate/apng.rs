//! Animated PNG, which is lossless. A viewer without support for animation shows the first frame.
//!
//! After the first frame, only the rectangle that changed is written for each frame.

use std::fs::File;
use std::path::{Path, PathBuf};

use cutaway::Result;
use image::RgbaImage;
use png::{BitDepth, BlendOp, ColorType, Compression, DisposeOp, Writer};

use super::encoder::{Encoder, Rectangle, cannot_encode};
use super::plays::Plays;
use super::times::Times;
use crate::console::Console;
use crate::writing::output::Pending;

/// Encoder of an animated PNG.
pub(super) struct Apng {
    path: PathBuf,
    // Declared before the pending file, so that it is dropped first: a file is removed once its writer is closed.
    writer: Writer<File>,
    pending: Pending,
    size_px: [u32; 2],
    last: Option<RgbaImage>,
}

impl Apng {
    /// Begins an animated PNG.
    pub(super) fn begin(
        path: &Path,
        size_px: [u32; 2],
        times: &Times,
        plays: Plays,
    ) -> Result<Self> {
        let (pending, file) = Pending::begin(path)?;
        let writer = header(file, size_px, times, plays).map_err(|e| cannot_encode(path, e))?;
        Ok(Self {
            path: path.to_owned(),
            pending,
            writer,
            size_px,
            last: None,
        })
    }

    fn write(&mut self, frame: &RgbaImage) -> Result<(), png::EncodingError> {
        let [width, _] = self.size_px;
        let Some(last) = &self.last else {
            return self.writer.write_image_data(frame);
        };
        let changed = Rectangle::of_difference(last, frame, self.size_px, 4);
        let rows: Vec<&[u8]> = changed.rows(frame, width, 4).collect();
        // The old position with the new size could lie outside.
        self.writer.reset_frame_position()?;
        self.writer
            .set_frame_dimension(changed.size[0], changed.size[1])?;
        self.writer
            .set_frame_position(changed.at[0], changed.at[1])?;
        self.writer.write_image_data(&rows.concat())
    }
}

fn header(
    file: File,
    [width, height]: [u32; 2],
    times: &Times,
    plays: Plays,
) -> Result<Writer<File>, png::EncodingError> {
    let (numerator, denominator) = delay(times.fps);
    let mut encoder = png::Encoder::new(file, width, height);
    encoder.set_color(ColorType::Rgba);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::Balanced);
    encoder.set_animated(times.count, plays.count())?;
    encoder.set_frame_delay(numerator, denominator)?;
    encoder.set_blend_op(BlendOp::Source)?;
    encoder.set_dispose_op(DisposeOp::None)?;
    encoder.write_header()
}

/// Seconds between frames as a fraction of two 16-bit numbers.
fn delay(fps: f64) -> (u16, u16) {
    let whole = |v: f64| (v - v.round()).abs() < 1e-9;
    let fits = [1.0, 10.0, 100.0, 1000.0].map(|n| (n, n * fps));
    let fits = fits
        .into_iter()
        .filter(|(_, d)| (1.0..=65535.0).contains(d));
    let mut best = (1, 1);
    for (n, d) in fits {
        best = (n as u16, d.round() as u16);
        if whole(d) {
            break;
        }
    }
    best
}

impl Encoder for Apng {
    fn add(&mut self, _: u32, frame: &RgbaImage, _: bool) -> Result<()> {
        self.write(frame)
            .map_err(|e| cannot_encode(&self.path, e))?;
        self.last = Some(frame.clone());
        Ok(())
    }

    fn finish(self: Box<Self>, _: &Console) -> Result<()> {
        let Self {
            path,
            pending,
            writer,
            ..
        } = *self;
        writer.finish().map_err(|e| cannot_encode(&path, e))?;
        pending.place()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_become_fractions() {
        for (fps, fraction) in [
            (24.0, (1, 24)),
            (23.976, (1000, 23976)),
            (12.5, (10, 125)),
            (0.01, (100, 1)),
            (1000.0, (1, 1000)),
        ] {
            assert_eq!(delay(fps), fraction, "{fps}");
        }
        let (n, d) = delay(100.0 / 3.0);
        assert!(
            (f64::from(d) / f64::from(n) - 100.0 / 3.0).abs() < 1e-3,
            "{n}/{d}"
        );
    }
}
