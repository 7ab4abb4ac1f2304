//! Sum of two convex solids: all points that are a point of the one plus a point of the other (Minkowski).
//!
//! A corner of the sum is a corner of each solid that lies farthest in a common direction. A corner lies farthest in the directions of the
//! cone that its faces' normals span. So a pair of corners is left out if an edge at one of them rises along all normals at the other: then
//! its other end lies farther in each of those directions. Few pairs are left, and their hull is the sum.
//!
//! Cost: for each pair of corners, its edges times its normals; then the hull of about twice as many points as the sum has corners. Cannot:
//! leave out pairs at corners of faces too thin to have a reliable normal.

use glam::DVec3;

use super::hull::ConvexHull;

/// A face whose normal is shorter than this share of its edges' product has no reliable normal.
const THIN: f64 = 1e-7;
/// Cosine above which an edge counts as rising along a normal: beyond the rounding of a reliable normal.
const RISING: f64 = 1e-8;

/// Directions at a corner of a hull.
#[derive(Clone, Debug, Default)]
struct HullCorner {
    /// Unit normals of the faces.
    normals: Vec<DVec3>,
    /// Unit directions to the neighbours.
    edges: Vec<DVec3>,
    /// True if a face has no reliable normal.
    is_thin: bool,
}

impl HullCorner {
    /// The corners of a hull, in its order.
    fn of(hull: &ConvexHull) -> Vec<Self> {
        let mut corners = vec![Self::default(); hull.corners.len()];
        for t in &hull.triangles {
            let [a, b, c] = t.map(|i| hull.corners[i as usize]);
            let normal = (b - a).cross(c - a);
            let is_thin = normal.length() <= THIN * (b - a).length() * (c - a).length();
            let normal = normal.normalize_or_zero();
            for k in 0..3 {
                let [here, next] = [t[k], t[(k + 1) % 3]].map(|i| hull.corners[i as usize]);
                let corner = &mut corners[t[k] as usize];
                corner.normals.push(normal);
                // Each edge runs once in each direction around the hull.
                corner.edges.push((next - here).normalize_or_zero());
                corner.is_thin |= is_thin;
            }
        }
        corners
    }

    /// Returns true if a neighbour lies farther in every direction in which `other` lies farthest.
    fn is_surpassed_where(&self, other: &Self) -> bool {
        let rises = |normal: &DVec3, edge: &DVec3| normal.dot(*edge) > RISING;
        let mut edges = self.edges.iter();
        !other.is_thin && edges.any(|edge| other.normals.iter().all(|n| rises(n, edge)))
    }
}

impl ConvexHull {
    /// The sum of two solids; `None` if rounding leaves it no volume.
    pub(crate) fn sum(&self, other: &Self) -> Option<Self> {
        let (own, others) = (HullCorner::of(self), HullCorner::of(other));
        let mut points = Vec::new();
        for (a, at) in own.iter().zip(&self.corners) {
            for (b, by) in others.iter().zip(&other.corners) {
                if !a.is_surpassed_where(b) && !b.is_surpassed_where(a) {
                    points.push(*at + *by);
                }
            }
        }
        Self::of(&points)
    }
}

#[cfg(test)]
mod tests {
    use super::super::hull::tests::scattered;
    use super::*;

    fn hull(points: &[DVec3]) -> ConvexHull {
        ConvexHull::of(points).unwrap_or_else(|| panic!("a hull"))
    }

    #[test]
    fn the_sum_reaches_as_far_as_both_together_in_every_direction() {
        let ball = |count| -> Vec<DVec3> {
            let points = scattered(count).into_iter();
            points.map(|p| p.normalize_or(DVec3::X)).collect()
        };
        let cube: Vec<DVec3> = (0..8)
            .map(|i| DVec3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2)))
            .collect();
        let turned: Vec<DVec3> = (cube.iter())
            .map(|p| glam::DMat3::from_rotation_x(0.3) * *p * DVec3::new(5.0, 1.0, 1e-3))
            .collect();
        let cone: Vec<DVec3> = [DVec3::ZERO]
            .into_iter()
            .chain((0..24).map(|i| {
                let (sin, cos) = (f64::from(i) * std::f64::consts::TAU / 24.0).sin_cos();
                DVec3::new(cos, sin, 7.0)
            }))
            .collect();
        let solids = [cube, turned, cone, ball(300), scattered(200)].map(|p| hull(&p));
        for a in &solids {
            for b in &solids {
                let sum = a.sum(b).unwrap_or_else(|| panic!("a sum"));
                for direction in scattered(500) {
                    let direction = direction.normalize_or(DVec3::X);
                    let both = a.reach(direction) + b.reach(direction);
                    let off = (sum.reach(direction) - both).abs();
                    assert!(off < 1e-12 * both.abs().max(1.0), "off by {off}");
                }
            }
        }
        let [small, large] = [0.5, 1.0].map(|by| solids[0].scaled(by));
        let twice = small.sum(&small).unwrap_or_else(|| panic!("a sum"));
        let longer = large.sum(&small).unwrap_or_else(|| panic!("a sum"));
        let reaches = [&twice, &longer].map(|sum| sum.reach(DVec3::ONE));
        assert_eq!(reaches, [3.0, 4.5], "a sum that leaves no corner out");
    }

    #[test]
    fn few_pairs_of_corners_are_left() {
        let points = scattered(600).into_iter();
        let a = hull(&points.map(|p| p.normalize_or(DVec3::X)).collect::<Vec<_>>());
        let corners = HullCorner::of(&a);
        let left = corners.iter().flat_map(|b| {
            let is_left = |a: &&HullCorner| !a.is_surpassed_where(b) && !b.is_surpassed_where(a);
            corners.iter().filter(is_left)
        });
        let most = 12 * corners.len();
        let left = left.take(most + 1).count();
        assert!(left <= most, "more than {most} of {}", corners.len().pow(2));
    }
}
