//! Outcomes of commands, and their exit codes.

use std::process::ExitCode;

use cutaway::Result;

/// Exit code of a command that Ctrl-C or SIGTERM has ended: 128 and the number of SIGINT, as shells have it.
pub(crate) const INTERRUPTED: u8 = 130;

/// Outcome of a command that ran to its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Verdict {
    Done,
    /// Done, but a stated expectation failed; standard error says which.
    Failed,
    /// Ended by Ctrl-C or SIGTERM; complete results are kept.
    Interrupted,
}

/// The exit code of a command, and what is said of its error.
pub(crate) fn exit_code(ended: Result<Verdict>) -> ExitCode {
    match ended {
        Ok(Verdict::Done) => ExitCode::SUCCESS,
        Ok(Verdict::Failed) => ExitCode::from(1),
        Ok(Verdict::Interrupted) => ExitCode::from(INTERRUPTED),
        Err(e) => {
            eprintln!("error: {e}");
            ExitCode::from(2)
        }
    }
}
