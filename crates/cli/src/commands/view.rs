//! `view`: a window for dragging cuts and comparing strategies.
//!
//! The window is a separate program, `cutaway-viewer`, so that this crate builds without a GUI toolkit. `cutaway-viewer` runs this command
//! with a [`Window`]: the arguments, the document and the errors are the same. Without a window, the command looks for
//! `cutaway-viewer` in its own folder and passes its arguments on.

use std::env;
use std::path::PathBuf;
use std::process::{Command, ExitCode};

use clap::Args;
use cutaway::{Error, Result};
use cutaway_io::document::Document;
use cutaway_io::load::Assets;

use crate::console::{Console, ConsoleArgs};
use crate::input::args::{AdapterArgs, DrawOptionArgs, SceneArgs};
use crate::input::look::{Defaults, LookArgs};
use crate::input::stdin;
use crate::input::when::TimeArgs;
use crate::verdict::{Verdict, exit_code};

pub(crate) const EXAMPLES: &str = "\
Examples:
  cutaway view bracket.stl
  cutaway view engine.glb --section x=50% --relief fractal:amplitude=4%
  cutaway view scene.toml
  cutaway view                    # an empty window: drop a file into it";

/// Name of the program with the window.
const PROGRAM: &str = "cutaway-viewer";

/// Options of `view`.
#[derive(Args)]
pub(crate) struct ViewArgs {
    #[command(flatten)]
    scene: SceneArgs,
    #[command(flatten)]
    when: TimeArgs,
    #[command(flatten)]
    look: LookArgs,
    #[command(flatten)]
    device: AdapterArgs,
    #[command(flatten)]
    options: DrawOptionArgs,
    #[command(flatten)]
    console: ConsoleArgs,
    /// Report the CPU cost of the window's frames at exit
    #[arg(long, help_heading = "Measuring")]
    profile: bool,
}

/// Initial state of a window.
#[derive(Debug, Default)]
pub struct Opened {
    /// The document that results from the arguments; empty if they name no input.
    pub document: Document,
    /// The files that were read for it.
    pub assets: Assets,
    /// Part of the requested adapter's name.
    pub adapter: Option<String>,
    /// True if the cost of frames is reported at the end.
    pub profile: bool,
}

/// Opens a window and stays until it is closed.
pub type Window = fn(Opened) -> Result<()>;

/// Runs `view`: opens the window, or starts the program that has one.
pub(crate) fn run(args: &ViewArgs, window: Option<Window>) -> ExitCode {
    if let Err(refused) = must_be_files(&args.scene.inputs) {
        return exit_code(Err(refused));
    }
    match window {
        Some(window) => exit_code(open(args).and_then(window).map(|()| Verdict::Done)),
        None => hand_over().unwrap_or_else(|e| exit_code(Err(e))),
    }
}

/// Rejects a model from standard input: a window reloads its files, and saves scenes that refer to them.
fn must_be_files(inputs: &[String]) -> Result<()> {
    if inputs.iter().any(|input| input == stdin::WORD) {
        let what = "a window may read its files again, but standard input can be read only once";
        let help = "save the model to a file first, and give the file's name";
        return Err(Error::input(stdin::WORD, what, help));
    }
    Ok(())
}

fn open(args: &ViewArgs) -> Result<Opened> {
    let adapter = args.device.adapter.clone();
    if args.scene.inputs.is_empty() {
        return Ok(Opened {
            adapter,
            profile: args.profile,
            ..Opened::default()
        });
    }
    let console = Console::new(args.console, 1);
    console.step("opening");
    let mut document = args.scene.document(None)?;
    args.when.amend(&mut document)?;
    args.look.amend(&mut document)?;
    args.options.amend(&mut document)?;
    let usual = Defaults::of_pictures()?;
    let subject = args.scene.open(document, None, usual, &console)?;
    subject.save_beside([], &args.scene.edits)?;
    let (document, assets) = subject.into_document();
    Ok(Opened {
        document,
        assets,
        adapter,
        profile: args.profile,
    })
}

/// Starts the program with the window, with this program's arguments, and exits with its code.
fn hand_over() -> Result<ExitCode> {
    let program = PROGRAM.to_owned() + env::consts::EXE_SUFFIX;
    let beside = env::current_exe()
        .ok()
        .map(|own| own.with_file_name(&program));
    let beside = beside.filter(|path| path.is_file());
    let program = beside.unwrap_or_else(|| PathBuf::from(program));
    let ended = Command::new(&program).args(env::args_os().skip(1)).status();
    let ended = ended.map_err(|e| {
        Error::input(
            "view",
            format!("{} cannot be started: {e}", program.display()),
            "install it from the folder of cutaway with `cargo install --path crates/viewer`, or put it beside this program or into a folder of $PATH",
        )
    })?;
    // A process ended by a signal has no exit code.
    let code = ended.code().and_then(|code| u8::try_from(code).ok());
    Ok(ExitCode::from(code.unwrap_or(1)))
}
