//! `animate`: a scene over time, or from all sides, as a GIF, an animated PNG, a film, or numbered pictures.
//!
//! All frames are drawn by one session, so that what does not change from frame to frame is built once. An animation takes as long
//! as drawing that many pictures, plus encoding them. The file appears at its destination when it is complete.

mod apng;
pub(crate) mod encode;
mod encoder;
mod ffmpeg;
mod film;
mod gif;
mod identity;
mod mp4;
mod numbered;
mod palette;
mod plays;
mod program;
mod report;
mod stamp;
mod sweep;
mod target;
mod times;
mod turntable;

use clap::Args;
use cutaway::session::Outcome;
use cutaway::{Error, Result};
use cutaway_io::document::{Document, Value};
use cutaway_io::load::frames::{Pattern, USUAL_FPS};
use cutaway_lab::experiment::{Identity, Renderer};

use crate::console::{Console, ConsoleArgs};
use crate::input::args::{AdapterArgs, DrawOptionArgs, SceneArgs, parse_finite};
use crate::input::look::{Defaults, LookArgs};
use crate::input::shard::Shard;
use crate::input::stdin;
use crate::input::subject::SceneInput;
use crate::input::when::ClipArgs;
use crate::interrupt::Interrupt;
use crate::verdict::Verdict;
use crate::writing::output::Output;
use crate::writing::places::{no_place_twice, paths_of};
use crate::writing::results::Results;
use encoder::encoder;
use film::Film;
use plays::LoopArgs;
use report::FrameReport;
use sweep::{PlaneSweep, parse_sweep};
use target::AnimationOutput;
use times::{Times, TimesArgs};

pub(crate) const EXAMPLES: &str = "\
Examples:
  cutaway animate shape:crank --section -z=50% --relief fractal --turntable -o crank.gif
  cutaway animate walk.glb --clip run --section x=50% -o run.mp4
  cutaway animate scene.toml --duration 6 --fps 30 --loop 1 -o scene.png     # an animated PNG, without loss
  cutaway animate part.stl --sweep y=10%:90% -o sweep.gif
  cutaway animate part.stl --section z=50% --turntable=90 --frames 12 -o 'frames/%04d.png'

The scene defines what moves, by keys of a scene file or animations of a glTF file. A turntable is added to that motion.
Ctrl-C or SIGTERM ends the command after the present frame, with exit code 130. Numbered frames that are complete are kept, and the
same command continues after them; an animation in one file is then not written.";

/// Default frame rate of a GIF, with delays of 8/100 s: about half of a film's rate, which halves file size and drawing time.
const USUAL_GIF_FPS: f64 = 12.5;

/// Default size of a GIF, small because the format compresses little more than runs of equal pixels.
const USUAL_GIF_SIZE_PX: [i64; 2] = [640, 480];

/// Options of `animate`.
#[derive(Args)]
pub(crate) struct AnimateArgs {
    #[command(flatten)]
    scene: SceneArgs,
    #[command(flatten)]
    clip: ClipArgs,
    #[command(flatten)]
    times: TimesArgs,
    /// A plane that moves through the model from one position to another: `y=10%:90%`, `-z=0:25`; the side to which the axis points is kept
    #[arg(
        long,
        value_name = "AXIS=FROM:TO",
        value_parser = parse_sweep,
        allow_hyphen_values = true,
        help_heading = "Cuts"
    )]
    sweep: Option<PlaneSweep>,
    /// Moves the camera around the up axis, a full turn or N degrees, in addition to all other motion: --turntable=90
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
    /// Output animation: .gif, .png or .apng (animated PNG), .mp4 (needs ffmpeg), or a PNG for each frame: 'frames/%04d.png'
    #[arg(long, short, value_name = "FILE|PATTERN", help_heading = "Output")]
    output: String,
    /// Draw only one contiguous share of numbered frames: 0/8 to 7/8; auto takes the share from the array task (Slurm and others); use auto/8 if only some of 8 tasks are resubmitted
    #[arg(long, value_name = "I/N|auto", help_heading = "Output")]
    shard: Option<Shard>,
    #[command(flatten)]
    loops: LoopArgs,
    #[command(flatten)]
    look: LookArgs,
    /// Outcome, clocks and times of every frame as JSON
    #[arg(long, value_name = "FILE|-", help_heading = "Output")]
    json: Option<String>,
    #[command(flatten)]
    device: AdapterArgs,
    #[command(flatten)]
    options: DrawOptionArgs,
    #[command(flatten)]
    console: ConsoleArgs,
}

