//! Destination of an animation. The extension selects the format.

use std::path::{Path, PathBuf};

use cutaway::error::did_you_mean;
use cutaway::{Error, Result};
use cutaway_io::load::frames::Pattern;

use super::program::FfmpegProgram;
use crate::writing::output::Output;

const OPTION: &str = "--output";

/// A destination of frames.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum AnimationOutput {
    /// GIF with 255 colours, shown by any browser.
    Gif(PathBuf),
    /// Animated PNG, lossless.
    Apng(PathBuf),
    /// Written by ffmpeg, which is installed.
    Mp4(PathBuf, FfmpegProgram),
    /// One PNG per frame.
    Numbered(Pattern),
}

/// The formats by extension; `.apng` means the same as `.png`.
const EXTENSIONS: &[&str] = &["gif", "png", "apng", "mp4"];

impl AnimationOutput {
    /// Parses a destination from an option's value, and checks that it can be written.
    pub(super) fn checked(value: &str) -> Result<Self> {
        if value == "-" {
            return Err(Error::input(
                "--output -",
                "an animation is not written to standard output",
                "name a file, for example out.gif",
            ));
        }
        if value.contains('%') {
            let pattern = Pattern::parse(value)?;
            let [first, second] = [1, 2].map(|number| pattern.file(number));
            if first.parent() != second.parent() {
                return Err(Error::input(
                    format!("{OPTION} {value}"),
                    "the number is in the name of a folder, not of the file",
                    "number the files of one folder: 'frames/%04d.png'",
                ));
            }
            Output::checked(OPTION, &first.to_string_lossy(), &["png"])?;
            return Ok(Self::Numbered(pattern));
        }
        let path = Path::new(value);
        let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase());
        let extension = extension.unwrap_or_default();
        if !path.is_dir() && !EXTENSIONS.contains(&extension.as_str()) {
            return Err(Error::input(
                format!("{OPTION} {value}"),
                "the extension is not a known animation format",
                format!(
                    "{}; or number the frames: 'frames/%04d.png'",
                    did_you_mean(&extension, EXTENSIONS.iter().copied())
                ),
            ));
        }
        Output::checked(OPTION, value, &[])?;
        let path = path.to_owned();
        Ok(match extension.as_str() {
            "gif" => Self::Gif(path),
            "mp4" => {
                let program = FfmpegProgram::find(&path)?;
                Self::Mp4(path, program)
            }
            _ => Self::Apng(path),
        })
    }

    /// Lower-case name.
    pub(super) fn name(&self) -> &'static str {
        match self {
            Self::Gif(_) => "gif",
            Self::Apng(_) => "apng",
            Self::Mp4(..) => "mp4",
            Self::Numbered(_) => "numbered",
        }
    }

    /// The file, or the first of several.
    pub(super) fn path(&self) -> PathBuf {
        match self {
            Self::Gif(path) | Self::Apng(path) | Self::Mp4(path, _) => path.clone(),
            Self::Numbered(pattern) => pattern.file(1),
        }
    }

    /// All files of `count` frames.
    pub(super) fn files(&self, count: u32) -> Vec<PathBuf> {
        match self {
            Self::Numbered(pattern) => (1..=count).map(|number| pattern.file(number)).collect(),
            _ => vec![self.path()],
        }
    }

    /// Returns true if the format stores its play count.
    pub(super) fn counts_plays(&self) -> bool {
        matches!(self, Self::Gif(_) | Self::Apng(_))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_end_of_the_name_decides() {
        for (value, name) in [
            ("a.gif", "gif"),
            ("a.GIF", "gif"),
            ("a.png", "apng"),
            ("a.apng", "apng"),
            ("a%d.png", "numbered"),
        ] {
            assert_eq!(
                AnimationOutput::checked(value).unwrap().name(),
                name,
                "{value}"
            );
        }
    }

    #[test]
    fn what_cannot_be_written_is_refused_with_help() {
        for (value, said) in [
            ("-", "standard output"),
            ("a.giff", "did you mean `gif`"),
            ("a", "gif"),
            ("", "gif"),
            ("a.webm", "mp4"),
            ("a%d.gif", ".png"),
            ("frames%.png", "%04d"),
            ("%d/a.png", "folder"),
            ("/", "folder"),
        ] {
            let message = AnimationOutput::checked(value).unwrap_err().to_string();
            assert!(
                message.contains(said) && message.contains("help:"),
                "{value}: {message}"
            );
        }
    }
}
