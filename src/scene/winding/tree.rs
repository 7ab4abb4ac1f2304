//! Winding numbers of triangles around a point, from a tree of balls.
//!
//! A triangle contributes its signed solid angle over 4 pi (van Oosterom & Strackee 1983). Triangles that are far away for their size are
//! approximated together, by the dipole and the quadrupole of their area about a common centre (Barill, Dickson, Schmidt, Levin, Jacobson,
//! *Fast winding numbers for soups and clouds*, 2018). The next term of the expansion bounds what is left out: third derivatives of 1/r are
//! at most 6/r^4, so area at offsets of at most R from the centre of a ball leaves at most 3 I / (d - R)^4 out of its solid angle from a
//! distance of d, where I is the integral of the squared offset over the area. A ball is opened if that exceeds a tolerance.
//!
//! Cost: building sorts the triangles along an axis at each level; a query takes time proportional to the logarithm of their number.

use std::f64::consts::PI;
use std::ops::Range;

use glam::{DMat3, DVec3, Vec3};

/// Maximum number of triangles in a leaf; `MOST_LEAF_TRIANGLES` in `shaders/lib/inside_tests/closings.wgsl`.
const LEAF_TRIANGLES: usize = 7;

/// A ball around some triangles.
#[derive(Clone, Copy, Debug)]
pub struct BallNode {
    /// Centroid of the area.
    pub centre: DVec3,
    pub radius: f64,
    /// Sum of the area vectors.
    pub area: DVec3,
    /// First moment of the area vectors about the centre, the sum of offset times area vector, made symmetric and traceless: the rest has no
    /// effect at a distance, where 1/r is harmonic.
    pub moment: DMat3,
    /// Sum of the areas.
    pub size: f64,
    /// Bound of the error as a share of 4 pi, times the fourth power of the distance from the ball.
    pub error: f64,
    /// First of its triangles, in the order of the tree.
    pub first: u32,
    /// End of its triangles.
    pub end: u32,
    /// Index of the next node that is not below this one.
    pub next: u32,
}

/// Pending step in the construction of a tree.
enum BuildStep {
    /// Make a node for these triangles, and all nodes below it.
    Make(Range<usize>),
    /// Close a node: all nodes below it are made.
    Close(usize),
}

/// Triangles in a tree, its nodes in depth-first order.
#[derive(Clone, Debug, Default)]
pub struct WindingTree {
    /// The triangles, in the order of the leaves.
    pub triangles: Vec<[Vec3; 3]>,
    /// The nodes: a node that is followed by [`BallNode::next`] is a leaf.
    pub nodes: Vec<BallNode>,
}

impl WindingTree {
    /// Builds the tree of triangles given by vertex indices.
    pub fn of(positions: &[Vec3], triangles: &[[u32; 3]]) -> Self {
        let corners = |t: &[u32; 3]| t.map(|i| positions[i as usize]);
        let mut tree = Self {
            triangles: triangles.iter().map(corners).collect(),
            nodes: Vec::with_capacity(2 * triangles.len() / LEAF_TRIANGLES + 1),
        };
        // The next step is on top.
        let mut todo = vec![BuildStep::Make(0..tree.triangles.len())];
        while let Some(step) = todo.pop() {
            match step {
                BuildStep::Close(node) => tree.nodes[node].next = tree.nodes.len() as u32,
                BuildStep::Make(range) if range.is_empty() => {}
                BuildStep::Make(range) => {
                    let triangles = &mut tree.triangles[range.clone()];
                    let mut node = BallNode::around(triangles);
                    (node.first, node.end) = (range.start as u32, range.end as u32);
                    let number = tree.nodes.len();
                    tree.nodes.push(node);
                    todo.push(BuildStep::Close(number));
                    if range.len() > LEAF_TRIANGLES {
                        let half = split(triangles);
                        todo.push(BuildStep::Make(range.start + half..range.end));
                        todo.push(BuildStep::Make(range.start..range.start + half));
                    }
                }
            }
        }
        tree
    }

    /// The winding number around a point, and a bound of its error. A ball is approximated where the bound of its own error is at most
    /// `tolerance`.
    pub fn winding(&self, point: DVec3, tolerance: f64) -> (f64, f64) {
        let (mut sum, mut error) = (0.0, 0.0);
        let mut at = 0;
        while let Some(node) = self.nodes.get(at) {
            let away = node.centre - point;
            let gap = away.length() - node.radius;
            let of_node = node.error / gap.powi(4);
            if gap > 0.0 && of_node <= tolerance {
                sum += node.solid_angle(away);
                error += of_node;
                at = node.next as usize;
            } else {
                if node.next as usize == at + 1 {
                    let triangles = &self.triangles[node.first as usize..node.end as usize];
                    sum += triangles.iter().map(|t| solid_angle(t, point)).sum::<f64>();
                }
                at += 1;
            }
        }
        (sum / (4.0 * PI), error)
    }

