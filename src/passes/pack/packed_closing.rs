//! The triangles that close an open part for counting, and the tree of their solid angles, as uploads.
//!
//! Closing triangles use vertices of the part, so that fragments on a shared edge are the same for both, in every pose. They are found when
//! a frame first needs them, and again only if the mesh of the part changes; the tree is built once per pose.
//! Layout of a node: `shaders/lib/inside_tests/closings.wgsl`.
//!
//! Cannot: pose the vertices of the tree on the device. A moving open part is posed here once more, in f64.

use std::sync::Arc;

use glam::Vec3;

use super::vertex::packed_triangles;
use crate::plan::Piece;
use crate::scene::winding::{BallNode, Closing, WindingTree};

/// Words of a tree's node, and of its triangle, in vectors of four.
const NODE_VECTORS: u32 = 4;
const TRIANGLE_VECTORS: u32 = 3;

/// Bits for the number of triangles in a leaf.
const COUNT_BITS: u32 = 3;

/// The closing triangles of a part.
#[derive(Debug)]
pub(crate) struct PackedClosing {
    /// By position index, facing as the part's triangles do.
    pub(crate) closing: Closing,
    /// Vertex indices of the triangles.
    pub(crate) indices: Arc<[u8]>,
    /// True if the mesh lies in one plane, and so has no inside.
    pub(crate) is_flat: bool,
}

/// Greatest distance of a flat mesh's vertices from its plane, as a share of its size.
const FLAT: f32 = 1e-6;

/// Returns true if all triangles lie in the plane of the largest one.
fn is_flat(triangles: &[[u32; 3]], position: impl Fn(u32) -> Vec3) -> bool {
    let corners = |t: &[u32; 3]| t.map(&position);
    let area = |[a, b, c]: [Vec3; 3]| (b - a).cross(c - a);
    let by_size = |t: &[Vec3; 3], u: &[Vec3; 3]| {
        let [t, u] = [t, u].map(|t| area(*t).length_squared());
        t.total_cmp(&u)
    };
    let Some(largest) = triangles.iter().map(corners).max_by(by_size) else {
        return true;
    };
    let normal = area(largest).normalize_or_zero();
    let all = triangles.iter().flat_map(corners);
    let (mut off, mut size) = (0.0_f32, 0.0_f32);
    for offset in all.map(|p| p - largest[0]) {
        off = off.max(offset.dot(normal).abs());
        size = size.max(offset.length());
    }
    off <= FLAT * size
}

impl PackedClosing {
    /// Closes a part; `None` if it is closed. `triangles` are its triangles by position index, as they face when drawn.
    pub(crate) fn of(
        triangles: &[[u32; 3]],
        position_of_vertex: &[u32],
        position: impl Fn(u32) -> Vec3,
    ) -> Option<Self> {
        let closing = Closing::of(triangles);
        if closing.is_empty() {
            return None;
        }
        let positions = position_of_vertex
            .iter()
            .max()
            .map_or(0, |m| *m as usize + 1);
        let mut vertex_of_position = vec![0; positions];
        for (vertex, position) in position_of_vertex.iter().enumerate().rev() {
            vertex_of_position[*position as usize] = vertex as u32;
        }
        let vertices = |t: &[u32; 3]| t.map(|p| vertex_of_position[p as usize]);
        let indices = packed_triangles(closing.triangles.iter().map(vertices), |v| {
            position(position_of_vertex[v as usize])
        });
        let is_flat = is_flat(triangles, &position);
        Some(Self {
            is_flat,
            indices,
            closing,
        })
    }

    /// Number of indices.
    pub(crate) fn index_count(&self) -> u32 {
        self.closing.triangles.len() as u32 * 3
    }

    /// The tree in words, for positions of the part in scene space: nodes in depth-first order, then triangles. Addresses in it count
    /// vectors from its start.
    pub(crate) fn tree(&self, positions: &[Vec3]) -> Arc<[u8]> {
        // Those without area have no solid angle, and no point is on either side of them.
        let has_area = |t: &&[u32; 3]| {
            let [a, b, c] = t.map(|i| positions[i as usize]);
            (b - a).cross(c - a) != Vec3::ZERO
        };
        let triangles: Vec<[u32; 3]> = self
            .closing
            .triangles
            .iter()
            .filter(has_area)
            .copied()
            .collect();
        let tree = WindingTree::of(positions, &triangles);
        if tree.nodes.is_empty() {
            // A leaf without triangles.
            let leaf = [
                [0; 4],
                [0; 4],
                [0, 0, 0, NODE_VECTORS],
                [0, 0, 0, NODE_VECTORS << COUNT_BITS],
            ];
            return Piece::from_values(0, &leaf).bytes;
        }
        let first_triangle = tree.nodes.len() as u32 * NODE_VECTORS;
        let words = |(number, node): (usize, &BallNode)| {
            let next = node.next * NODE_VECTORS;
            let [x, y] = [node.moment.x_axis, node.moment.y_axis];
            let leaf = match node.next as usize == number + 1 {
                true => {
                    let first = first_triangle + node.first * TRIANGLE_VECTORS;
                    (first << COUNT_BITS) | (node.end - node.first)
                }
                false => 0,
            };
            let floats = |v: [f64; 3]| v.map(|v| (v as f32).to_bits());
            let [a, b] = [floats(node.centre.to_array()), floats(node.area.to_array())];
            let [c, d] = [
                floats([x.x, y.y, node.size]),
                floats([2.0 * x.y, 2.0 * x.z, 2.0 * y.z]),
            ];
            // Rounded up; the centre is rounded to f32 as the triangles are.
            let [radius, error] = [node.radius, node.error].map(|v| (v as f32).next_up().to_bits());
            [
                [a[0], a[1], a[2], radius],
                [b[0], b[1], b[2], error],
                [c[0], c[1], c[2], next],
                [d[0], d[1], d[2], leaf],
            ]
        };
        let corners = tree.triangles.iter().flatten();
        let nodes = tree.nodes.iter().enumerate().flat_map(words);
        let triangles = corners.map(|p| [p.x.to_bits(), p.y.to_bits(), p.z.to_bits(), 0]);
        let vectors: Vec<[u32; 4]> = nodes.chain(triangles).collect();
        Piece::from_values(0, &vectors).bytes
    }
}
