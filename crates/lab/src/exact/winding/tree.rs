//! Winding numbers around a point, from a tree of balls.
//!
//! A face contributes its signed solid angle over 4 pi (van Oosterom & Strackee 1983). Faces that are far away for their size are
//! approximated together by one dipole: the sum of their area vectors at their common centroid (Barill, Dickson, Schmidt, Levin, Jacobson
//! 2018, first order). The error of a ball beyond `FAR` radii falls with the cube of the distance.

use std::ops::Range;

use glam::{DVec3, Vec3};

/// Minimum distance of a far point from the middle of a ball, in radii of the ball.
const FAR: f64 = 3.0;

const LEAF_FACES: usize = 8;

/// A ball around some faces.
struct BallNode {
    /// Centroid of the area of the faces.
    middle: DVec3,
    radius: f64,
    /// Sum of the area vectors.
    area: DVec3,
    /// The first of its faces, in the order of the tree.
    first: u32,
    end: u32,
    /// Index of the next node that is not below this one.
    next: u32,
}

/// Pending step in the construction of a tree.
enum BuildStep {
    /// Make a node for these faces, and all nodes below it.
    Make(Range<usize>),
    /// Close a node: all nodes below it are made.
    Close(usize),
}

/// A mesh in a tree, its nodes in depth-first order.
pub(super) struct WindingTree {
    faces: Vec<[Vec3; 3]>,
    nodes: Vec<BallNode>,
}

impl WindingTree {
    /// Builds the tree of a mesh.
    pub(super) fn of(positions: &[Vec3], triangles: &[[u32; 3]]) -> Self {
        let corners = |t: &[u32; 3]| t.map(|i| positions[i as usize]);
        let mut tree = Self {
            faces: triangles.iter().map(corners).collect(),
            nodes: Vec::with_capacity(2 * triangles.len() / LEAF_FACES + 1),
        };
        // The next step is on top.
        let mut todo = vec![BuildStep::Make(0..tree.faces.len())];
        while let Some(step) = todo.pop() {
            match step {
                BuildStep::Close(node) => tree.nodes[node].next = tree.nodes.len() as u32,
                BuildStep::Make(range) if range.is_empty() => {}
                BuildStep::Make(range) => {
                    let faces = &mut tree.faces[range.clone()];
                    let mut node = BallNode::around(faces);
                    (node.first, node.end) = (range.start as u32, range.end as u32);
                    let number = tree.nodes.len();
                    tree.nodes.push(node);
                    todo.push(BuildStep::Close(number));
                    if range.len() > LEAF_FACES {
                        let half = split(faces);
                        todo.push(BuildStep::Make(range.start + half..range.end));
                        todo.push(BuildStep::Make(range.start..range.start + half));
                    }
                }
            }
        }
        tree
    }

    /// The winding number around a point.
    pub(super) fn winding(&self, point: DVec3) -> f64 {
        let mut sum = 0.0;
        let mut at = 0;
        while let Some(node) = self.nodes.get(at) {
            let away = node.middle - point;
            let distance = away.length();
            if distance > FAR * node.radius {
                sum += node.area.dot(away) / (distance * distance * distance);
                at = node.next as usize;
            } else if node.next as usize == at + 1 {
                let faces = &self.faces[node.first as usize..node.end as usize];
                sum += faces.iter().map(|f| solid_angle(f, point)).sum::<f64>();
                at += 1;
            } else {
                at += 1;
            }
        }
        sum / (4.0 * std::f64::consts::PI)
    }

    /// Bytes of the tree.
    pub(super) fn bytes(&self) -> u64 {
        (size_of_val(&*self.faces) + size_of_val(&*self.nodes)) as u64
    }
}

impl BallNode {
    /// The ball around some faces, of which there must be at least one.
    fn around(faces: &[[Vec3; 3]]) -> Self {
        let mut area = DVec3::ZERO;
        let (mut weighted, mut weights) = (DVec3::ZERO, 0.0);
        let (mut plain, mut count) = (DVec3::ZERO, 0.0);
        for face in faces {
            let [a, b, c] = face.map(|p| p.as_dvec3());
            let of_face = (b - a).cross(c - a) * 0.5;
            let middle = (a + b + c) / 3.0;
            area += of_face;
            weighted += middle * of_face.length();
            weights += of_face.length();
            plain += middle;
            count += 1.0;
        }
        let middle = if weights > 0.0 {
            weighted / weights
        } else {
            plain / count
        };
        let corners = faces.iter().flatten().map(|p| p.as_dvec3());
        let radius = corners.map(|p| p.distance(middle)).fold(0.0, f64::max);
        Self {
            middle,
            radius,
            area,
            first: 0,
            end: 0,
            next: 0,
        }
    }
}

