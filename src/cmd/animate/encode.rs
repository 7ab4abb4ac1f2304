//! `encode`: numbered pictures become one animation, as if `animate` had drawn them into it.
//!
//! One picture is in memory at a time, but for a GIF, which keeps all packed until its colours are known.

use std::path::Path;

use clap::Args;

use super::super::Verdict;
use super::super::console::{Console, ConsoleArgs};
use super::super::interrupt::Interrupt;
use super::super::places::InputFiles;
use super::encoder::encoder;
use super::target::Target;
use super::times::{Times, parse_fps};
use super::{Plays, gif, note_of_even_size};
use crate::experiment::Identity;
use crate::load::frames::{Pattern, USUAL_FPS};
use crate::load::{Disk, input_file};
use crate::{Error, Result};

pub(in crate::cmd) const EXAMPLES: &str = "\
Examples:
  cutaway encode 'frames/%04d.png' -o run.gif --fps 12.5
  cutaway encode 'frames/%04d.png' -o run.mp4

The pictures are those of one animation, drawn in one go or in shares: cutaway animate ... -o 'frames/%04d.png' [--shard I/N]. They are
numbered without a gap, from 0 or 1 on, and stay as they are.";

/// Options of `encode`.
#[derive(Args)]
pub(in crate::cmd) struct EncodeArgs {
    /// Numbered pictures: 'frames/%04d.png'
    #[arg(value_name = "PATTERN")]
    frames: String,
    /// The animation: .gif, .png or .apng (animated PNG), or .mp4 (needs ffmpeg)
    #[arg(long, short, value_name = "FILE", help_heading = "Output")]
    output: String,
    /// Pictures per second; delays of a GIF are hundredths of a second
    #[arg(long, value_name = "N", value_parser = parse_fps, default_value_t = USUAL_FPS, allow_hyphen_values = true, help_heading = "Output")]
    fps: f64,
    /// How often a GIF or an animated PNG plays [default: forever]
    #[arg(
        long = "loop",
        value_name = "N|forever",
        allow_hyphen_values = true,
        help_heading = "Output"
    )]
    plays: Option<Plays>,
    #[command(flatten)]
    console: ConsoleArgs,
}

/// Runs `encode`.
pub(in crate::cmd) fn run(args: &EncodeArgs) -> Result<Verdict> {
    let console = Console::new(args.console, 1);
    let target = Target::checked(&args.output)?;
    if let Target::Numbered(_) = target {
        let help = "name one file: run.gif, run.png or run.mp4";
        return Err(Error::input(
            "--output",
            "the pictures are numbered already",
            help,
        ));
    }
    if args.plays.is_some() && !target.counts_plays() {
        let what = "only a GIF or an animated PNG says how often it plays";
        return Err(Error::input(
            "--loop",
            what,
            "leave it out, or write a .gif or a .png",
        ));
    }
    let (files, gap) = Pattern::parse(&args.frames)?.files(None, &Disk)?;
    if let Some(gap) = gap {
        let help =
            "draw the missing pictures: the command that drew the others draws no more than those";
        return Err(Error::input(&args.frames, gap, help));
    }
    let inputs = InputFiles::default();
    inputs.add(files.iter().cloned());
    inputs.keep_from([("--output", target.path())])?;
    let fps = match target {
        Target::Gif(_) => gif::nearest_fps(args.fps),
        _ => args.fps,
    };
    let times = Times {
        start_s: 0.0,
        fps,
        count: files.len() as u32,
    };
    let first = picture(&files[0])?;
    let size_px = [first.width(), first.height()];
    note_of_even_size(&target, size_px, &console);
    let plays = args.plays.unwrap_or(Plays::Forever);
    let interrupt = Interrupt::listen("encode", "picture")?;
    let mut encoder = encoder(&target, size_px, &times, plays, Identity::default())?;
    console.expect_frames(times.count);
    for (number, file) in files.iter().enumerate() {
        if interrupt.is_wanted() {
            console.note("interrupted: no file was written");
            return Ok(Verdict::Interrupted);
        }
        let frame = picture(file)?;
        if [frame.width(), frame.height()] != size_px {
            let [w, h] = size_px;
            let what = format!(
                "it has {} x {} pixels, the first has {w} x {h}",
                frame.width(),
                frame.height()
            );
            return Err(Error::file(
                file,
                what,
                "take pictures of other animations out of the folder",
            ));
        }
        encoder.add(number as u32, &frame, true)?;
        console.frame_done();
    }
    encoder.finish(&console)?;
    console.note(format!(
        "{} pictures, {} a second",
        times.count,
        crate::scene::numbers::round(fps)
    ));
    Ok(Verdict::Done)
}

fn picture(path: &Path) -> Result<image::RgbaImage> {
    let help = "draw it again: the same command draws what is not whole";
    let bytes = input_file::read(path, &Disk)?;
    let read = image::load_from_memory_with_format(&bytes, image::ImageFormat::Png);
    let picture = read.map_err(|e| Error::file(path, format!("it is no whole PNG: {e}"), help))?;
    Ok(picture.to_rgba8())
}
