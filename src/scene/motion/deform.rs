//! Deformers: closed-form motions of space that bend any mesh.
//!
//! All act in part space; all except [`Deformer::Inflate`] act about an [`Axis`]. A deformer moves points and keeps the
//! connectivity: a closed mesh stays closed. The mesh may then intersect itself; its interior follows from parity, as for
//! any self-intersecting mesh.
//!
//! # Notation
//!
//! `C`, `A` and `B` are `centre`, `along` and `across` of the axis, and `D = A x B`: `(B, D, A)` is right-handed. A point
//! `P = C + x B + y D + h A` has the coordinates `(x, y, h)`, a normal `n = p B + q D + r A` the components `(p, q, r)`. Primes
//! mark results. Normals are multiplied by the Jacobian's cofactors, which keeps them outward where the map preserves
//! handedness; their length has no meaning between deformers.
//!
//! Deformers are applied in order, each to the point and normal produced by the previous one. Morph targets and the skin are applied before
//! the first deformer; targets keep the normal, and the skin multiplies it by the cofactors of its linear part.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use crate::scene::Bounds;

/// A line about which a deformer acts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    /// A point on the axis, where a turn is 0 and a wave's angle is minus its phase.
    pub centre: DVec3,
    /// Unit vector along it.
    pub along: DVec3,
    /// Unit vector perpendicular to `along`: the direction of bending and of a wave's displacement.
    pub across: DVec3,
}

/// A motion of space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Deformer {
    /// Turns about the axis in proportion to the position along it: right-handed about `along` by `t = turn_per_unit h`.
    ///
    /// ```text
    /// x' = x cos t - y sin t     p1 = p cos t - q sin t     p' = p1
    /// y' = x sin t + y cos t     q1 = p sin t + q cos t     q' = q1
    /// h' = h                                                r' = r - turn_per_unit (x' q1 - y' p1)
    /// ```
    Twist {
        /// Axis of the twist.
        axis: Axis,
        /// Radians per unit of length along the axis.
        turn_per_unit: f64,
    },
    /// Rolls the axis into an arc towards `across`: with `k = turn_per_unit` the axis keeps its length and becomes a circle
    /// of radius `1/|k|` about `C + B/k`; planes `h = const` stay plane and turn by `t = k h`.
    ///
    /// ```text
    /// x' = x cos t + (1 - cos t) / k     p' = m p cos t + r sin t     m = 1 - k x
    /// y' = y                             q' = m q
    /// h' = (1 / k - x) sin t             r' = r cos t - m p sin t
    /// ```
    ///
    /// For `k = 0` it is the identity; near it, `(1 - cos t) / k` is `h s(t/2) sin(t/2)` and `sin t / k` is `h s(t)` with
    /// `s(a) = sin a / a`, which loses no digits. The arc has no end: it continues beyond the part with the same curvature, and
    /// meets itself after `|h| = pi / |k|`. Points beyond the centre of the arc, `k x > 1`, end up on its other side with
    /// reversed handedness.
    Bend {
        /// Axis that is bent.
        axis: Axis,
        /// Radians per unit of length along the axis: the arc's curvature.
        turn_per_unit: f64,
    },
    /// Moves points along `across` by a sine of their position along the axis; with growing phase the wave travels towards `along`.
    ///
    /// ```text
    /// a = 2 pi h / period - phase
    /// x' = x + amplitude sin a     p' = p
    /// y' = y                       q' = q
    /// h' = h                       r' = r - p amplitude (2 pi / period) cos a
    /// ```
    Wave {
        /// Axis along which the wave travels.
        axis: Axis,
        /// Largest displacement.
        amplitude: f64,
        /// Length of a period, not zero.
        period: f64,
        /// Radians by which the wave has travelled.
        phase: f64,
    },
    /// Moves every position by `by n / |n|` along its own normal. The normal starts as [`Motion::outward`](super::Motion::outward) and does
    /// not change. Where there is no normal (or `n = 0`) nothing moves.
    Inflate {
        /// Distance; negative shrinks.
        by: f64,
    },
}

impl Axis {
    /// `(x, y, h)` of a vector from the centre, or `(p, q, r)` of a normal.
    fn components(&self, v: DVec3) -> DVec3 {
        let side = self.along.cross(self.across);
        DVec3::new(v.dot(self.across), v.dot(side), v.dot(self.along))
    }

    fn vector(&self, c: DVec3) -> DVec3 {
        let side = self.along.cross(self.across);
        self.across * c.x + side * c.y + self.along * c.z
    }
}

impl Deformer {
    /// Maps a point and its normal.
    pub fn apply(&self, point: DVec3, normal: DVec3) -> (DVec3, DVec3) {
        let about = |axis: &Axis, f: &dyn Fn(DVec3, DVec3) -> (DVec3, DVec3)| {
            let (place, normal) = f(
                axis.components(point - axis.centre),
                axis.components(normal),
            );
            (axis.centre + axis.vector(place), axis.vector(normal))
        };
        match self {
            Self::Twist {
                axis,
                turn_per_unit,
            } => about(axis, &|at, n| twisted(*turn_per_unit, at, n)),
            Self::Bend {
                axis,
                turn_per_unit,
            } => about(axis, &|at, n| bent(*turn_per_unit, at, n)),
            Self::Wave {
                axis,
                amplitude,
                period,
                phase,
            } => {
                let angle = TAU * axis.components(point - axis.centre).z / period - phase;
                let slope = amplitude * TAU / period * angle.cos();
                (
                    point + axis.across * (amplitude * angle.sin()),
                    normal - axis.along * (slope * normal.dot(axis.across)),
                )
            }
            Self::Inflate { by } => (point + normal.normalize_or_zero() * *by, normal),
        }
    }

