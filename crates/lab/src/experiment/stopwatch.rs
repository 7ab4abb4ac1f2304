//! Time on the clock of the wall.

use web_time::Instant;

/// Runs from when it is made.
pub struct Stopwatch(Instant);

impl Stopwatch {
    /// Starts one.
    #[allow(
        clippy::disallowed_methods,
        reason = "the one place that reads the clock, beside the device"
    )]
    pub fn start() -> Self {
        Self(Instant::now())
    }

    /// Milliseconds since its start.
    pub fn ms(&self) -> f64 {
        self.0.elapsed().as_secs_f64() * 1e3
    }
}