/// Runs `animate`.
pub(crate) fn run(args: &AnimateArgs) -> Result<Verdict> {
    let console = Console::new(args.console, 1);
    console.step("opening");
    let (target, json) = outputs(args)?;
    turn_is_no_input(args)?;
    // One numbered mesh per frame: at any other rate some would be shown twice and others not at all.
    let played_fps = rate(args, &target, false).1;
    let mut document = args.scene.document(Some(played_fps))?;
    args.clip.amend(&mut document)?;
    args.look.amend(&mut document)?;
    args.options.amend(&mut document)?;
    // Set after all options, because some cutaways depend on the size of the picture.
    if matches!(target, AnimationOutput::Gif(_)) && document.get("resolution").is_err() {
        document.set("resolution", USUAL_GIF_SIZE_PX.map(Value::from).to_vec())?;
    }
    if let Some(sweep) = args.sweep {
        add_sweep(sweep, &mut document, args, &target)?;
    }
    let subject = args.scene.open(
        document,
        Some(args.times.start_s),
        Defaults::of_pictures()?,
        &console,
    )?;
    let times = times(args, &target, &subject, &console)?;
    note_of_even_size(&target, subject.size_px(), &console);

    let renderer_request = subject.renderer_request()?;
    let plays = args.loops.plays();
    let files = target.files(times.count).into_iter();
    let files = files.map(|file| ("--output", file));
    let json_file = [("--json", json.as_ref())];
    subject.save_beside(files.chain(paths_of(&json_file)), &args.scene.edits)?;
    let mut session = args.device.session(args.json.is_some())?;
    // Computed for numbered frames only, because it reads the input files once more.
    let run = match target {
        AnimationOutput::Numbered(_) => identity::of(&subject, &times, args.turn_deg, &session),
        _ => Identity::default(),
    };
    // Listen before the encoder begins a file: otherwise Ctrl-C would leave it half written.
    let interrupt = Interrupt::listen("animate", "frame")?;
    let mut encoder = encoder(&target, subject.size_px(), &times, plays, run)?;
    let own = args.shard.unwrap_or(Shard::WHOLE).of_row(times.count);
    console.expect_frames(own.len() as u32);
    let shown = subject.shown()?;
    let view = subject.view(&shown.model.prepared);
    let chosen = renderer_request.classify(Some(session.gpu()), (&shown.model, &view), &console);
    let renderer = chosen.renderer;
    let mut film = Film {
        args,
        subject: &subject,
        times,
        own: own.clone(),
        chosen,
        shown,
        scene: subject.scene.clone(),
        has_failed: false,
    };
    let mut frames = Vec::with_capacity(own.len());
    for frame in own.clone() {
        if interrupt.is_wanted() {
            break;
        }
        let report = if encoder.has(frame) {
            FrameReport::kept(times.at(frame))
        } else {
            let (image, report) = film.draw(frame, &mut session, &console)?;
            match encoder.add(frame, &image, report.outcome == Outcome::Complete) {
                // An encoder in its own process may have been ended by the same Ctrl-C.
                Err(_) if interrupt.is_wanted() => break,
                added => added?,
            }
            report
        };
        frames.push(report);
        console.frame_done();
        if frame == own.start + 1 {
            film.announce(&frames, &console);
        }
    }
    if interrupt.is_wanted() && frames.len() < own.len() {
        console.note(match &target {
            AnimationOutput::Numbered(_) => format!(
                "{} of {} frames are complete: the same command continues from there",
                frames.len(),
                own.len()
            ),
            _ => "interrupted: no file was written".to_owned(),
        });
        return Ok(Verdict::Interrupted);
    }
    let mut results = Results::default();
    if let Some(output) = &json {
        let json = film.json(&session, &target, &frames);
        results.add(output, format!("{json:#}\n").into_bytes())?;
    }
    encoder.finish(&console)?;
    results.place()?;
    film.say(&frames, &console);
    Ok(match verdict(&frames, renderer, &console) {
        Verdict::Done if film.has_failed => Verdict::Failed,
        verdict => verdict,
    })
}

/// Adds the moving plane, for the requested duration or as long as anything else moves.
fn add_sweep(
    sweep: PlaneSweep,
    document: &mut Document,
    args: &AnimateArgs,
    target: &AnimationOutput,
) -> Result<()> {
    let timeline = document.timeline(&mut stdin::assets())?;
    let bounds = timeline
        .stage()?
        .unwrap_or_else(|| timeline.rest().bounds());
    let times = args
        .times
        .times(rate(args, target, false).1, timeline.duration_s())?;
    // The sweep reaches its end position at the last frame, which starts one frame before the end of the animation.
    let steps = times.count.max(2) as f64;
    let end_s = times.start_s + times.duration_s();
    let last_s = end_s - times.duration_s() / steps;
    let span_s = [times.start_s, last_s, end_s];
    sweep.amend(document, &bounds, span_s, &args.scene.sections)
}

