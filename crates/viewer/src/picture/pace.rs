//! Adaptive resolution while something moves.
//!
//! While something moves, pictures are drawn at full, half, a quarter or an eighth of the resolution, as needed to stay within
//! [`BUDGET_MS`]. After [`REST`] without motion follow the full resolution and then its samples. The device reports when a frame is done.

use std::time::Duration;

use crate::picture::screen::Sample;

/// Frame time budget while something moves.
pub const BUDGET_MS: f64 = 33.0;

/// Time without motion before a full-resolution picture is drawn.
pub const REST: Duration = Duration::from_millis(150);

/// The largest divisor of the resolution.
const MOST_DIVISOR: u32 = 8;

/// Resolution or sample of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Detail {
    /// Divisor of the window's resolution.
    Coarse(u32),
    /// A sample at full resolution.
    Sample(Sample),
}

impl Detail {
    /// The picture at full resolution.
    pub const WHOLE: Self = Self::Coarse(1);

    /// Divisor of the window's resolution.
    pub fn divisor(self) -> u32 {
        match self {
            Self::Coarse(divisor) => divisor,
            Self::Sample(_) => 1,
        }
    }

    /// The sample, if it is one.
    pub fn sample(self) -> Option<Sample> {
        match self {
            Self::Coarse(_) => None,
            Self::Sample(sample) => Some(sample),
        }
    }

    /// The frame to draw after the `last` one of the same scene: in motion only a finer one; at rest the full-resolution picture, then its
    /// samples, `per_side` along each side of a pixel. `None` if nothing is left to draw.
    pub fn next(last: Option<Self>, divisor: u32, is_moving: bool, per_side: u32) -> Option<Self> {
        let begun = |index| Sample { index, per_side };
        match last {
            None => Some(Self::Coarse(divisor)),
            Some(last) if is_moving => (last.divisor() > divisor).then_some(Self::Coarse(divisor)),
            Some(Self::Coarse(1)) => (per_side > 1).then_some(Self::Sample(begun(0))),
            Some(Self::Coarse(_)) => Some(Self::WHOLE),
            Some(Self::Sample(last)) if last.per_side != per_side => Some(Self::WHOLE),
            Some(Self::Sample(last)) => {
                (!last.is_last()).then_some(Self::Sample(begun(last.index + 1)))
            }
        }
    }
}

/// Chooses the resolution divisor from the times of earlier frames.
#[derive(Clone, Copy, Debug)]
pub struct Pace {
    moving: u32,
}

impl Default for Pace {
    fn default() -> Self {
        Self { moving: 1 }
    }
}

impl Pace {
    /// The divisor of the resolution for the next frame.
    pub fn divisor(&self, is_moving: bool) -> u32 {
        if is_moving { self.moving } else { 1 }
    }

    /// Records the time of a frame drawn with a divisor.
    pub fn learn(&mut self, divisor: u32, took_ms: f64) {
        if took_ms > BUDGET_MS {
            // A frame with a quarter of the pixels takes at least a quarter of the time.
            let mut next = divisor * 2;
            let mut expected = took_ms / 4.0;
            while expected > BUDGET_MS {
                next *= 2;
                expected /= 4.0;
            }
            self.moving = self.moving.max(next).min(MOST_DIVISOR);
        } else if divisor == self.moving && took_ms * 4.0 < BUDGET_MS {
            self.moving = (self.moving / 2).max(1);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn at_rest_the_whole_is_followed_by_its_samples() {
        let mut last = None;
        let mut drawn = Vec::new();
        while let Some(next) = Detail::next(last, 1, false, 2) {
            drawn.push(next);
            last = Some(next);
        }
        assert_eq!(drawn.len(), 5);
        assert_eq!(drawn[0], Detail::WHOLE);
        assert!(drawn[4].sample().is_some_and(Sample::is_last));
        // When motion starts again, an unchanged picture is not redrawn more coarsely.
        assert_eq!(Detail::next(last, 4, true, 2), None);
        assert_eq!(Detail::next(None, 4, true, 2), Some(Detail::Coarse(4)));
        let coarse = Some(Detail::Coarse(4));
        assert_eq!(Detail::next(coarse, 1, false, 2), Some(Detail::WHOLE));
        assert_eq!(
            Detail::next(Some(Detail::WHOLE), 1, false, 1),
            None,
            "no samples"
        );
    }

    #[test]
    fn slow_frames_become_coarser_until_they_fit_and_finer_when_there_is_time() {
        let mut pace = Pace::default();
        assert_eq!(pace.divisor(true), 1);
        pace.learn(1, 440.0);
        assert_eq!(pace.divisor(true), 4);
        assert_eq!(pace.divisor(false), 1, "at rest all of it");
        pace.learn(4, 50.0);
        assert_eq!(pace.divisor(true), 8);
        pace.learn(8, 500.0);
        assert_eq!(pace.divisor(true), 8, "no coarser than that");
        pace.learn(8, 5.0);
        assert_eq!(pace.divisor(true), 4);
        // The time of a full-resolution frame at rest does not lower the divisor used during motion.
        pace.learn(1, 30.0);
        assert_eq!(pace.divisor(true), 4);
    }
}
