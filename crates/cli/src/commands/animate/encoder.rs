//! Interface of all animation formats: an encoder takes frames one by one, and moves the finished file to its destination at the end.

use std::path::Path;

use cutaway::Result;
use cutaway_lab::experiment::Identity;
use image::RgbaImage;

use super::apng::Apng;
use super::ffmpeg::Ffmpeg;
use super::gif::Gif;
use super::numbered::Numbered;
use super::plays::Plays;
use super::target::AnimationOutput;
use super::times::Times;
use crate::console::Console;

/// Encoder of an animation. If it is dropped before it is finished, no incomplete file remains.
pub(super) trait Encoder {
    /// Returns true if a frame, counted from 0, is already written and need not be added.
    fn has(&self, _number: u32) -> bool {
        false
    }

    /// Adds a frame by its number. All frames have the same size. An incomplete frame may be written, but a later run draws it again.
    fn add(&mut self, number: u32, frame: &RgbaImage, is_complete: bool) -> Result<()>;

    /// Moves the finished animation to its destination.
    fn finish(self: Box<Self>, console: &Console) -> Result<()>;
}

/// Begins an animation.
pub(super) fn encoder(
    target: &AnimationOutput,
    size_px: [u32; 2],
    times: &Times,
    plays: Plays,
    run: Identity,
) -> Result<Box<dyn Encoder>> {
    Ok(match target {
        AnimationOutput::Gif(path) => Box::new(Gif::begin(path, size_px, times, plays)?),
        AnimationOutput::Apng(path) => Box::new(Apng::begin(path, size_px, times, plays)?),
        AnimationOutput::Mp4(path, program) => {
            Box::new(Ffmpeg::begin(program, path, size_px, times.fps)?)
        }
        AnimationOutput::Numbered(pattern) => {
            Box::new(Numbered::new(pattern.clone(), times.count, run))
        }
    })
}

/// Bounding rectangle of the pixels where two frames differ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Rectangle {
    /// Upper left corner.
    pub(super) at: [u32; 2],
    /// Width and height; never 0.
    pub(super) size: [u32; 2],
}

impl Rectangle {
    /// Rectangle of a whole picture.
    pub(super) fn whole(size: [u32; 2]) -> Self {
        Self { at: [0, 0], size }
    }

    /// The smallest rectangle that contains all differences between two pictures; one pixel if they are equal,
    /// because no format allows a frame without pixels.
    pub(super) fn of_difference<T: PartialEq>(
        a: &[T],
        b: &[T],
        size: [u32; 2],
        channels: usize,
    ) -> Self {
        let width = size[0] as usize;
        let (mut min, mut max) = ([usize::MAX; 2], [0; 2]);
        let rows = a
            .chunks_exact(width * channels)
            .zip(b.chunks_exact(width * channels));
        for (y, (a, b)) in rows.enumerate() {
            let differ = |(a, b): (&[T], &[T])| a != b;
            let mut pixels = a.chunks_exact(channels).zip(b.chunks_exact(channels));
            let Some(first) = pixels.position(differ) else {
                continue;
            };
            let mut pixels = a.chunks_exact(channels).zip(b.chunks_exact(channels));
            let last = pixels.rposition(differ).unwrap_or(first);
            min = [min[0].min(first), min[1].min(y)];
            max = [max[0].max(last), y];
        }
        if min[1] == usize::MAX {
            return Self {
                at: [0, 0],
                size: [1, 1],
            };
        }
        Self {
            at: min.map(|v| v as u32),
            size: [0, 1].map(|i| (max[i] - min[i]) as u32 + 1),
        }
    }

    /// The rectangle's rows in a picture.
    pub(super) fn rows<'a, T>(
        &self,
        picture: &'a [T],
        width: u32,
        channels: usize,
    ) -> impl Iterator<Item = &'a [T]> {
        let Self { at, size } = *self;
        let row = width as usize * channels;
        let first = at[0] as usize * channels;
        let end = first + size[0] as usize * channels;
        let rows = picture
            .chunks_exact(row)
            .skip(at[1] as usize)
            .take(size[1] as usize);
        rows.map(move |r| &r[first..end])
    }
}

/// Error for a file that an encoder could not write.
pub(super) fn cannot_encode(path: &Path, why: impl std::fmt::Display) -> cutaway::Error {
    let help = "check the free disk space, or lower --resolution";
    cutaway::Error::file(path, format!("cannot be written: {why}"), help)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_differs_is_written() {
        let a = vec![0_u8; 5 * 4 * 2];
        let mut b = a.clone();
        let same = Rectangle::of_difference(&a, &b, [5, 4], 2);
        assert_eq!(same.size, [1, 1], "nothing differs");
        for (x, y) in [(1, 2), (3, 1)] {
            b[(y * 5 + x) * 2 + 1] = 7;
        }
        let found = Rectangle::of_difference(&a, &b, [5, 4], 2);
        assert_eq!(
            found,
            Rectangle {
                at: [1, 1],
                size: [3, 2]
            }
        );
        let rows: Vec<&[u8]> = found.rows(&b, 5, 2).collect();
        assert_eq!(rows, [[0, 0, 0, 0, 0, 7], [0, 7, 0, 0, 0, 0]]);
    }
}