fn outputs(args: &AnimateArgs) -> Result<(AnimationOutput, Option<Output>)> {
    let target = AnimationOutput::checked(&args.output)?;
    let json = args
        .json
        .as_ref()
        .map(|v| Output::checked("--json", v, &[]));
    let json = json.transpose()?;
    let file = Output::File(target.path());
    no_place_twice(&[("--output", Some(&file)), ("--json", json.as_ref())])?;
    if args.shard.is_some() && !matches!(target, AnimationOutput::Numbered(_)) {
        return Err(Error::input(
            "--shard",
            "only numbered frames are drawn in shares",
            "write -o 'frames/%04d.png' and, when all shares are complete, run: cutaway encode 'frames/%04d.png' -o run.gif",
        ));
    }
    args.loops.must_fit(&target)?;
    if args.look.no_background && matches!(target, AnimationOutput::Mp4(..)) {
        let help = "leave it out, or write a .gif or a .png";
        let what = "an MP4 has no transparent pixels";
        return Err(Error::input("--no-background", what, help));
    }
    Ok((target, json))
}

/// Rejects `--turntable 90`, which would be parsed as an input file named 90.
fn turn_is_no_input(args: &AnimateArgs) -> Result<()> {
    let number = |i: &&String| i.parse::<f64>().is_ok() && !std::path::Path::new(i).exists();
    match args.scene.inputs.iter().find(number) {
        Some(input) if args.turn_deg.is_some() => Err(Error::input(
            input.as_str(),
            "there is no such file",
            format!("for a turn by this angle write --turntable={input}"),
        )),
        _ => Ok(()),
    }
}

/// The frame times; an error if all frames would be the same.
fn times(
    args: &AnimateArgs,
    target: &AnimationOutput,
    subject: &SceneInput,
    console: &Console,
) -> Result<Times> {
    let timeline = &subject.timeline;
    let moving_s = timeline
        .duration_s()
        .filter(|s| timeline.moves() && *s > 0.0);
    if moving_s.is_none() && args.turn_deg.is_none() {
        return Err(Error::input(
            args.scene.inputs.join(" "),
            "nothing moves in this scene: all frames would be the same",
            "add --turntable to see it from all sides, or --sweep y=10%:90% to let a plane move, or give a scene whose [[key]] times lie after 0, an animated glTF file, or \
             meshes numbered frame by frame as in 'frames/%04d.obj'",
        ));
    }
    let (asked, fps) = rate(args, target, moving_s.is_none());
    if args.times.fps.is_some() && (fps - asked).abs() > 1e-9 * asked {
        console.note(format!(
            "a GIF stores delays in hundredths of a second, at least 2: it plays at {} frames per second instead of {asked}",
            cutaway::scene::numbers::round(fps)
        ));
    }
    args.times.times(fps, moving_s)
}

/// Requested frames per second, and those that the target supports.
fn rate(args: &AnimateArgs, target: &AnimationOutput, stands_still: bool) -> (f64, f64) {
    match target {
        AnimationOutput::Gif(_) => {
            // Numbered meshes are played once each, at the rate used for other outputs.
            let usual = match args.scene.inputs.iter().any(|i| Pattern::is_in(i)) {
                true => USUAL_FPS,
                false => USUAL_GIF_FPS,
            };
            let asked = args.times.rate(usual, stands_still);
            (asked, gif::nearest_fps(asked))
        }
        _ => {
            let asked = args.times.rate(USUAL_FPS, stands_still);
            (asked, asked)
        }
    }
}

fn note_of_even_size(target: &AnimationOutput, size_px: [u32; 2], console: &Console) {
    let [width, height] = ffmpeg::even(size_px);
    if matches!(target, AnimationOutput::Mp4(..)) && [width, height] != size_px {
        console.note(format!(
            "an MP4 needs even sizes: it becomes {width} x {height}, padded at its border"
        ));
    }
}

fn verdict(frames: &[FrameReport], renderer: Renderer, console: &Console) -> Verdict {
    let incomplete: Vec<&FrameReport> = frames
        .iter()
        .filter(|f| f.outcome != Outcome::Complete)
        .collect();
    let Some(first) = incomplete.first() else {
        return Verdict::Done;
    };
    console.failed(format!(
        "{renderer} drew {} frames incompletely, the first at {} s: {}",
        incomplete.len(),
        cutaway::scene::numbers::round(first.time_s),
        first.outcome.reason().unwrap_or_default()
    ));
    Verdict::Failed
}

fn parse_turn(text: &str) -> Result<f64, String> {
    let degrees = parse_finite(text)
        .ok()
        .filter(|d| d.abs() > 0.0 && d.abs() <= 36_000.0);
    degrees.ok_or_else(|| "it must be a number of degrees, not 0\n  help: write for example --turntable=90, or --turntable for all round".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn degrees_are_read_or_refused() {
        assert_eq!(parse_turn("-90"), Ok(-90.0));
        for text in ["0", "nan", "1e9", "all"] {
            assert!(parse_turn(text).is_err(), "{text}");
        }
    }
}
