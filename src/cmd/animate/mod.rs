//! `animate`: a scene over time, or from all sides, as a GIF, an animated PNG, a film, or numbered pictures.
//!
//! All frames are drawn by one session, so that what does not change from frame to frame is built once. Time is that of as
//! many pictures, plus the encoder's. The file takes its place when it is whole.

mod apng;
mod encoder;
mod ffmpeg;
mod gif;
mod numbered;
mod palette;
mod report;
mod target;
mod times;
mod turntable;

use std::str::FromStr;

use clap::Args;
use serde_json::json;

use super::Verdict;
use super::args::{DeviceArgs, SceneArgs, parse_finite};
use super::console::{Console, ConsoleArgs};
use super::doubt::may_be_wrong;
use super::look::LookArgs;
use super::notes::warn_of_doubt;
use super::open::{Opened, open_at};
use super::output::{Output, no_place_twice};
use super::picture::{self, Drawer};
use super::when::{ClipArgs, TimeArgs};
use crate::experiment::{Shown, Stopwatch};
use crate::scene::frames::USUAL_FPS;
use crate::session::{Outcome, Session};
use crate::{Error, Result};
use encoder::encoder;
use report::FrameReport;
use target::Target;
use times::{Times, TimesArgs};
use turntable::turned;

pub(super) const EXAMPLES: &str = "\
Examples:
  cutaway animate shape:crank --section -z=50% --relief fractal --turntable -o crank.gif
  cutaway animate walk.glb --clip run --section x=50% -o run.mp4
  cutaway animate scene.toml --duration 6 --fps 30 --loop 1 -o scene.png     # an animated PNG, without loss
  cutaway animate part.stl --section z=50% --turntable=90 --frames 12 -o 'frames/%04d.png'

What moves is the scene's business: keys of a scene file, animations of a glTF file. A turntable comes on top of it.";

/// The usual rate for GIF: 24 a second would be delays of 4 1/6 hundredths.
const USUAL_GIF_FPS: f64 = 25.0;

/// Options of `animate`.
#[derive(Args)]
pub(super) struct AnimateArgs {
    #[command(flatten)]
    scene: SceneArgs,
    #[command(flatten)]
    clip: ClipArgs,
    #[command(flatten)]
    times: TimesArgs,
    /// The camera goes round the up axis, all the way or by so many degrees, on top of what moves: --turntable=90
    #[arg(
        long = "turntable",
        value_name = "DEGREES",
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = "360",
        value_parser = parse_turn,
        help_heading = "Camera"
    )]
    turn_deg: Option<f64>,
    /// The animation: .gif, .png or .apng (animated PNG), .mp4 (needs ffmpeg), or a PNG for each frame: 'frames/%04d.png'
    #[arg(long, short, value_name = "FILE|PATTERN", help_heading = "Output")]
    output: String,
    /// How often a GIF or an animated PNG plays [default: forever]
    #[arg(
        long = "loop",
        value_name = "N|forever",
        allow_hyphen_values = true,
        help_heading = "Output"
    )]
    plays: Option<Plays>,
    #[command(flatten)]
    look: LookArgs,
    /// Outcome, clocks and times of every frame as JSON
    #[arg(long, value_name = "FILE|-", help_heading = "Output")]
    json: Option<String>,
    #[command(flatten)]
    device: DeviceArgs,
    #[command(flatten)]
    console: ConsoleArgs,
}

/// How often an animation plays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Plays {
    /// Without end.
    Forever,
    /// So many times; never 0.
    Times(u16),
}

impl Plays {
    /// As animated PNG has it.
    fn count(self) -> u32 {
        match self {
            Self::Forever => 0,
            Self::Times(n) => u32::from(n),
        }
    }
}

impl FromStr for Plays {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match (text, text.parse()) {
            ("forever", _) => Ok(Self::Forever),
            (_, Ok(n)) if n > 0 => Ok(Self::Times(n)),
            _ => Err(
                "it must be forever, or a number from 1 to 65535\n  mend: --loop 1 plays it once"
                    .to_owned(),
            ),
        }
    }
}

