//! MP4 by ffmpeg, which receives raw frames through a pipe.
//!
//! The codec is H.264 by libx264 if ffmpeg has it, otherwise the best available encoder. The widely supported pixel format halves
//! the colour resolution, so sizes have to be even: an odd size is padded with a copy of the last row or column.
//! Colours are tagged as BT.709, which players assume for untagged files.

use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread::JoinHandle;

use cutaway::{Error, Result};
use image::RgbaImage;

use super::encoder::{Encoder, cannot_encode};
use super::mp4;
use super::program::FfmpegProgram;
use crate::console::Console;
use crate::writing::output::Pending;

/// The next even size.
pub(super) fn even(size_px: [u32; 2]) -> [u32; 2] {
    size_px.map(|s| s.next_multiple_of(2))
}

/// A child process that is ended when this value is dropped.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        // Both calls fail if the process has already ended, which is the normal case.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Encoder of an MP4 through ffmpeg.
pub(super) struct Ffmpeg {
    path: PathBuf,
    // Declared before its output file, so that it is dropped first: a file is removed once its writer is closed.
    running: Running,
    pending: Pending,
    /// Error output of ffmpeg, read by a thread so that ffmpeg never blocks on it.
    complaint: Option<JoinHandle<String>>,
    size_px: [u32; 2],
}

impl Ffmpeg {
    /// Starts ffmpeg.
    pub(super) fn begin(
        program: &FfmpegProgram,
        path: &Path,
        size_px: [u32; 2],
        fps: f64,
    ) -> Result<Self> {
        let (pending, _) = Pending::begin(path)?;
        let [width, height] = even(size_px);
        let mut command = Command::new("ffmpeg");
        command
            .args(["-hide_banner", "-loglevel", "error", "-xerror", "-y"])
            .args(["-f", "rawvideo", "-pixel_format", "rgb24"])
            .args(["-video_size", &format!("{width}x{height}")])
            .args(["-framerate", &fps.to_string(), "-i", "pipe:0", "-an"])
            .args([
                "-vf",
                "scale=out_color_matrix=bt709:out_range=tv,format=yuv420p,\
                 setparams=color_primaries=bt709:color_trc=bt709",
            ])
            .args(["-colorspace", "bt709", "-color_primaries", "bt709"])
            .args(["-color_trc", "bt709", "-color_range", "tv"])
            .args(program.codec)
            .args(["-movflags", "+faststart", "-f", "mp4"])
            // Without the `file:` prefix a name with a colon would be taken for a protocol.
            .arg(format!("file:{}", pending.beside().display()));
        let child = command
            .stdin(Stdio::piped())
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn();
        let mut child = child.map_err(|e| cannot_encode(path, format!("ffmpeg: {e}")))?;
        let complaint = child.stderr.take().map(|mut stderr| {
            std::thread::spawn(move || {
                let mut said = Vec::new();
                // If the pipe breaks, keep the lines read before.
                let _ = stderr.read_to_end(&mut said);
                String::from_utf8_lossy(&said).into_owned()
            })
        });
        Ok(Self {
            path: path.to_owned(),
            running: Running(child),
            pending,
            complaint,
            size_px,
        })
    }

    /// Error for an ffmpeg that stopped, with its last message.
    fn stopped(&mut self, how: &str) -> Error {
        let said = self.complaint.take().and_then(|c| c.join().ok());
        let said = said.unwrap_or_default();
        let last = said.lines().rfind(|l| !l.trim().is_empty());
        Error::file(
            &self.path,
            format!("ffmpeg {how}: {}", last.unwrap_or("no reason given")),
            "check the free disk space and whether ffmpeg works by itself, or write a .gif or a .png",
        )
    }
}

impl Encoder for Ffmpeg {
    fn add(&mut self, _: u32, frame: &RgbaImage, _: bool) -> Result<()> {
        let bytes = rgb_of_even_size(frame, self.size_px);
        let written = match &mut self.running.0.stdin {
            Some(stdin) => stdin.write_all(&bytes),
            None => Ok(()),
        };
        written.map_err(|e| {
            // The process has ended; waiting for it also closes its error output.
            let _ = self.running.0.wait();
            self.stopped(&format!("takes no more frames ({e})"))
        })
    }

    fn finish(mut self: Box<Self>, _: &Console) -> Result<()> {
        // Closing its input marks the end of the frames.
        drop(self.running.0.stdin.take());
        match self.running.0.wait() {
            Ok(status) if status.success() => {}
            Ok(status) => return Err(self.stopped(&format!("failed ({status})"))),
            Err(e) => return Err(self.stopped(&format!("was lost ({e})"))),
        }
        match mp4::missing(self.pending.beside()) {
            Ok(None) => {}
            Ok(Some(missing)) => {
                let how = format!("left a file that cannot be played: {missing}");
                return Err(self.stopped(&how));
            }
            Err(e) => return Err(self.stopped(&format!("left a file that cannot be read ({e})"))),
        }
        let Self { pending, .. } = *self;
        pending.place()
    }
}

/// The pixels without alpha, padded to an even size.
fn rgb_of_even_size(frame: &RgbaImage, size_px: [u32; 2]) -> Vec<u8> {
    let [width, height] = even(size_px);
    let mut bytes = Vec::with_capacity(width as usize * height as usize * 3);
    for (y, x) in (0..height).flat_map(|y| (0..width).map(move |x| (y, x))) {
        let [r, g, b, _] = frame
            .get_pixel(x.min(size_px[0] - 1), y.min(size_px[1] - 1))
            .0;
        bytes.extend([r, g, b]);
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::Rgba;

    #[test]
    fn odd_sizes_are_continued() {
        let frame = RgbaImage::from_fn(3, 1, |x, _| Rgba([x as u8, 9, 9, 255]));
        let bytes = rgb_of_even_size(&frame, [3, 1]);
        let reds: Vec<u8> = bytes.chunks_exact(3).map(|c| c[0]).collect();
        assert_eq!(reds, [0, 1, 2, 2, 0, 1, 2, 2]);
    }
}
