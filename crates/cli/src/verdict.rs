//! Outcomes of commands, and their exit codes.

use std::process::ExitCode;

use cutaway::error::{Diagnostic, Result};

/// Exit code of a command ended by Ctrl-C or SIGTERM: 128 plus the number of SIGINT, as in shells.
pub(crate) const INTERRUPTED: u8 = 130;

/// Outcome of a command that ran to its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Verdict {
    Done,
    /// Done, but a stated expectation failed; standard error names it.
    Failed,
    /// Ended by Ctrl-C or SIGTERM; complete results are kept.
    Interrupted,
}

/// Prints a command's error, if any, and returns its exit code.
pub(crate) fn exit_code(ended: Result<Verdict>) -> ExitCode {
    match ended {
        Ok(Verdict::Done) => ExitCode::SUCCESS,
        Ok(Verdict::Failed) => ExitCode::from(1),
        Ok(Verdict::Interrupted) => ExitCode::from(INTERRUPTED),
        Err(e) => {
            let message = Diagnostic::from(&e);
            eprintln!("{}: {message}", message.severity.label());
            ExitCode::from(2)
        }
    }
}