/// Divides faces into two halves along the longest side of the box around their centroids.
fn split(faces: &mut [[Vec3; 3]]) -> usize {
    let middle = |f: &[Vec3; 3]| f[0] + f[1] + f[2];
    let (mut lo, mut hi) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    for face in faces.iter() {
        (lo, hi) = (lo.min(middle(face)), hi.max(middle(face)));
    }
    let axis = (hi - lo).max_position();
    let half = faces.len() / 2;
    faces.select_nth_unstable_by(half, |a, b| middle(a)[axis].total_cmp(&middle(b)[axis]));
    half
}

/// The solid angle of a face seen from a point, positive from inside: twice the angle whose tangent is the quotient.
fn solid_angle(face: &[Vec3; 3], point: DVec3) -> f64 {
    let [a, b, c] = face.map(|p| p.as_dvec3() - point);
    let (la, lb, lc) = (a.length(), b.length(), c.length());
    let volume = a.dot(b.cross(c));
    let reach = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    2.0 * volume.atan2(reach)
}

#[cfg(test)]
mod tests {
    use super::*;
    use cutaway::generate::shapes::shape;

    /// Error of approximating groups of faces. From the middle of a ball all faces are seen from one side, and their errors add up
    /// to 0.0106; the decision threshold is 0.5.
    const FIRST_ORDER: f64 = 0.02;

    /// Winding numbers of a mesh: by the tree, and face by face.
    fn both(spec: &str, keep: impl Fn(usize) -> bool, point: DVec3) -> [f64; 2] {
        let mesh = shape(spec).unwrap().remove(0).mesh;
        let positions: Vec<Vec3> = mesh.positions.iter().map(|p| p.as_vec3()).collect();
        let numbered = mesh.triangles.iter().enumerate();
        let triangles: Vec<[u32; 3]> = numbered
            .filter(|(i, _)| keep(*i))
            .map(|(_, t)| *t)
            .collect();
        let tree = WindingTree::of(&positions, &triangles);
        assert_eq!(tree.faces.len(), triangles.len());
        let sum: f64 = tree.faces.iter().map(|f| solid_angle(f, point)).sum();
        [tree.winding(point), sum / (4.0 * std::f64::consts::PI)]
    }

    fn points() -> impl Iterator<Item = DVec3> {
        let axis = |i: i32| f64::from(i) * 0.131 - 0.6;
        (0..10).flat_map(move |i| (0..10).map(move |j| DVec3::new(axis(i), axis(j), 0.11)))
    }

    #[test]
    fn the_tree_says_what_all_faces_say() {
        for spec in [
            "sphere?subdivisions=4",
            "knot?segments=120&sides=16",
            "cube",
        ] {
            for every in [usize::MAX, 7] {
                for point in points() {
                    let [tree, brute] = both(spec, |i| (i + 1) % every != 0, point);
                    assert!(
                        (tree - brute).abs() < FIRST_ORDER,
                        "{spec} at {point}: {tree} is not {brute}"
                    );
                }
            }
        }
    }

    #[test]
    fn closed_meshes_have_whole_numbers_and_open_ones_shares() {
        for (point, expected) in [(DVec3::ZERO, 1.0), (DVec3::X * 0.3, 1.0), (DVec3::X, 0.0)] {
            let [tree, brute] = both("sphere?subdivisions=4", |_| true, point);
            assert!((tree - expected).abs() < FIRST_ORDER, "{tree} at {point}");
            assert!((brute - expected).abs() < 1e-12, "{brute} at {point}");
        }
        // Each of a cube's six faces covers a sixth of the view from its middle.
        let [tree, _] = both("cube", |i| i >= 2, DVec3::ZERO);
        assert!(
            (tree - 5.0 / 6.0).abs() < FIRST_ORDER,
            "{tree} in a box without lid"
        );
    }
}
