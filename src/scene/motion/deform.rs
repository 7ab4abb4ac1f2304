//! Deformers: closed-form motions of space that bend any mesh.
//!
//! All act about an axis through a centre, in part space. A deformer moves points, never edges: a mesh that was closed stays
//! closed. It may fold through itself; what is inside is then told by parity, like that of any self-crossing mesh.

use glam::DVec3;

/// A line about which a deformer acts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    /// A point on it.
    pub centre: DVec3,
    /// Unit vector along it.
    pub along: DVec3,
    /// Unit vector across it: where bending goes and waves swing.
    pub across: DVec3,
}

/// A motion of space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Deformer {
    /// Turns about the axis, by more the farther along it.
    Twist {
        /// About what.
        axis: Axis,
        /// Radians per unit of length along the axis.
        turn_per_unit: f64,
    },
    /// Rolls the axis into an arc towards `across`.
    Bend {
        /// What is bent.
        axis: Axis,
        /// Radians per unit of length along the axis: the arc's curvature.
        turn_per_unit: f64,
    },
    /// Moves points along `across` by a sine of their place along the axis.
    Wave {
        /// Along what it runs.
        axis: Axis,
        /// Greatest displacement.
        amplitude: f64,
        /// Length of a period.
        period: f64,
        /// Radians by which it has run.
        phase: f64,
    },
    /// Moves every position outwards along its own normal.
    Inflate {
        /// Distance; negative shrinks.
        by: f64,
    },
}