/// Runs `animate`.
pub(super) fn run(args: &AnimateArgs) -> Result<Verdict> {
    let console = Console::new(args.console, 1);
    console.step("opening");
    let (target, json) = outputs(args)?;
    args.look.asked()?;
    let when = TimeArgs {
        time_s: Some(args.times.start_s),
        clip: args.clip.clone(),
        // One numbered mesh to a frame: at any other rate some would be seen twice and others not at all.
        played_fps: Some(rate(args, &target).1),
    };
    turn_is_no_input(args)?;
    let opened = open_at(&args.scene, &when, &console)?;
    let times = times(args, &target, &opened, &console)?;
    note_of_even_size(&target, &opened, &console);

    let drawer = args.look.drawer(&opened)?;
    let mut session = args.device.open()?;
    session.set_options(opened.options(session.options()));
    let plays = args.plays.unwrap_or(Plays::Forever);
    let mut encoder = encoder(&target, opened.size_px, &times, plays)?;
    console.expect_frames(times.count);
    let mut film = Film {
        args,
        opened: &opened,
        times,
        drawer,
        shown: Shown::of(&opened.scene),
        camera: opened.scene.camera,
    };
    let mut frames = Vec::with_capacity(times.count as usize);
    for frame in 0..times.count {
        let (image, report) = film.draw(frame, &mut session, &console)?;
        encoder.add(&image)?;
        frames.push(report);
        console.frame_done();
    }
    encoder.finish(&console)?;
    if let Some(output) = &json {
        let json = film.json(&session, &target, &frames);
        output.write(format!("{json:#}\n").as_bytes())?;
    }
    film.say(&frames, &console);
    Ok(verdict(&frames, drawer, &console))
}

fn outputs(args: &AnimateArgs) -> Result<(Target, Option<Output>)> {
    let target = Target::checked(&args.output)?;
    let json = args
        .json
        .as_ref()
        .map(|v| Output::checked("--json", v, &[]));
    let json = json.transpose()?;
    let file = Output::File(target.path());
    no_place_twice(&[("--output", Some(&file)), ("--json", json.as_ref())])?;
    let refuse = |culprit: &str, what: &str| {
        let mend = "leave it out, or write a .gif or a .png";
        Err(Error::input(culprit, what, mend))
    };
    if args.plays.is_some() && !target.counts_plays() {
        return refuse(
            "--loop",
            "only a GIF or an animated PNG says how often it plays",
        );
    }
    if args.look.no_background && matches!(target, Target::Mp4(..)) {
        return refuse("--no-background", "an MP4 has no transparent pixels");
    }
    Ok((target, json))
}

/// `--turntable 90` reads as an input called 90: nearly always a slip.
fn turn_is_no_input(args: &AnimateArgs) -> Result<()> {
    let number = |i: &&String| i.parse::<f64>().is_ok() && !std::path::Path::new(i).exists();
    match args.scene.inputs.iter().find(number) {
        Some(input) if args.turn_deg.is_some() => Err(Error::input(
            input.as_str(),
            "there is no such file",
            format!("for a turn of so many degrees write --turntable={input}"),
        )),
        _ => Ok(()),
    }
}

/// The times of the frames; an error where all of them would show the same.
fn times(args: &AnimateArgs, target: &Target, opened: &Opened, console: &Console) -> Result<Times> {
    let timeline = &opened.timeline;
    let moving_s = timeline
        .duration_s()
        .filter(|s| timeline.moves() && *s > 0.0);
    if moving_s.is_none() && args.turn_deg.is_none() {
        return Err(Error::input(
            args.scene.inputs.join(" "),
            "nothing moves in this scene: all frames would be the same",
            "add --turntable to see it from all sides, or give a scene whose [[key]] times lie after 0, an animated glTF file, or \
             meshes numbered frame by frame as in 'frames/%04d.obj'",
        ));
    }
    let (asked, fps) = rate(args, target);
    if (fps - asked).abs() > 1e-9 * asked {
        console.note(format!(
            "delays of a GIF are hundredths of a second, 2 at least: {} frames per second instead of {asked}",
            super::sections::round(fps)
        ));
    }
    args.times.times(fps, moving_s)
}

/// Frames a second that are asked for, and those that the target can have.
fn rate(args: &AnimateArgs, target: &Target) -> (f64, f64) {
    match target {
        Target::Gif(_) => {
            let asked = args.times.fps.unwrap_or(USUAL_GIF_FPS);
            (asked, gif::nearest_fps(asked))
        }
        _ => {
            let asked = args.times.fps.unwrap_or(USUAL_FPS);
            (asked, asked)
        }
    }
}

fn note_of_even_size(target: &Target, opened: &Opened, console: &Console) {
    let [width, height] = ffmpeg::even(opened.size_px);
    if matches!(target, Target::Mp4(..)) && [width, height] != opened.size_px {
        console.note(format!(
            "sizes of an MP4 are even: it becomes {width} x {height}, continued at its border"
        ));
    }
}

