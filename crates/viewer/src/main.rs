//! The command `cutaway` with a window: `cutaway view` starts it.

use std::process::ExitCode;

fn main() -> ExitCode {
    cutaway_cli::main_with(Some(cutaway_viewer::window::open))
}
