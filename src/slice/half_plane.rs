//! Half-planes, and the convex regions in which they intersect.

use glam::DVec2;

/// Distance, as a share of the size of the trimmed object, below which a point counts as on the line: far above the rounding error of
/// coordinates, far below anything visible.
const ON_LINE: f64 = 1e-13;

/// The points of a plane at which `normal.p + offset` is negative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfPlane {
    /// Points away from the half-plane.
    pub normal: DVec2,
    /// Value at (0, 0).
    pub offset: f64,
}

impl HalfPlane {
    pub(super) fn value(&self, at: DVec2) -> f64 {
        self.normal.dot(at) + self.offset
    }

    fn slack(&self, size: f64) -> f64 {
        ON_LINE * (self.normal.length() * size + self.offset.abs())
    }

    /// Returns true if all points are inside or on the line.
    pub(super) fn holds(&self, points: &[DVec2], size: f64) -> bool {
        let slack = self.slack(size);
        points.iter().all(|p| self.value(*p) <= slack)
    }

    /// Returns true if all points are outside or on the line.
    pub(super) fn misses(&self, points: &[DVec2], size: f64) -> bool {
        let slack = self.slack(size);
        points.iter().all(|p| self.value(*p) >= -slack)
    }

    /// The part of a convex polygon inside the half-plane (Sutherland and Hodgman 1974).
    fn clip(&self, polygon: &[DVec2]) -> Vec<DVec2> {
        let next = polygon.iter().cycle().skip(1);
        let mut clipped = Vec::with_capacity(polygon.len() + 1);
        for (a, b) in polygon.iter().zip(next) {
            let [of_a, of_b] = [*a, *b].map(|p| self.value(p));
            if of_a <= 0.0 {
                clipped.push(*a);
            }
            if (of_a < 0.0 && of_b > 0.0) || (of_a > 0.0 && of_b < 0.0) {
                clipped.push(a.lerp(*b, of_a / (of_a - of_b)));
            }
        }
        clipped
    }
}

/// The intersection of half-planes within a square around the origin, a convex polygon, counter-clockwise. Empty if the
/// intersection has no area.
pub(super) fn in_common(half_planes: &[HalfPlane], reach: f64) -> Vec<DVec2> {
    let square = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    let square = square.map(|(x, y)| DVec2::new(x, y) * reach).to_vec();
    let polygon = (half_planes.iter()).fold(square, |polygon, half| half.clip(&polygon));
    if polygon.len() < 3 {
        Vec::new()
    } else {
        polygon
    }
}

/// The part of the segment from `a` to `b` that lies in all half-planes, as two fractions of its length.
pub(super) fn stretch(half_planes: &[HalfPlane], [a, b]: [DVec2; 2]) -> Option<[f64; 2]> {
    let mut stretch = [0.0_f64, 1.0];
    for half in half_planes {
        let [of_a, of_b] = [a, b].map(|p| half.value(p));
        let at = of_a / (of_a - of_b);
        match (of_a > 0.0, of_b > 0.0) {
            (true, true) => return None,
            (true, false) => stretch[0] = stretch[0].max(at),
            (false, true) => stretch[1] = stretch[1].min(at),
            (false, false) => {}
        }
    }
    (stretch[0] < stretch[1]).then_some(stretch)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn left_of(x: f64) -> HalfPlane {
        HalfPlane {
            normal: DVec2::X,
            offset: -x,
        }
    }

    fn above(y: f64) -> HalfPlane {
        HalfPlane {
            normal: DVec2::NEG_Y,
            offset: y,
        }
    }

    #[test]
    fn a_corner_is_what_two_have_in_common() {
        let corner = in_common(&[left_of(0.5), above(0.25)], 1.0);
        let next = corner.iter().cycle().skip(1);
        let twice: f64 = corner.iter().zip(next).map(|(a, b)| a.perp_dot(*b)).sum();
        assert_eq!(0.5 * twice, 1.5 * 0.75, "{corner:?}");
        assert!(in_common(&[left_of(-2.0)], 1.0).is_empty(), "out of reach");
    }

    #[test]
    fn a_segment_is_cut_at_the_lines() {
        let ends = [DVec2::ZERO, DVec2::new(4.0, 2.0)];
        assert_eq!(
            stretch(&[left_of(3.0), above(0.5)], ends),
            Some([0.25, 0.75])
        );
        assert_eq!(stretch(&[left_of(-1.0)], ends), None);
        assert_eq!(stretch(&[], ends), Some([0.0, 1.0]));
    }

    #[test]
    fn what_touches_a_line_is_on_one_side_of_it() {
        let points = [DVec2::ZERO, DVec2::new(1.0 + 1e-16, 3.0)];
        assert!(left_of(1.0).holds(&points, 3.0), "rounding is let pass");
        assert!(!left_of(0.999).holds(&points, 3.0), "and no more");
        assert!(above(3.0).misses(&points, 3.0), "above nothing");
    }
}