    /// Bytes of the tree.
    pub fn bytes(&self) -> u64 {
        (size_of_val(&*self.triangles) + size_of_val(&*self.nodes)) as u64
    }
}

impl BallNode {
    /// The ball around some triangles, of which there must be at least one.
    fn around(triangles: &[[Vec3; 3]]) -> Self {
        let (mut area, mut sizes) = (DVec3::ZERO, 0.0);
        let (mut weighted, mut plain) = (DVec3::ZERO, DVec3::ZERO);
        for (of_one, centre) in triangles.iter().map(area_and_centre) {
            area += of_one;
            sizes += of_one.length();
            weighted += centre * of_one.length();
            plain += centre;
        }
        let centre = match sizes > 0.0 {
            true => weighted / sizes,
            false => plain / triangles.len() as f64,
        };
        let corners = triangles.iter().flatten().map(|p| p.as_dvec3());
        let radius = corners.map(|p| p.distance(centre)).fold(0.0, f64::max);
        let moments = triangles.iter().map(area_and_centre).map(|(of_one, at)| {
            let offset = at - centre;
            DMat3::from_cols(offset * of_one.x, offset * of_one.y, offset * of_one.z)
        });
        let moment: DMat3 = moments.sum();
        let symmetric = (moment + moment.transpose()) * 0.5;
        let trace = symmetric.x_axis.x + symmetric.y_axis.y + symmetric.z_axis.z;
        let inertia = triangles.iter().map(|t| {
            let corners = t.map(|p| p.as_dvec3() - centre);
            let squares: f64 = corners.iter().map(|c| c.length_squared()).sum();
            let sum: DVec3 = corners.iter().sum();
            area_and_centre(t).0.length() * (squares + sum.length_squared()) / 12.0
        });
        let inertia: f64 = inertia.sum();
        Self {
            centre,
            radius,
            area,
            moment: symmetric - DMat3::from_diagonal(DVec3::splat(trace / 3.0)),
            size: sizes,
            error: 3.0 * inertia / (4.0 * PI),
            first: 0,
            end: 0,
            next: 0,
        }
    }

    /// Solid angle of its triangles from a point far away; `away` leads from the point to the centre.
    fn solid_angle(&self, away: DVec3) -> f64 {
        let square = away.length_squared();
        let quadrupole = -3.0 * away.dot(self.moment * away) / square;
        (self.area.dot(away) + quadrupole) / (square * square.sqrt())
    }
}

/// Area vector and centroid of a triangle.
fn area_and_centre(triangle: &[Vec3; 3]) -> (DVec3, DVec3) {
    let [a, b, c] = triangle.map(|p| p.as_dvec3());
    ((b - a).cross(c - a) * 0.5, (a + b + c) / 3.0)
}

/// Divides triangles into two halves along the longest side of the box around their centroids.
fn split(triangles: &mut [[Vec3; 3]]) -> usize {
    let middle = |f: &[Vec3; 3]| f[0] + f[1] + f[2];
    let (mut lo, mut hi) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    for triangle in triangles.iter() {
        (lo, hi) = (lo.min(middle(triangle)), hi.max(middle(triangle)));
    }
    let axis = (hi - lo).max_position();
    let half = triangles.len() / 2;
    triangles.select_nth_unstable_by(half, |a, b| middle(a)[axis].total_cmp(&middle(b)[axis]));
    half
}

