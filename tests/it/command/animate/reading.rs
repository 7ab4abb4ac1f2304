//! Animations read back.

use std::fs::{self, File};
use std::io::BufReader;
use std::path::Path;

use image::codecs::gif::GifDecoder;
use image::codecs::png::PngDecoder;
use image::{AnimationDecoder, Frame, RgbaImage};

/// An animation as a viewer would show it.
pub(crate) struct Animation {
    /// Whole pictures.
    pub(crate) frames: Vec<RgbaImage>,
    /// Milliseconds that each is shown.
    pub(crate) delays_ms: Vec<f64>,
    /// How often it plays; 0 without end.
    pub(crate) plays: u32,
}

fn animation(frames: Vec<Frame>, plays: u32) -> Animation {
    let delay = |f: &Frame| {
        let (numerator, denominator) = f.delay().numer_denom_ms();
        f64::from(numerator) / f64::from(denominator)
    };
    Animation {
        delays_ms: frames.iter().map(delay).collect(),
        frames: frames.into_iter().map(Frame::into_buffer).collect(),
        plays,
    }
}

fn find(bytes: &[u8], word: &[u8]) -> Option<usize> {
    bytes.windows(word.len()).position(|w| w == word)
}

/// Reads a GIF.
pub(crate) fn gif(path: &Path) -> Animation {
    let decoder = GifDecoder::new(BufReader::new(File::open(path).unwrap())).unwrap();
    let frames = decoder.into_frames().collect_frames().unwrap();
    let bytes = fs::read(path).unwrap();
    // The rounds after the first, or 0 for ever; no such block for a single round.
    let plays = match find(&bytes, b"NETSCAPE2.0") {
        None => 1,
        Some(at) => match u16::from_le_bytes([bytes[at + 13], bytes[at + 14]]) {
            0 => 0,
            more => u32::from(more) + 1,
        },
    };
    animation(frames, plays)
}

/// Reads an animated PNG, and holds the number of frames that its header tells against those that are there.
pub(crate) fn apng(path: &Path) -> Animation {
    let decoder = PngDecoder::new(BufReader::new(File::open(path).unwrap())).unwrap();
    assert!(decoder.is_apng().unwrap(), "{} is still", path.display());
    let frames = decoder
        .apng()
        .unwrap()
        .into_frames()
        .collect_frames()
        .unwrap();
    let bytes = fs::read(path).unwrap();
    let at = find(&bytes, b"acTL").unwrap() + 4;
    let word = |at: usize| u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap());
    assert_eq!(word(at) as usize, frames.len(), "frames by the header");
    animation(frames, word(at + 4))
}

/// A still picture.
pub(crate) fn still(path: &Path) -> RgbaImage {
    image::open(path).unwrap().to_rgba8()
}

/// Mean difference of a channel.
pub(crate) fn mean_off(a: &RgbaImage, b: &RgbaImage) -> f64 {
    assert_eq!(a.dimensions(), b.dimensions(), "pictures of one size");
    let off: u64 = a
        .iter()
        .zip(b.iter())
        .map(|(a, b)| u64::from(a.abs_diff(*b)))
        .sum();
    off as f64 / a.len() as f64
}

/// Greatest difference of a channel.
pub(crate) fn most_off(a: &RgbaImage, b: &RgbaImage) -> u8 {
    assert_eq!(a.dimensions(), b.dimensions(), "pictures of one size");
    a.iter()
        .zip(b.iter())
        .map(|(a, b)| a.abs_diff(*b))
        .max()
        .unwrap()
}