    /// A box that contains the images of all points of a box, for every deformer; it need not be the smallest one.
    pub fn bounds(&self, of: Bounds) -> Bounds {
        if of.is_empty() {
            return of;
        }
        let moved = match self {
            Self::Twist { axis, .. } => {
                // Distance from the axis and position along it do not change: a cylinder.
                let corners = of.corners().map(|c| axis.components(c - axis.centre));
                let radius = corners
                    .iter()
                    .map(|c| c.truncate().length())
                    .fold(0.0, f64::max);
                let ends = corners.map(|c| axis.centre + axis.along * c.z);
                let reach = DVec3::from_array(
                    axis.along
                        .to_array()
                        .map(|a| radius * (1.0 - a * a).max(0.0).sqrt()),
                );
                grown(Bounds::from_points(ends), reach)
            }
            Self::Bend {
                axis,
                turn_per_unit,
            } => bounds_of_bent(axis, *turn_per_unit, of),
            Self::Wave {
                axis, amplitude, ..
            } => grown(of, axis.across.abs() * amplitude.abs()),
            Self::Inflate { by } => grown(of, DVec3::splat(by.abs())),
        };
        // Margin for rounding errors, here and in `apply`.
        let far = [of, moved].map(|b| b.min.abs().max(b.max.abs()).max_element());
        grown(moved, DVec3::splat(far[0].max(far[1]) * 1e-12))
    }
}

fn grown(bounds: Bounds, by: DVec3) -> Bounds {
    Bounds {
        min: bounds.min - by,
        max: bounds.max + by,
    }
}

fn twisted(turn_per_unit: f64, at: DVec3, n: DVec3) -> (DVec3, DVec3) {
    let (sin, cos) = (turn_per_unit * at.z).sin_cos();
    let turned = |v: DVec3| DVec3::new(v.x * cos - v.y * sin, v.x * sin + v.y * cos, v.z);
    let (to, mut n) = (turned(at), turned(n));
    n.z -= turn_per_unit * (to.x * n.y - to.y * n.x);
    (to, n)
}

/// `sin a / a`.
fn sinc(a: f64) -> f64 {
    if a.abs() < 1e-4 {
        1.0 - a * a / 6.0
    } else {
        a.sin() / a
    }
}

fn bent(turn_per_unit: f64, at: DVec3, n: DVec3) -> (DVec3, DVec3) {
    let t = turn_per_unit * at.z;
    let (sin, cos) = t.sin_cos();
    let rise = at.z * sinc(t * 0.5) * (t * 0.5).sin();
    let m = 1.0 - turn_per_unit * at.x;
    (
        DVec3::new(at.x * cos + rise, at.y, at.z * sinc(t) - at.x * sin),
        DVec3::new(
            m * n.x * cos + n.z * sin,
            m * n.y,
            n.z * cos - m * n.x * sin,
        ),
    )
}

/// Sums the extremes of each term: too wide where the terms do not reach their extremes together.
fn bounds_of_bent(axis: &Axis, turn_per_unit: f64, of: Bounds) -> Bounds {
    let at = Bounds::from_points(of.corners().map(|c| axis.components(c - axis.centre)));
    // Sines, cosines and terms derived from them have their extremes at the ends and at multiples of a quarter turn: take all
    // such multiples in the interval, or those of one whole turn.
    let quarter = PI * 0.5;
    let ends = [at.min.z, at.max.z].map(|h| turn_per_unit * h);
    let [first, last] = [ends[0].min(ends[1]), ends[0].max(ends[1])];
    let first_quarter = (first / quarter).ceil();
    let inside = (0..4)
        .map(|i| (first_quarter + f64::from(i)) * quarter)
        .filter(|t| *t <= last);
    let turns: Vec<f64> = ends.into_iter().chain(inside).collect();
    let range = |f: &dyn Fn(f64) -> f64| {
        let values = turns.iter().map(|t| f(*t));
        values.fold([f64::INFINITY, f64::NEG_INFINITY], |[lo, hi], v| {
            [lo.min(v), hi.max(v)]
        })
    };
    let times = |a: [f64; 2], lo: f64, hi: f64| {
        let products = [a[0] * lo, a[0] * hi, a[1] * lo, a[1] * hi];
        [
            products.into_iter().fold(f64::INFINITY, f64::min),
            products.into_iter().fold(f64::NEG_INFINITY, f64::max),
        ]
    };
    // The position along the axis that turns by `t`; without curvature every turn is 0 and the ends are the extremes.
    let (rise, run) = if turn_per_unit.abs() > 0.0 {
        (
            range(&|t| t / turn_per_unit * sinc(t * 0.5) * (t * 0.5).sin()),
            range(&|t| t / turn_per_unit * sinc(t)),
        )
    } else {
        ([0.0; 2], [at.min.z, at.max.z])
    };
    let across = times(range(&|t| t.cos()), at.min.x, at.max.x);
    let back = times(range(&|t| t.sin()), at.min.x, at.max.x);
    let to = Bounds {
        min: DVec3::new(across[0] + rise[0], at.min.y, run[0] - back[1]),
        max: DVec3::new(across[1] + rise[1], at.max.y, run[1] - back[0]),
    };
    Bounds::from_points(to.corners().map(|c| axis.centre + axis.vector(c)))
}
