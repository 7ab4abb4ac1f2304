//! `--time` and `--clip`: which moment of a moving scene is meant.

use clap::Args;

use super::args::parse_finite;
use super::console::Console;
use crate::Result;
use crate::scene::Timeline;

/// The moment that is shown.
#[derive(Args, Default)]
pub(super) struct TimeArgs {
    /// The scene as it stands at this time [default: at rest, as the file has it]
    #[arg(long = "time", value_name = "SECONDS", value_parser = parse_time, allow_hyphen_values = true, help_heading = "Time")]
    pub(super) time_s: Option<f64>,
    #[command(flatten)]
    pub(super) clip: ClipArgs,
    /// Frames a second at which meshes that are numbered on the command line are played, where the output has a rate.
    #[arg(skip)]
    pub(super) played_fps: Option<f64>,
}

/// The animation that is shown.
#[derive(Args, Clone, Default)]
pub(super) struct ClipArgs {
    /// Which animation of a file that has several, by its name or its number from 0 [default: the first]
    #[arg(long, value_name = "NAME|NUMBER", help_heading = "Time")]
    pub(super) clip: Option<String>,
}

impl ClipArgs {
    /// Makes a timeline show the animation that is asked for.
    pub(super) fn choose(&self, timeline: &mut Timeline) -> Result<()> {
        self.clip
            .as_deref()
            .map_or(Ok(()), |c| timeline.choose_clip(c))
    }
}

impl TimeArgs {
    /// The time that is meant, if any. A clip that is asked for without a time begins.
    pub(super) fn time_s(&self) -> Option<f64> {
        self.time_s.or(self.clip.clip.as_ref().map(|_| 0.0))
    }

    /// Says so where a time makes no difference.
    pub(super) fn note_of_still(&self, timeline: &Timeline, console: &Console) {
        if self.time_s.is_some() && !timeline.moves() {
            console.note("nothing moves in this scene: it is the same at all times");
        }
    }
}

/// Reads a time in seconds.
pub(super) fn parse_time(text: &str) -> Result<f64, String> {
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
