//! Wall-clock time.

use web_time::Instant;

/// A stopwatch that runs from its creation.
pub struct Stopwatch(Instant);

impl Stopwatch {
    /// Starts a stopwatch.
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
