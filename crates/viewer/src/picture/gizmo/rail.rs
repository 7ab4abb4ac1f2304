//! Rails of handles in space, and the motion of a handle with the pointer.
//!
//! A rail maps an amount, in world units along a line or in radians about an axis, to a point. A pointer motion in pixels moves the
//! handle only by its component along the projected rail at the handle, and not at all if the rail is seen end-on.

use glam::{DQuat, DVec2, DVec3};

use crate::picture::world_view::WorldView;

/// A rail with a shorter projected length than this, in pixels, counts as seen end-on.
const END_ON_PX: f64 = 6.0;

/// Two points this far apart, as a fraction of the rail's length, are projected to find the rail's direction in the picture.
const STEP: f64 = 1e-3;

/// Path along which a handle moves, in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Rail {
    /// A line.
    Line {
        /// Point at amount 0.
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
        /// Vector from the centre to the point at amount 0.
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

    /// `count + 1` points at equal steps between two amounts.
    pub(super) fn between(&self, [from, to]: [f64; 2], count: u32) -> Vec<DVec3> {
        let share = |i: u32| f64::from(i) / f64::from(count.max(1));
        let points = (0..=count).map(|i| self.at(from + (to - from) * share(i)));
        points.collect()
    }

    /// The handle's new amount after a pointer motion in pixels.
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
