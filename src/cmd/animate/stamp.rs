//! What a numbered picture says of itself in text chunks of PNG: the run that drew it, and which of how many frames it is.
//!
//! A picture without them was drawn by another program, or is not complete.

use std::io::{BufRead, Seek};

/// The keyword of the chunk that names the run.
const RUN: &str = "cutaway run";

/// The keyword of the chunk with the number of the frame: `3 of 24`.
const FRAME: &str = "cutaway frame";

/// Run and number of a picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Stamp {
    /// The identity of the run, as text.
    pub(super) run: String,
    /// From 1.
    pub(super) number: u32,
    /// Frames of the whole animation.
    pub(super) count: u32,
}

impl Stamp {
    /// The chunks that say it: keywords and texts.
    pub(super) fn chunks(&self) -> [(&'static str, String); 2] {
        let frame = format!("{} of {}", self.number, self.count);
        [(RUN, self.run.clone()), (FRAME, frame)]
    }

    /// That of a picture which can be read to its end.
    pub(super) fn of_whole(png: impl BufRead + Seek) -> Option<Self> {
        let mut reader = png::Decoder::new(png).read_info().ok()?;
        let mut pixels = vec![0; reader.output_buffer_size()?];
        reader.next_frame(&mut pixels).ok()?;
        reader.finish().ok()?;
        let texts = &reader.info().uncompressed_latin1_text;
        let text = |keyword: &str| Some(texts.iter().find(|t| t.keyword == keyword)?.text.as_str());
        let (number, count) = text(FRAME)?.split_once(" of ")?;
        Some(Self {
            run: text(RUN)?.to_owned(),
            number: number.parse().ok()?,
            count: count.parse().ok()?,
        })
    }
}
