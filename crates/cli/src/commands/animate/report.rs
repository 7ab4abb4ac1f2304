//! Reports of an animation: frame by frame as JSON, and in one line.

use cutaway::gpu::ClockSet;
use cutaway::plan::Clock;
use cutaway::session::{Drawn, Outcome};
use cutaway_lab::experiment::{PerClock, Samples};
use serde_json::{Value, json};

/// Report of a frame.
pub(super) struct FrameReport {
    /// Scene time of the frame.
    pub(super) time_s: f64,
    /// Outcome of the frame: the worst of its samples.
    pub(super) outcome: Outcome,
    /// Clocks that ran.
    clocks: ClockSet,
    /// Milliseconds per clock, averaged over the samples for which it ran.
    time_ms: PerClock<Option<f64>>,
    /// Wall-clock milliseconds from the scene to the picture.
    /// None for a frame that already existed.
    pub(super) drawn_ms: Option<f64>,
}

impl FrameReport {
    /// Report of a frame, from the reports of its samples.
    pub(super) fn of(time_s: f64, frames: &[Drawn], drawn_ms: f64) -> Self {
        let incomplete = frames.iter().find(|f| f.outcome != Outcome::Complete);
        let mean = |clock: Clock| {
            let times: Vec<f64> = (frames.iter())
                .filter_map(|f| f.times.clocks_ms[clock as usize])
                .collect();
            let count = times.len() as f64;
            (!times.is_empty()).then(|| times.iter().sum::<f64>() / count)
        };
        Self {
            time_s,
            outcome: incomplete.map_or(Outcome::Complete, |f| f.outcome.clone()),
            clocks: frames
                .iter()
                .fold(ClockSet::NONE, |all, f| all.union(f.clocks)),
            time_ms: PerClock::from_fn(mean),
            drawn_ms: Some(drawn_ms),
        }
    }

    /// Report of a complete frame from an earlier run.
    pub(super) fn kept(time_s: f64) -> Self {
        Self {
            drawn_ms: None,
            ..Self::of(time_s, &[], 0.0)
        }
    }

    /// Returns true if the frame already existed.
    pub(super) fn is_kept(&self) -> bool {
        self.drawn_ms.is_none()
    }

    fn ran(&self) -> Vec<&'static str> {
        let ran = Clock::ALL.into_iter().filter(|c| self.clocks.contains(*c));
        ran.map(Clock::name).collect()
    }

    pub(super) fn json(&self) -> Value {
        json!({
            "time_s": self.time_s,
            "outcome": self.outcome.name(),
            "reason": self.outcome.reason(),
            "clocks": self.ran(),
            "time_ms": self.time_ms,
            "drawn_ms": self.drawn_ms,
            "kept": self.is_kept(),
        })
    }
}

/// Median time from scene to picture, over the frames that were drawn.
pub(super) fn median_ms(frames: &[FrameReport]) -> f64 {
    Samples::new(frames.iter().filter_map(|f| f.drawn_ms).collect()).median
}

/// How often each clock ran, as text; empty for exact.
pub(super) fn clocks(frames: &[FrameReport]) -> String {
    let counts = Clock::ALL.map(|c| (c, frames.iter().filter(|f| f.clocks.contains(c)).count()));
    let ran: Vec<String> = (counts.iter().filter(|(_, n)| *n > 0))
        .map(|(clock, n)| format!("{} in {n}", clock.name()))
        .collect();
    ran.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use cutaway::gpu::RunTimes;

    fn frame_that(outcome: Outcome, clocks_ms: [Option<f64>; 3]) -> Drawn {
        let mut clocks = ClockSet::NONE;
        for clock in Clock::ALL {
            if clocks_ms[clock as usize].is_some() {
                clocks = clocks.with(clock);
            }
        }
        let times = RunTimes {
            clocks_ms,
            ..RunTimes::default()
        };
        Drawn {
            outcome,
            clocks,
            times,
        }
    }

    #[test]
    fn samples_become_one_frame() {
        let full = Outcome::Overflowed("full".into());
        let frames = [
            frame_that(Outcome::Complete, [Some(8.0), None, Some(1.0)]),
            frame_that(full, [None, None, Some(3.0)]),
        ];
        let report = FrameReport::of(0.5, &frames, 20.0);
        let json = report.json();
        assert_eq!(
            json["outcome"], "overflowed",
            "one incomplete sample spoils the frame"
        );
        assert_eq!(json["clocks"], json!(["solid", "frame"]));
        assert_eq!(
            json["time_ms"],
            json!({ "solid": 8.0, "cut": null, "frame": 2.0 })
        );
        assert_eq!(clocks(&[report]), "solid in 1, frame in 1");
        assert_eq!(
            clocks(&[FrameReport::of(0.0, &[], 1.0)]),
            "",
            "exact has no clocks"
        );
    }
}