/// All that frames are drawn from.
struct Film<'a> {
    args: &'a AnimateArgs,
    opened: &'a Opened,
    times: Times,
    drawer: Drawer,
    /// The scene at the time of the last frame.
    shown: Shown,
    camera: crate::scene::Camera,
}

impl Film<'_> {
    fn draw(
        &mut self,
        frame: u32,
        session: &mut Session,
        console: &Console,
    ) -> Result<(image::RgbaImage, FrameReport)> {
        let watch = Stopwatch::start();
        let (opened, time_s) = (self.opened, self.times.at(frame));
        // The first was opened, and what stands still stays as it is.
        if frame > 0 && opened.timeline.moves() {
            let scene = opened.at(time_s)?;
            self.camera = scene.camera;
            self.shown = self.shown.updated(&scene);
        }
        let camera = match self.args.turn_deg {
            Some(turn_deg) => {
                let share = self.times.share(frame);
                turned(
                    &self.camera,
                    &opened.scene.bounds(),
                    opened.size_px,
                    turn_deg,
                    share,
                )
            }
            None => self.camera,
        };
        let view = opened.view_of(&self.shown.model.prepared, &camera);
        let style = self.args.look.style(opened);
        let drawn = picture::draw(session, &self.shown, &view, self.drawer, style)?;
        let report = FrameReport::of(time_s, &drawn.frames, watch.ms());
        if let (0, Drawer::By(strategy), Outcome::Complete) = (frame, self.drawer, &report.outcome)
        {
            let layers = session.layers(&strategy)?;
            let doubted = may_be_wrong(&layers, &self.shown.model.prepared, &view);
            warn_of_doubt(&doubted, self.drawer, console);
        }
        Ok((drawn.image, report))
    }

    fn json(
        &self,
        session: &Session,
        target: &Target,
        frames: &[FrameReport],
    ) -> serde_json::Value {
        json!({
            "scene": self.opened.scene.name,
            "output": target.path(),
            "format": target.name(),
            "resolution": self.opened.size_px,
            "supersample": self.args.look.supersample,
            "fps": self.times.fps,
            "start_s": self.times.start_s,
            "duration_s": self.times.duration_s(),
            "clip": self.args.clip.clip,
            "turntable_deg": self.args.turn_deg,
            "adapter": session.gpu().report(),
            "strategy": self.drawer.to_string(),
            "rasteriser": session.options().rasteriser.to_string(),
            "height_filter": session.options().height_filter.unwrap_or_default().to_string(),
            "median_drawn_ms": report::median_ms(frames),
            "frames": frames.iter().map(FrameReport::json).collect::<Vec<_>>(),
        })
    }

    /// All of it in a line.
    fn say(&self, frames: &[FrameReport], console: &Console) {
        let round = super::sections::round;
        let [width, height] = self.opened.size_px;
        let clocks = report::clocks(frames);
        let clocks = if clocks.is_empty() {
            clocks
        } else {
            format!("; clocks that ran: {clocks}")
        };
        console.note(format!(
            "{} frames of {width} x {height}, {} s at {} a second, drawn in {:.0} ms each{clocks}",
            frames.len(),
            round(self.times.duration_s()),
            round(self.times.fps),
            report::median_ms(frames),
        ));
    }
}

fn verdict(frames: &[FrameReport], drawer: Drawer, console: &Console) -> Verdict {
    let incomplete: Vec<&FrameReport> = frames
        .iter()
        .filter(|f| f.outcome != Outcome::Complete)
        .collect();
    let Some(first) = incomplete.first() else {
        return Verdict::Done;
    };
    console.failed(format!(
        "{drawer} did not draw all of {} frames, the first at {} s: {}",
        incomplete.len(),
        super::sections::round(first.time_s),
        first.outcome.reason().unwrap_or_default()
    ));
    Verdict::Failed
}

fn parse_turn(text: &str) -> Result<f64, String> {
    let degrees = parse_finite(text)
        .ok()
        .filter(|d| d.abs() > 0.0 && d.abs() <= 36_000.0);
    degrees.ok_or_else(|| "it must be a number of degrees, not 0\n  mend: write for example --turntable=90, or --turntable for all round".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_rounds_and_degrees_are_read_or_refused() {
        assert_eq!("forever".parse(), Ok(Plays::Forever));
        assert_eq!("3".parse(), Ok(Plays::Times(3)));
        for text in ["0", "-1", "70000", "ever", ""] {
            assert!(text.parse::<Plays>().is_err(), "{text}");
        }
        assert_eq!(parse_turn("-90"), Ok(-90.0));
        for text in ["0", "nan", "1e9", "all"] {
            assert!(parse_turn(text).is_err(), "{text}");
        }
    }
}
