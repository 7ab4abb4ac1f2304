//! Frame times of an animation: equally spaced, from `--start`.
//!
//! No frame is drawn at the end time: in a loop it would repeat the first frame.

use clap::Args;
use cutaway::{Error, Result};

use crate::input::args::parse_finite;
use crate::input::when::parse_time;

/// Default duration of a turntable in seconds.
const USUAL_TURN_S: f64 = 4.0;

/// Maximum number of frames, half an hour at 50 per second; a larger number is probably a mistake.
pub(super) const MOST_FRAMES: u32 = 90_000;

/// Selection of the times to show.
#[derive(Args)]
pub(super) struct TimesArgs {
    /// Frames per second [default: 24; GIF 12.5, with delays in hundredths of a second]
    #[arg(long, value_name = "N", value_parser = parse_fps, allow_hyphen_values = true, help_heading = "Time")]
    pub(super) fps: Option<f64>,
    /// Duration in seconds [default: as long as something moves, or 4 for a turntable of a static scene]
    #[arg(long = "duration", value_name = "SECONDS", value_parser = parse_duration, allow_hyphen_values = true, help_heading = "Time")]
    duration_s: Option<f64>,
    /// Number of frames, instead of --duration; for a turntable of a static scene they are spread over 4 seconds unless --fps is given
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..), conflicts_with = "duration_s", help_heading = "Time")]
    frames: Option<u32>,
    /// Time of the first frame
    #[arg(long = "start", alias = "time", value_name = "SECONDS", default_value = "0", value_parser = parse_time, allow_hyphen_values = true, help_heading = "Time")]
    pub(super) start_s: f64,
}

/// Frame times.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Times {
    /// Time of the first frame.
    pub(super) start_s: f64,
    /// Frames per second.
    pub(super) fps: f64,
    /// Number of frames.
    pub(super) count: u32,
}

impl TimesArgs {
    /// Frames per second: as requested, else the default. For a turntable of a static scene, a frame count is spread over one turn.
    pub(super) fn rate(&self, usual: f64, stands_still: bool) -> f64 {
        let of_a_turn = (self.frames.filter(|_| stands_still))
            .map(|frames| (f64::from(frames) / USUAL_TURN_S).min(usual));
        self.fps.or(of_a_turn).unwrap_or(usual)
    }

    /// The frame times. `moving_s` is how long something moves, if anything does.
    pub(super) fn times(&self, fps: f64, moving_s: Option<f64>) -> Result<Times> {
        let count = match self.frames {
            Some(frames) => f64::from(frames),
            None => {
                let duration_s = self.duration_s.or(moving_s).unwrap_or(USUAL_TURN_S);
                (duration_s * fps).round().max(1.0)
            }
        };
        if count > f64::from(MOST_FRAMES) {
            let culprit = if self.frames.is_some() {
                "--frames"
            } else {
                "--duration"
            };
            return Err(Error::input(
                culprit,
                format!("that makes {count} frames, but at most {MOST_FRAMES} can be drawn"),
                "lower --fps or --duration",
            ));
        }
        Ok(Times {
            start_s: self.start_s,
            fps,
            count: count as u32,
        })
    }
}

impl Times {
    /// Time of a frame.
    pub(super) fn at(&self, frame: u32) -> f64 {
        self.start_s + f64::from(frame) / self.fps
    }

    /// Fraction of the total duration elapsed when a frame begins: from 0 to less than 1.
    pub(super) fn share(&self, frame: u32) -> f64 {
        f64::from(frame) / f64::from(self.count)
    }

    /// Total duration in seconds.
    pub(super) fn duration_s(&self) -> f64 {
        f64::from(self.count) / self.fps
    }
}

pub(super) fn parse_fps(text: &str) -> Result<f64, String> {
    let fps = parse_finite(text)
        .ok()
        .filter(|f| (0.01..=1000.0).contains(f));
    fps.ok_or_else(|| "it must be from 0.01 to 1000\n  help: write for example 24".to_owned())
}

fn parse_duration(text: &str) -> Result<f64, String> {
    let seconds = parse_finite(text).ok().filter(|s| *s > 0.0);
    seconds.ok_or_else(|| {
        "it must be a number of seconds, more than 0\n  help: write for example 4".to_owned()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn args(duration_s: Option<f64>, frames: Option<u32>) -> TimesArgs {
        TimesArgs {
            fps: None,
            duration_s,
            frames,
            start_s: 0.5,
        }
    }

    #[test]
    fn frames_of_a_turntable_are_spread_over_the_turn() {
        assert_eq!(args(None, Some(12)).rate(25.0, true), 3.0);
        assert_eq!(args(None, Some(1000)).rate(25.0, true), 25.0);
        assert_eq!(args(Some(2.0), None).rate(25.0, true), 25.0);
        assert_eq!(
            args(None, Some(12)).rate(25.0, false),
            25.0,
            "a mesh to a frame"
        );
        let asked = TimesArgs {
            fps: Some(10.0),
            ..args(None, Some(12))
        };
        assert_eq!(asked.rate(25.0, true), 10.0);
    }

    #[test]
    fn the_end_is_left_out() {
        let times = args(None, None).times(10.0, Some(2.0)).unwrap();
        assert_eq!(times.count, 20);
        assert_eq!([times.at(0), times.at(19)], [0.5, 2.4]);
        assert_eq!([times.share(0), times.share(10)], [0.0, 0.5]);
    }

    #[test]
    fn options_win_over_what_moves() {
        let count = |args: TimesArgs| args.times(10.0, Some(2.0)).map(|t| t.count);
        assert_eq!(count(args(Some(1.0), None)).unwrap(), 10);
        assert_eq!(count(args(None, Some(7))).unwrap(), 7);
        assert_eq!(count(args(Some(1e-3), None)).unwrap(), 1, "never none");
        let still = args(None, None).times(10.0, None).unwrap();
        assert_eq!(still.count, 40, "the usual turn");
        let message = count(args(Some(1e12), None)).unwrap_err().to_string();
        assert!(
            message.contains("--duration") && message.contains("help:"),
            "{message}"
        );
    }

    #[test]
    fn rates_are_bounded() {
        assert_eq!(parse_fps("23.976"), Ok(23.976));
        for text in ["0", "-24", "nan", "1e9", "fast"] {
            assert!(parse_fps(text).is_err(), "{text}");
        }
        assert!(parse_duration("0").is_err(), "no frame at all");
    }
}
