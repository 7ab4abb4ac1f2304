//! The command `cutaway`: everything it does is in the library, under [`cutaway::cmd`].

use std::process::ExitCode;

fn main() -> ExitCode {
    cutaway::cmd::main()
}
