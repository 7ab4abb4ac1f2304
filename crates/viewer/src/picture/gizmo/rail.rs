//! Rails of handles in space, and the motion of a handle with the pointer.
//!
//! A rail maps an amount to a point: world units along a line, radians about an axis. A pointer motion in pixels moves the
//! handle by its component along the projected rail at the handle: nothing across it, and nothing if the rail is seen end-on.

use glam::{DQuat, DVec2, DVec3};

use crate::picture::world_view::WorldView;

/// A rail with a shorter projected length than this, in pixels, counts as seen end-on.
const END_ON_PX: f64 = 6.0;

/// Distance between the two points whose projections give the rail's direction, as a share of its length.
const STEP: f64 = 1e-3;

/// Rail of a handle, in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Rail {
    /// A line.
    Line {
        /// At amount 0.
        from: DVec3,
        /// Direction, of length 1.
        along: DVec3,
        /// Drawn length, in world units.
        length: f64,
    },
    /// A circle.
    Circle {
        /// Centre.
        centre: DVec3,
        /// Axis, of length 1.
        axis: DVec3,
        /// Vector from the centre to amount 0.
        arm: DVec3,
    },
}

impl Rail {
    /// The point at an amount.
    pub(super) fn at(&self, amount: f64) -> DVec3 {
        match *self {
            Self::Line { from, along, .. } => from + along * amount,
            Self::Circle { centre, axis, arm } => {
                centre + DQuat::from_axis_angle(axis, amount) * arm
            }
        }
    }

    /// Points between two amounts.
    pub(super) fn between(&self, [from, to]: [f64; 2], count: u32) -> Vec<DVec3> {
        let share = |i: u32| f64::from(i) / f64::from(count.max(1));
        let points = (0..=count).map(|i| self.at(from + (to - from) * share(i)));
        points.collect()
    }

    /// New amount of a handle after the pointer has moved by some pixels.
    pub(super) fn follow(&self, amount: f64, by_px: DVec2, view: &WorldView) -> f64 {
        let length = match self {
            Self::Line { length, .. } => *length,
            Self::Circle { .. } => 1.0,
        };
        let step = length * STEP;
        let ends = [amount - step, amount + step].map(|a| view.project(self.at(a)));
        let [Some(before), Some(after)] = ends else {
            return amount;
        };
        let px_per_unit = (after - before) / (2.0 * step);
        match (px_per_unit * length).length() < END_ON_PX {
            true => amount,
            false => amount + by_px.dot(px_per_unit) / px_per_unit.length_squared(),
        }
    }
}
