//! Time on the clock of the wall.

use std::time::Instant;

/// Runs from when it is made.
pub(super) struct Stopwatch(Instant);

impl Stopwatch {
    /// Starts one.
    #[allow(
        clippy::disallowed_methods,
        reason = "the one place of the command that reads the clock"
    )]
    pub(super) fn start() -> Self {
        Self(Instant::now())
    }

    /// Milliseconds since its start.
    pub(super) fn ms(&self) -> f64 {
        self.0.elapsed().as_secs_f64() * 1e3
    }
}
