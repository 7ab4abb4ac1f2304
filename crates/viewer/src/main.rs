//! The command `cutaway` with the subcommand `view`, which opens the window.

use std::process::ExitCode;

fn main() -> ExitCode {
    cutaway_cli::main_with(Some(cutaway_viewer::window::open))
}
