//! Metadata of a numbered picture in PNG text chunks: the run that drew it, its number and the frame count.
//!
//! A picture without these chunks is from another program, or incomplete.

use std::io::{BufRead, Seek};

use super::times::MOST_FRAMES;

/// Keyword of the chunk with the run's identity.
const RUN: &str = "cutaway run";

/// Keyword of the chunk with the frame number: `3 of 24`.
const FRAME: &str = "cutaway frame";

/// Run and number of a picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Stamp {
    /// The identity of the run, as text.
    pub(super) run: String,
    /// Frame number, from 1.
    pub(super) number: u32,
    /// Number of frames of the whole animation.
    pub(super) count: u32,
}

impl Stamp {
    /// The text chunks of the stamp: keywords and texts.
    pub(super) fn chunks(&self) -> [(&'static str, String); 2] {
        let frame = format!("{} of {}", self.number, self.count);
        [(RUN, self.run.clone()), (FRAME, frame)]
    }

    /// Reads the stamp of a picture, which must be readable to its end.
    pub(super) fn of_whole(png: impl BufRead + Seek) -> Option<Self> {
        let mut reader = png::Decoder::new(png).read_info().ok()?;
        let mut pixels = vec![0; reader.output_buffer_size()?];
        reader.next_frame(&mut pixels).ok()?;
        reader.finish().ok()?;
        let texts = &reader.info().uncompressed_latin1_text;
        let text = |keyword: &str| Some(texts.iter().find(|t| t.keyword == keyword)?.text.as_str());
        let (number, count) = text(FRAME)?.split_once(" of ")?;
        let (number, count) = (number.parse().ok()?, count.parse().ok()?);
        let is_sound = (1..=MOST_FRAMES).contains(&count) && (1..=count).contains(&number);
        is_sound.then_some(Self {
            run: text(RUN)?.to_owned(),
            number,
            count,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stamped(frame: &str) -> Option<Stamp> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, 1, 1);
        for (keyword, text) in [(RUN, "a run"), (FRAME, frame)] {
            let added = encoder.add_text_chunk(keyword.to_owned(), text.to_owned());
            added.expect("a chunk");
        }
        let mut writer = encoder.write_header().expect("a header");
        writer.write_image_data(&[0]).expect("a pixel");
        writer.finish().expect("an end");
        Stamp::of_whole(std::io::Cursor::new(bytes))
    }

    #[test]
    fn numbers_that_no_animation_has_are_no_stamp() {
        let sound = stamped("3 of 24").expect("a stamp");
        assert_eq!((sound.number, sound.count), (3, 24));
        for frame in ["1 of 4000000000", "0 of 24", "25 of 24", "3", "a of b"] {
            assert_eq!(stamped(frame), None, "{frame}");
        }
    }
}
