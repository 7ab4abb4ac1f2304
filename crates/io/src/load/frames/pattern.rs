//! File name patterns of frames. A pattern is a path with one number, written `%d` or `%04d`. In it, `%%` stands for a percent sign.

use std::path::{Path, PathBuf};

use cutaway::error::{Diagnostic, Error, Result};

use crate::load::Files;

const EXAMPLE: &str = "write one %04d where the number belongs, as in `frames/walk_%04d.ply`; %% stands for a percent sign";

/// Largest number of digits to which frame numbers are padded.
const MOST_DIGITS: usize = 12;

/// How many numbers after a missing frame are searched for further frames, to distinguish a gap from the end of the sequence.
const GAP_LOOKED_ACROSS: u32 = 64;

/// A path with a placeholder for a number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pattern {
    text: String,
    before: String,
    digits: usize,
    after: String,
}

impl Pattern {
    /// Returns true if a path has a number placeholder, such as `%d` or `%04d`.
    pub fn is_in(text: &str) -> bool {
        Self::parse(text).is_ok()
    }

    /// Parses a pattern.
    pub fn parse(text: &str) -> Result<Self> {
        let fault = |what: &str| Err(Error::input(format!("`{text}`"), what, EXAMPLE));
        let (mut before, mut after) = (String::new(), String::new());
        let mut digits = None;
        let mut rest = text;
        while let Some((plain, tail)) = rest.split_once('%') {
            let side = if digits.is_none() {
                &mut before
            } else {
                &mut after
            };
            side.push_str(plain);
            if let Some(tail) = tail.strip_prefix('%') {
                side.push('%');
                rest = tail;
                continue;
            }
            let Some((width, tail)) = tail.split_once('d') else {
                return fault("`%` must be followed by a frame-number format");
            };
            let filled = width.strip_prefix('0').and_then(|w| w.parse().ok());
            let width = match (width.is_empty(), filled) {
                (true, _) => 1,
                (_, Some(width @ 1..=MOST_DIGITS)) => width,
                _ => return fault("`%` must be followed by a frame-number format"),
            };
            if digits.replace(width).is_some() {
                return fault("it has two frame-number formats");
            }
            rest = tail;
        }
        let Some(digits) = digits else {
            return fault("it has no frame-number format");
        };
        after.push_str(rest);
        Ok(Self {
            text: text.to_owned(),
            before,
            digits,
            after,
        })
    }

    /// Returns the pattern with its path below a folder.
    #[must_use]
    pub fn inside(mut self, folder: &Path) -> Self {
        self.before = folder.join(&self.before).to_string_lossy().into_owned();
        self
    }

    /// The path of the file with this number.
    pub fn file(&self, number: u32) -> PathBuf {
        let Self {
            before,
            digits,
            after,
            ..
        } = self;
        format!("{before}{number:0digits$}{after}").into()
    }

    /// The file name without folder, number and extension, or `frames` if nothing is left.
    pub(super) fn stem(&self) -> String {
        let name = |text: &str| {
            let name = text.rsplit(['/', '\\']).next().unwrap_or(text);
            name.to_owned()
        };
        let end = name(&self.after);
        let end = end.split('.').next().unwrap_or_default();
        let start = if self.after.contains(['/', '\\']) {
            String::new()
        } else {
            name(&self.before)
        };
        let stem = format!("{start}{end}");
        let stem = stem.trim_matches(['_', '-', '.', ' ']);
        if stem.is_empty() { "frames" } else { stem }.to_owned()
    }

    /// The files from the first number up to the first missing file, and a note if more files follow after the gap.
    #[doc(hidden)]
    pub fn files(
        &self,
        first: Option<u32>,
        store: &dyn Files,
    ) -> Result<(Vec<PathBuf>, Option<Diagnostic>)> {
        let is_there = |number: &u32| store.is_file(&self.file(*number));
        let start = match first {
            Some(first) => is_there(&first).then_some(first),
            None => [0, 1].into_iter().find(is_there),
        };
        let Some(start) = start else {
            let (what, help) = match first {
                Some(first) => (
                    format!("there is no file {}", self.file(first).display()),
                    "let `first` be the number of the first frame",
                ),
                None => (
                    format!(
                        "there is neither {} nor {}",
                        self.file(0).display(),
                        self.file(1).display()
                    ),
                    "check the folder and the number of digits (%04d stands for four); in a scene file `first` may be any number",
                ),
            };
            return Err(Error::input(format!("`{}`", self.text), what, help).missing());
        };
        let files: Vec<PathBuf> = (start..)
            .take_while(is_there)
            .map(|n| self.file(n))
            .collect();
        let missing = start.saturating_add(files.len() as u32);
        let beyond =
            (missing..missing.saturating_add(GAP_LOOKED_ACROSS)).find(|number| is_there(number));
        let gap = beyond.map(|beyond| {
            let text = format!(
                "the sequence ends before frame {missing}, which is missing, although frame {beyond} exists"
            );
            Diagnostic::note("gap-in-sequence", text).about(&self.text)
        });
        Ok((files, gap))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_filled_in() {
        for (text, number, file, stem) in [
            ("walk_%04d.ply", 7, "walk_0007.ply", "walk"),
            ("%d.obj", 12, "12.obj", "frames"),
            (
                "a/b%%/run-%03d-x.stl",
                1234,
                "a/b%/run-1234-x.stl",
                "run--x",
            ),
            ("t%02d/mesh.ply", 3, "t03/mesh.ply", "mesh"),
            ("100%%/a%06d%%.png", 12345, "100%/a012345%.png", "a%"),
        ] {
            let pattern = Pattern::parse(text).expect(text);
            assert_eq!(pattern.file(number), PathBuf::from(file), "{text}");
            assert_eq!(pattern.stem(), stem, "{text}");
        }
    }

    #[test]
    fn what_is_no_pattern_is_told() {
        for (text, phrase) in [
            ("walk.ply", "frame-number format"),
            ("100%%.ply", "frame-number format"),
            ("100%.ply", "frame-number format"),
            ("%4d.ply", "frame-number format"),
            ("%099d.ply", "frame-number format"),
            ("%0d.ply", "frame-number format"),
            ("é%é.ply", "frame-number format"),
            ("%s.ply", "frame-number format"),
            ("%d/%d.ply", "two frame-number formats"),
        ] {
            assert!(!Pattern::is_in(text), "{text}");
            let error = Pattern::parse(text).expect_err(text).to_string();
            assert!(error.contains(phrase) && error.contains("help:"), "{error}");
        }
    }
}