/// The solid angle of a triangle from a point, positive from inside: twice the angle whose tangent is the quotient.
fn solid_angle(triangle: &[Vec3; 3], point: DVec3) -> f64 {
    let [a, b, c] = triangle.map(|p| p.as_dvec3() - point);
    let (la, lb, lc) = (a.length(), b.length(), c.length());
    let volume = a.dot(b.cross(c));
    let reach = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    2.0 * volume.atan2(reach)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::shapes::shape;
    use crate::scene::winding::Closing;

    /// A mesh in f32, with the faces that `keep` selects.
    fn faces(spec: &str, keep: impl Fn(usize) -> bool) -> (Vec<Vec3>, Vec<[u32; 3]>) {
        let mesh = shape(spec).unwrap().remove(0).mesh;
        let positions = mesh.positions.iter().map(|p| p.as_vec3()).collect();
        let numbered = mesh.triangles.iter().enumerate();
        let kept = numbered.filter(|(i, _)| keep(*i)).map(|(_, t)| *t);
        (positions, kept.collect())
    }

    fn points() -> impl Iterator<Item = DVec3> {
        let axis = |i: i32| f64::from(i) * 0.131 - 0.6;
        (0..10).flat_map(move |i| (0..10).map(move |j| DVec3::new(axis(i), axis(j), 0.11)))
    }

    /// Winding number of all triangles, one by one.
    fn one_by_one(tree: &WindingTree, point: DVec3) -> f64 {
        let angles = tree.triangles.iter().map(|t| solid_angle(t, point));
        angles.sum::<f64>() / (4.0 * PI)
    }

    #[test]
    fn the_tree_is_within_its_bound_of_the_sum_of_all_triangles() {
        for spec in [
            "sphere?subdivisions=4",
            "knot?segments=120&sides=16",
            "cube",
        ] {
            for every in [usize::MAX, 7] {
                let (positions, triangles) = faces(spec, |i| (i + 1) % every != 0);
                let tree = WindingTree::of(&positions, &triangles);
                for (point, tolerance) in points().flat_map(|p| [(p, 1e-3), (p, 1e-5)]) {
                    let (number, error) = tree.winding(point, tolerance);
                    let off = (number - one_by_one(&tree, point)).abs();
                    assert!(
                        off <= error + 1e-12,
                        "{spec} at {point}: {off} exceeds {error}"
                    );
                }
            }
        }
    }

    #[test]
    fn closed_meshes_have_whole_numbers_and_open_ones_shares() {
        let whole = faces("sphere?subdivisions=4", |_| true);
        let tree = WindingTree::of(&whole.0, &whole.1);
        for (point, expected) in [(DVec3::ZERO, 1.0), (DVec3::X * 0.3, 1.0), (DVec3::X, 0.0)] {
            let (number, error) = tree.winding(point, 1e-4);
            assert!(
                (number - expected).abs() <= error + 1e-12,
                "{number} at {point}"
            );
        }
        // Each of a cube's six faces covers a sixth of the view from its middle.
        let lidless = faces("cube", |i| i >= 2);
        let (number, _) = WindingTree::of(&lidless.0, &lidless.1).winding(DVec3::ZERO, 1e-4);
        assert!(
            (number - 5.0 / 6.0).abs() < 1e-3,
            "{number} in a box without lid"
        );
    }

    /// Signed crossings of a ray: 1 where it leaves through the outside of a triangle.
    fn crossings(positions: &[Vec3], triangles: &[[u32; 3]], from: DVec3, along: DVec3) -> i32 {
        let mut count = 0;
        for triangle in triangles {
            let [a, b, c] = triangle.map(|i| positions[i as usize].as_dvec3() - from);
            let sides = [b.cross(c), c.cross(a), a.cross(b)].map(|n| n.dot(along));
            let facing = (b - a).cross(c - a).dot(along);
            let is_through = sides.iter().all(|s| s * facing > 0.0);
            let is_behind = a.dot((b - a).cross(c - a)) * facing > 0.0;
            count += i32::from(is_through && is_behind) * facing.signum() as i32;
        }
        count
    }

    /// The identity that inside tests rely on, against the sum over all faces.
    #[test]
    fn crossings_of_the_closed_mesh_less_the_closing_are_the_number_of_the_mesh() {
        let along = DVec3::new(0.31, -0.58, 0.75).normalize();
        for spec in [
            "sphere?subdivisions=3",
            "knot?segments=60&sides=12",
            "cube?divisions=3",
        ] {
            for (every, flips) in [(5, 0), (2, 0), (9, 4)] {
                let (positions, mut triangles) = faces(spec, |i| i % every != 0);
                for triangle in triangles.iter_mut().step_by(11).take(flips) {
                    triangle.swap(0, 1);
                }
                let closing = Closing::of(&triangles);
                assert!(!closing.is_empty(), "{spec}");
                let mesh = WindingTree::of(&positions, &triangles);
                let filled = WindingTree::of(&positions, &closing.triangles);
                for point in points() {
                    let behind = crossings(&positions, &triangles, point, along)
                        + crossings(&positions, &closing.triangles, point, along);
                    let (of_filled, _) = filled.winding(point, 0.0);
                    let number = f64::from(behind) - of_filled;
                    let expected = one_by_one(&mesh, point);
                    assert!(
                        (number - expected).abs() < 1e-9,
                        "{spec} at {point}: {number} is not {expected}"
                    );
                }
            }
        }
    }
}
