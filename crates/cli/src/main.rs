//! The command `cutaway`, implemented in the library [`cutaway_cli`].

use std::process::ExitCode;

fn main() -> ExitCode {
    cutaway_cli::main()
}
