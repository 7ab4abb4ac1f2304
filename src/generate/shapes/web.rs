//! The outline of a crank web: a cheek around the pin, a waist, and a counterweight on the far side of the axis.
//!
//! It consists of lines and arcs that meet tangentially, symmetric about the line from the axis to the pin. In local
//! coordinates the axis is the origin and the pin lies on +y.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec2;

use super::outline::{arc, corner_arc, subdivided};

/// Dimensions of a web.
#[derive(Clone, Copy, Debug)]
pub(super) struct Web {
    /// Distance from the axis to the pin.
    pub(super) throw: f64,
    /// Radius of the cheek around the pin.
    pub(super) cheek: f64,
    /// Point where cheek and counterweight meet, on the right.
    pub(super) waist: DVec2,
    /// Rounding radius of the waist.
    pub(super) waist_round: f64,
    /// Radius of the counterweight, around the axis.
    pub(super) weight: f64,
    /// Angle below the horizontal at which the unrounded shoulder of the counterweight would reach its rim.
    pub(super) shoulder: f64,
    /// Rounding radius of the shoulder.
    pub(super) shoulder_round: f64,
}

impl Web {
    /// The outline, counter-clockwise, with corners at most `step` apart.
    pub(super) fn outline(&self, step: f64) -> Vec<DVec2> {
        let right = self.right_half(step);
        let on_axis = 1..right.len() - 1;
        let left = right[on_axis].iter().rev().map(|p| DVec2::new(-p.x, p.y));
        let corners: Vec<DVec2> = right.iter().copied().chain(left).collect();
        subdivided(&corners, step)
    }

    /// The right half, from the counterweight's lowest point up to the cheek's highest.
    fn right_half(&self, step: f64) -> Vec<DVec2> {
        // The circle that rounds the shoulder touches the shoulder's line and, from inside, the rim.
        let rim = DVec2::from_angle(-self.shoulder) * self.weight;
        let along = (rim - self.waist).normalize();
        let start = self.waist - along.perp() * self.shoulder_round;
        let inner = self.weight - self.shoulder_round;
        let reach = start.dot(along);
        let to_centre = (reach * reach - start.length_squared() + inner * inner).sqrt() - reach;
        let rounding = start + along * to_centre;

        let cheek = DVec2::Y * self.throw;
        let from_cheek = self.waist - cheek;
        let tangent = from_cheek.to_angle() + (self.cheek / from_cheek.length()).acos();
        let on_cheek = cheek + DVec2::from_angle(tangent) * self.cheek;

        let mut points = arc(
            DVec2::ZERO,
            self.weight,
            [-FRAC_PI_2, rounding.to_angle()],
            step,
        );
        let angles = [rounding.to_angle(), along.perp().to_angle()];
        let shoulder = arc(rounding, self.shoulder_round, angles, step);
        let shoulder_end = shoulder[shoulder.len() - 1];
        // The rim's last point is the rounding's first, and the cheek's first point is that of its tangent.
        points.extend(&shoulder[1..]);
        let (centre, angles) = corner_arc(shoulder_end, self.waist, on_cheek, self.waist_round);
        points.extend(arc(centre, self.waist_round, angles, step));
        points.extend(arc(cheek, self.cheek, [tangent, FRAC_PI_2], step));
        // Exactly on the symmetry axis, so that rounding causes no kink where the mirrored half joins.
        let last = points.len() - 1;
        (points[0].x, points[last].x) = (0.0, 0.0);
        points
    }
}

/// Angles of the throws, in radians, for a four-stroke engine with even firing intervals. With an even number of throws the
/// second half mirrors the first, which avoids rocking moments.
pub(super) fn throw_angles(throws: usize) -> Vec<f64> {
    let step = 4.0 * PI / throws as f64;
    (0..throws)
        .map(|k| {
            let from_end = throws - 1 - k;
            let rank = if throws.is_multiple_of(2) {
                k.min(from_end)
            } else {
                k
            };
            rank as f64 * step
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::throw_angles;

    #[test]
    fn an_inline_four_is_flat_and_mirrored() {
        let degrees: Vec<f64> = throw_angles(4).iter().map(|a| a.to_degrees()).collect();
        assert_eq!(degrees, [0.0, 180.0, 180.0, 0.0]);
    }
}
