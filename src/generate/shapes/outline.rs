//! Closed polygons in the plane, counter-clockwise: circles, arcs, rounded corners and insets.

use std::f64::consts::TAU;

use glam::DVec2;

/// A regular polygon with corners on a circle.
pub(super) fn circle(centre: DVec2, radius: f64, corners: usize) -> Vec<DVec2> {
    (0..corners)
        .map(|j| centre + DVec2::from_angle(TAU * j as f64 / corners as f64) * radius)
        .collect()
}

/// Points on an arc, both ends included, at most `step` apart.
pub(super) fn arc(centre: DVec2, radius: f64, [from, to]: [f64; 2], step: f64) -> Vec<DVec2> {
    let pieces = ((to - from).abs() * radius / step).ceil().max(1.0);
    (0..=pieces as usize)
        .map(|i| centre + DVec2::from_angle(from + (to - from) * i as f64 / pieces) * radius)
        .collect()
}

/// A polygon with every edge cut into pieces no longer than `step`.
pub(super) fn subdivided(corners: &[DVec2], step: f64) -> Vec<DVec2> {
    let mut points = Vec::new();
    for (i, a) in corners.iter().enumerate() {
        let b = corners[(i + 1) % corners.len()];
        let pieces = (a.distance(b) / step).ceil().max(1.0);
        points.extend((0..pieces as usize).map(|k| a.lerp(b, k as f64 / pieces)));
    }
    points
}

/// A polygon with every edge moved inward by a distance, each parallel to the original. The radius of arcs that bulge
/// outward must be larger than the distance.
pub(super) fn inset(points: &[DVec2], distance: f64) -> Vec<DVec2> {
    let n = points.len();
    let inward = |i: usize| (points[(i + 1) % n] - points[i]).perp().normalize();
    (0..n)
        .map(|i| {
            let (before, after) = (inward((i + n - 1) % n), inward(i));
            points[i] + (before + after) * (distance / (1.0 + before.dot(after)))
        })
        .collect()
}

/// The circle of a given radius that is tangent to two rays from a corner: its centre, and the angles at which it meets
/// the incoming and the outgoing edge.
pub(super) fn corner_arc(
    before: DVec2,
    corner: DVec2,
    after: DVec2,
    radius: f64,
) -> (DVec2, [f64; 2]) {
    let (back, ahead) = ((before - corner).normalize(), (after - corner).normalize());
    let middle = (back + ahead).normalize();
    let half_sin = middle.perp_dot(ahead).abs();
    let centre = corner + middle * (radius / half_sin);
    let towards = |edge: DVec2| (corner + edge * edge.dot(centre - corner) - centre).to_angle();
    let (from, to) = (towards(back), towards(ahead));
    // The short way round.
    let turn = (to - from + 1.5 * TAU).rem_euclid(TAU) - 0.5 * TAU;
    (centre, [from, from + turn])
}

/// Signed area by the shoelace formula.
#[cfg(test)]
pub(super) fn area(points: &[DVec2]) -> f64 {
    let n = points.len();
    (0..n)
        .map(|i| points[i].perp_dot(points[(i + 1) % n]))
        .sum::<f64>()
        * 0.5
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_inset_square_is_a_smaller_square() {
        let square = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)].map(DVec2::from);
        let inner = inset(&subdivided(&square, 0.5), 0.25);
        assert!((area(&inner) - 3.5 * 3.5).abs() < 1e-12, "{}", area(&inner));
    }

    #[test]
    fn a_rounded_corner_touches_both_edges() {
        let (centre, [from, to]) = corner_arc(DVec2::ZERO, DVec2::X, DVec2::new(1.0, 1.0), 0.25);
        assert!(centre.distance(DVec2::new(0.75, 0.25)) < 1e-12, "{centre}");
        assert!((to - from - TAU / 4.0).abs() < 1e-12, "{from}..{to}");
    }
}
