//! The command `cutaway`: everything it does is in the library [`cutaway_cli`].

use std::process::ExitCode;

fn main() -> ExitCode {
    cutaway_cli::main()
}
