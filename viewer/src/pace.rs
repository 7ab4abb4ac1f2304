//! How finely to draw so that a hand that moves something is followed.
//!
//! While something moves, pictures are drawn at a half, a quarter or an eighth of the resolution, as coarse as it takes to stay within
//! [`BUDGET_MS`]; when it has rested for [`REST`], whole. What a frame takes is told by the device when it is done.

use std::time::Duration;

/// What a frame may take while something moves.
pub const BUDGET_MS: f64 = 33.0;

/// How long nothing must move for a whole picture.
pub const REST: Duration = Duration::from_millis(150);

/// The coarsest.
const MOST_DIVISOR: u32 = 8;

/// By how much coarser than the window pictures are drawn.
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

    /// Takes in what a frame took that was drawn with a divisor.
    pub fn learn(&mut self, divisor: u32, took_ms: f64) {
        if took_ms > BUDGET_MS {
            // A frame of a quarter of the pixels takes no less than a quarter of the time.
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
        // A picture at rest that takes long says nothing of finer ones while something moves.
        pace.learn(1, 30.0);
        assert_eq!(pace.divisor(true), 4);
    }
}
