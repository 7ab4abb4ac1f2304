//! Profiles of solids of revolution (journals, bores, fillets), and how finely they are divided.
//!
//! A profile is a list of (station along the axis, radius), in order along the axis; steps perpendicular to the axis are allowed.

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::DVec2;

use super::milled::{Milled, WallSide};
use super::outline::circle;

/// Length-to-width ratio of a wall's quads: walls are straight along the axis, so they need less detail there.
const ASPECT: f64 = 3.5;

/// Fineness of the tessellation.
#[derive(Clone, Copy)]
pub(super) struct Fineness {
    /// Corners around a circle of radius `unit`.
    pub(super) detail: f64,
    /// Radius at which a circle gets `detail` corners.
    pub(super) unit: f64,
    /// Radius of fillets.
    pub(super) fillet: f64,
}

impl Fineness {
    /// Distance between corners along outlines.
    pub(super) fn step(self) -> f64 {
        TAU * self.unit / self.detail
    }

    /// Number of corners of a circle: smaller circles get fewer, but not in proportion, so that they still look round.
    pub(super) fn corners(self, radius: f64) -> usize {
        let quarter = 0.25 * self.detail * (radius / self.unit).sqrt();
        4 * (quarter.round() as usize).max(2)
    }

    /// Rings from one profile point to the next, without the first.
    pub(super) fn line(
        self,
        [x0, r0]: [f64; 2],
        [x1, r1]: [f64; 2],
    ) -> impl Iterator<Item = [f64; 2]> {
        let pieces = ((x1 - x0).abs() / (ASPECT * self.step())).ceil().max(1.0);
        (1..=pieces as usize).map(move |k| {
            let t = k as f64 / pieces;
            // Exact at both ends, because stations are compared with those of faces.
            [x0 * (1.0 - t) + x1 * t, r0 * (1.0 - t) + r1 * t]
        })
    }

    /// The points of a subdivided profile through the given corners.
    pub(super) fn profile(self, corners: &[[f64; 2]]) -> Vec<[f64; 2]> {
        let rest = corners.windows(2).flat_map(|w| self.line(w[0], w[1]));
        corners[..1].iter().copied().chain(rest).collect()
    }

    /// The fillet where a shaft of the given radius leaves a face at `x` in direction `sign`, starting at the face.
    pub(super) fn filleted(
        self,
        x: f64,
        sign: f64,
        radius: f64,
    ) -> impl DoubleEndedIterator<Item = [f64; 2]> {
        let pieces = ((self.detail / 32.0).round() as usize).max(1);
        (0..=pieces).map(move |k| {
            let (sin, cos) = (FRAC_PI_2 * k as f64 / pieces as f64).sin_cos();
            [
                x + sign * self.fillet * (1.0 - cos),
                radius + self.fillet * (1.0 - sin),
            ]
        })
    }

    /// A journal or pin between two faces.
    pub(super) fn journal(self, [from, to]: [f64; 2], radius: f64) -> Vec<[f64; 2]> {
        let mut profile: Vec<_> = self.filleted(from, 1.0, radius).collect();
        let mut end = self.filleted(to, -1.0, radius).rev();
        profile.extend(self.line([from + self.fillet, radius], [to - self.fillet, radius]));
        end.next();
        profile.extend(end);
        profile
    }
}

/// Rings of revolution around an axis through `centre`.
pub(super) fn turned(
    solid: &mut Milled,
    side: WallSide,
    centre: DVec2,
    corners: usize,
    profile: Vec<[f64; 2]>,
) -> (usize, usize) {
    let rings = profile.into_iter();
    solid.walls(side, rings.map(|[x, r]| (x, circle(centre, r, corners))))
}
