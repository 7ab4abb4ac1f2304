//! The command as tests start it: cargo builds the programs of a package before its tests, and those of no other.

use std::process::ExitCode;

fn main() -> ExitCode {
    cutaway_cli::main()
}
