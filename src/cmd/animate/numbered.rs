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
use crate::{Error, Result};

/// A name with a place for the number of a frame.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Pattern {
    before: String,
    /// Least number of digits.
    digits: usize,
    after: String,
}

impl Pattern {
    /// Reads a pattern in the manner of printf: `%d` or `%04d` once; `%%` is the sign itself.
    pub(super) fn parse(option: &str, text: &str) -> Result<Self> {
        let refuse = |what: &str| {
            let mend =
                "write one %04d where the number of the frame belongs, and %% for the sign itself";
            Error::input(format!("{option} {text}"), what, mend)
        };
        let mut before = None;
        let mut digits = 0;
        let mut sofar = String::new();
        let mut rest = text;
        while let Some((literal, tail)) = rest.split_once('%') {
            sofar.push_str(literal);
            if let Some(tail) = tail.strip_prefix('%') {
                sofar.push('%');
                rest = tail;
                continue;
            }
            let (width, tail) = tail
                .split_once('d')
                .ok_or_else(|| refuse("a % is followed by neither d nor %"))?;
            digits = match width.as_bytes() {
                [] => 1,
                [b'0', n @ b'1'..=b'9'] => usize::from(n - b'0'),
                _ => {
                    return Err(refuse(
                        "a % is followed by neither d, a width as in %04d, nor %",
                    ));
                }
            };
            if before.replace(std::mem::take(&mut sofar)).is_some() {
                return Err(refuse("there is more than one place for the number"));
            }
            rest = tail;
        }
        sofar.push_str(rest);
        let before = before.ok_or_else(|| refuse("there is no place for the number"))?;
        let after = sofar;
        if after.contains(['/', std::path::MAIN_SEPARATOR]) {
            return Err(refuse(
                "the number is in the name of a folder, not of the file",
            ));
        }
        Ok(Self {
            before,
            digits,
            after,
        })
    }

    /// The file of a frame, counted from 1.
    pub(super) fn of(&self, number: u32) -> PathBuf {
        let (before, after) = (&self.before, &self.after);
        format!("{before}{number:0digits$}{after}", digits = self.digits).into()
    }
}

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
        self.pattern.of(self.frames.len() as u32 + 1)
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

#[cfg(test)]
mod tests {
    use super::*;

    fn names(text: &str) -> [String; 2] {
        let pattern = Pattern::parse("--output", text).unwrap_or_else(|e| panic!("{e}"));
        [1, 12345].map(|n| pattern.of(n).to_string_lossy().into_owned())
    }

    #[test]
    fn numbers_go_where_the_pattern_says() {
        assert_eq!(names("f/%04d.png"), ["f/0001.png", "f/12345.png"]);
        assert_eq!(names("%d.png"), ["1.png", "12345.png"]);
        assert_eq!(
            names("100%%/a%06d%%.png"),
            ["100%/a000001%.png", "100%/a012345%.png"]
        );
    }

    #[test]
    fn patterns_without_one_number_are_refused() {
        for text in [
            "a%%.png",
            "a%.png",
            "%s.png",
            "%4d.png",
            "%d%d.png",
            "%0d.png",
            "%012d.png",
            "%d/a.png",
            "é%é.png",
        ] {
            let message = Pattern::parse("--output", text)
                .expect_err(text)
                .to_string();
            assert!(
                message.contains(text) && message.contains("%04d"),
                "{message}"
            );
        }
    }
}
