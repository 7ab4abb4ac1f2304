//! `encode`: makes one animation of numbered pictures, as if `animate` had written it directly.
//!
//! Pictures written by `animate` store the identity and the length of their animation ([`Stamp`]), so a picture that is missing, incomplete
//! or from another animation is an error at any position. Pictures from other programs are taken in the order of their numbers.
//!
//! One picture is in memory at a time. A GIF is an exception: all pictures stay in memory, compressed, until its colours are known.

use std::io::Cursor;
use std::path::{Path, PathBuf};

use clap::Args;
use cutaway::{Error, Result};
use cutaway_io::load::frames::{Pattern, USUAL_FPS};
use cutaway_io::load::{Disk, input_file};
use cutaway_lab::experiment::Identity;

use super::encoder::encoder;
use super::plays::LoopArgs;
use super::stamp::Stamp;
use super::target::AnimationOutput;
use super::times::{Times, parse_fps};
use super::{gif, note_of_even_size};
use crate::console::{Console, ConsoleArgs};
use crate::interrupt::Interrupt;
use crate::verdict::Verdict;
use crate::writing::places::InputFiles;

pub(crate) const EXAMPLES: &str = "\
Examples:
  cutaway encode 'frames/%04d.png' -o run.gif --fps 12.5
  cutaway encode 'frames/%04d.png' -o run.mp4

The pictures belong to one animation, drawn at once or in shares: cutaway animate ... -o 'frames/%04d.png' [--shard I/N]. They must be
numbered without a gap from 0 or 1 on, and are not changed. Ctrl-C or SIGTERM ends the command after the present picture, with exit
code 130 and without a file.";

/// Options of `encode`.
#[derive(Args)]
pub(crate) struct EncodeArgs {
    /// Numbered pictures: 'frames/%04d.png'
    #[arg(value_name = "PATTERN")]
    frames: String,
    /// Output animation: .gif, .png or .apng (animated PNG), or .mp4 (needs ffmpeg)
    #[arg(long, short, value_name = "FILE", help_heading = "Output")]
    output: String,
    /// Pictures per second; a GIF stores delays in hundredths of a second
    #[arg(long, value_name = "N", value_parser = parse_fps, default_value_t = USUAL_FPS, allow_hyphen_values = true, help_heading = "Output")]
    fps: f64,
    #[command(flatten)]
    loops: LoopArgs,
    #[command(flatten)]
    console: ConsoleArgs,
}

/// Runs `encode`.
pub(crate) fn run(args: &EncodeArgs) -> Result<Verdict> {
    let console = Console::new(args.console, 1);
    let target = AnimationOutput::checked(&args.output)?;
    if let AnimationOutput::Numbered(_) = target {
        let help = "name one file: run.gif, run.png or run.mp4";
        return Err(Error::input(
            "--output",
            "the pictures are numbered already",
            help,
        ));
    }
    args.loops.must_fit(&target)?;
    let pattern = Pattern::parse(&args.frames)?;
    let (files, gap) = pattern.files(None, &Disk)?;
    let (first, stamp) = picture(&files[0])?;
    if let Some(stamp) = &stamp {
        must_be_whole(&args.frames, &pattern, stamp)?;
    } else if let Some(gap) = gap {
        return Err(Error::input(&args.frames, gap.text, DRAW_MISSING));
    }
    let inputs = InputFiles::default();
    inputs.add(files.iter().cloned());
    inputs.keep_from([("--output", target.path())])?;
    let fps = match target {
        AnimationOutput::Gif(_) => gif::nearest_fps(args.fps),
        _ => args.fps,
    };
    let times = Times {
        start_s: 0.0,
        fps,
        count: files.len() as u32,
    };
    let size_px = [first.width(), first.height()];
    note_of_even_size(&target, size_px, &console);
    let plays = args.loops.plays();
    let interrupt = Interrupt::listen("encode", "picture")?;
    let mut encoder = encoder(&target, size_px, &times, plays, Identity::default())?;
    console.expect_frames(times.count);
    for (number, file) in files.iter().enumerate() {
        if interrupt.is_wanted() {
            console.note("interrupted: no file was written");
            return Ok(Verdict::Interrupted);
        }
        let (frame, own) = picture(file)?;
        must_belong(file, number as u32, own.as_ref(), stamp.as_ref())?;
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
        cutaway::scene::numbers::round(fps)
    ));
    Ok(Verdict::Done)
}

const DRAW_MISSING: &str =
    "draw the missing pictures: the command that drew the others skips existing ones";

/// Maximum number of missing pictures listed by name.
const MOST_NAMED: usize = 5;

/// Rejects an animation with missing pictures.
fn must_be_whole(culprit: &str, pattern: &Pattern, stamp: &Stamp) -> Result<()> {
    let files = (1..=stamp.count).map(|number| pattern.file(number));
    let missing: Vec<PathBuf> = files.filter(|file| !file.is_file()).collect();
    if missing.is_empty() {
        return Ok(());
    }
    let named = missing.iter().take(MOST_NAMED);
    let named: Vec<String> = named.map(|file| file.display().to_string()).collect();
    let what = format!(
        "{} of {} pictures are missing: {}{}",
        missing.len(),
        stamp.count,
        named.join(", "),
        if missing.len() > MOST_NAMED {
            ", ..."
        } else {
            ""
        }
    );
    Err(Error::input(culprit, what, DRAW_MISSING))
}

/// Rejects a picture that is not from the first picture's animation, or is incomplete while the first is complete, or the reverse.
fn must_belong(path: &Path, index: u32, own: Option<&Stamp>, first: Option<&Stamp>) -> Result<()> {
    let (what, help) = match (own, first) {
        (None, None) => return Ok(()),
        (Some(own), Some(first)) => {
            let expected = Stamp {
                number: index + 1,
                ..first.clone()
            };
            if *own == expected {
                return Ok(());
            }
            if own.run == first.run && own.count == first.count {
                let what = format!("it is frame {} of {}", own.number, own.count);
                (
                    what,
                    "draw it again: remove it, and run the command that drew the others",
                )
            } else {
                let what = "the first was drawn by another command, program or device".to_owned();
                (
                    what,
                    "draw all of them with one command, on devices of the same kind",
                )
            }
        }
        (None, Some(_)) => (
            "it is incomplete, or not a frame of the first picture's animation".to_owned(),
            "draw it again: the same command redraws incomplete pictures",
        ),
        (Some(_), None) => (
            "it is a frame of an animation, but the first is not, or is incomplete".to_owned(),
            "draw the first again: the same command redraws incomplete pictures",
        ),
    };
    Err(Error::file(path, what, help))
}

/// Reads a picture and its stamp.
fn picture(path: &Path) -> Result<(image::RgbaImage, Option<Stamp>)> {
    let help = "draw it again: the same command redraws incomplete pictures";
    let bytes = input_file::read(path, &Disk)?;
    let read = image::load_from_memory_with_format(&bytes, image::ImageFormat::Png);
    let picture = read.map_err(|e| Error::file(path, format!("it is a broken PNG: {e}"), help))?;
    Ok((picture.to_rgba8(), Stamp::of_whole(Cursor::new(bytes))))
}
