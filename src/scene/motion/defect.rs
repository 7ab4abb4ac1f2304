//! Defects of a manually built [`Motion`].
//!
//! A motion with defects causes no panic: missing data moves nothing, and a joint that the pose lacks stays in its bind pose.
//! Only the result is wrong; this check finds the cause.

use super::Motion;

/// Tolerance of the sum of a position's weights, which should be 1: a few f32 roundings.
const WEIGHT_SUM: f64 = 1e-5;

/// Reason why a motion does not fit its mesh.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MotionDefect {
    /// A target with fewer or more positions than the mesh.
    #[error("morph target {target} moves {found} positions, the mesh has {positions}")]
    Target {
        /// Index of the target.
        target: usize,
        /// Number of positions that it moves.
        found: usize,
        /// Number of positions of the mesh.
        positions: usize,
    },
    /// A displacement that is NaN or infinite.
    #[error("morph target {target} moves position {position} by NaN or infinity")]
    NotFinite {
        /// Index of the target.
        target: usize,
        /// Index of the position.
        position: usize,
    },
    /// The list of first influences per position has the wrong length, is not ascending, or exceeds the list of joint influences.
    #[error("the joint influences of position {position} are not in the list of influences")]
    Pulls {
        /// The first such position.
        position: usize,
    },
    /// Weights that are negative or do not sum to 1.
    #[error("the weights of position {position} sum to {sum}, or one of them is negative")]
    Weights {
        /// Index of the position.
        position: usize,
        /// Sum of its weights.
        sum: f64,
    },
}

impl Motion {
    /// The first defect of this motion for a mesh with `positions` positions, if any.
    pub fn defect(&self, positions: usize) -> Option<MotionDefect> {
        for (target, moves) in self.targets.iter().enumerate() {
            if moves.len() != positions {
                let found = moves.len();
                return Some(MotionDefect::Target {
                    target,
                    found,
                    positions,
                });
            }
            if let Some(position) = moves.iter().position(|d| !d.is_finite()) {
                return Some(MotionDefect::NotFinite { target, position });
            }
        }
        if self.first_pull.is_empty() && self.pulls.is_empty() {
            return None;
        }
        let starts = &self.first_pull;
        if let Some(position) = starts.windows(2).position(|w| w[0] > w[1]) {
            return Some(MotionDefect::Pulls { position });
        }
        let ends = starts.last().map(|end| *end as usize) == Some(self.pulls.len());
        if starts.len() != positions + 1 || starts[0] != 0 || !ends {
            let position = starts.len().saturating_sub(1).min(positions);
            return Some(MotionDefect::Pulls { position });
        }
        (0..positions).find_map(|position| {
            let weights = self.pulls_of(position).iter().map(|p| f64::from(p.weight));
            let sum: f64 = weights.clone().sum();
            // Written so that NaN is a defect, too; a position without joint influences stays where it is.
            let is_whole = weights.clone().all(|w| w >= 0.0) && (sum - 1.0).abs() <= WEIGHT_SUM;
            let is_fine = is_whole || weights.count() == 0;
            (!is_fine).then_some(MotionDefect::Weights { position, sum })
        })
    }
}
