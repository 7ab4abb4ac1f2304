//! `--time` and `--clip`: the requested moment of a moving scene.

use clap::Args;
use cutaway::Result;
use cutaway_io::document::{Document, Value};

use super::args::{parse_finite, say};
use super::declared::declared;

/// Option for the moment to show.
#[derive(Args, Default)]
pub(crate) struct TimeArgs {
    /// Show the scene at this time in seconds [default: without animation, as in the file]
    #[arg(long = "time", value_name = "SECONDS", value_parser = declared("time_s"), allow_hyphen_values = true, help_heading = "Time")]
    time_s: Option<Value>,
    #[command(flatten)]
    clip: ClipArgs,
}

/// Option for the animation to play.
#[derive(Args, Clone, Default)]
pub(crate) struct ClipArgs {
    /// Animation to use from a file with several, by name or by number from 0 [default: the first]
    #[arg(long, value_name = "NAME|NUMBER", help_heading = "Time")]
    clip: Option<String>,
}

impl ClipArgs {
    /// Writes the requested animation into a document.
    pub(crate) fn amend(&self, document: &mut Document) -> Result<()> {
        let clip = self.clip.as_deref().map(Value::from);
        say(document, "clip", "--clip", clip)
    }
}

impl TimeArgs {
    /// Writes the requested moment into a document.
    pub(crate) fn amend(&self, document: &mut Document) -> Result<()> {
        say(document, "time_s", "--time", self.time_s.clone())?;
        self.clip.amend(document)
    }
}

/// Parses a time in seconds.
pub(crate) fn parse_time(text: &str) -> Result<f64, String> {
    let seconds = parse_finite(text).ok().filter(|s| *s >= 0.0);
    seconds.ok_or_else(|| {
        "it must be a number of seconds, 0 or more\n  help: write for example 1.5".to_owned()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_seconds_from_the_start() {
        assert_eq!(parse_time("1.5"), Ok(1.5));
        assert_eq!(parse_time("0"), Ok(0.0));
        for text in ["-1", "nan", "inf", "1s", ""] {
            assert!(parse_time(text).is_err(), "{text}");
        }
    }
}
