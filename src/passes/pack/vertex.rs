//! Vertices and triangles in the layout that shaders read, and the range of each part in the shared buffers.

use std::ops::Range;
use std::sync::Arc;

use glam::Vec3;

use crate::plan::Piece;

/// A vertex in the layout that shaders read.
#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
pub(crate) struct Vertex {
    pub(crate) position: [f32; 3],
    pub(crate) normal: u32,
}

/// Range of a part in the shared buffers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MeshRange {
    /// Range of indices.
    pub indices: Range<u32>,
    /// Added to each index.
    pub base_vertex: i32,
    /// Number of vertices from the base vertex on.
    pub vertex_count: u32,
}

/// The triangles' vertex indices, each triangle rotated to begin with its least corner by coordinates: rasterisers interpolate depth from
/// the first corner, and coincident triangles must get the same depth, whatever corner their lists begin with.
pub(crate) fn packed_triangles(
    triangles: impl Iterator<Item = [u32; 3]>,
    position: impl Fn(u32) -> Vec3,
) -> Arc<[u8]> {
    let from_first = |corners: [u32; 3]| {
        let at = corners.map(|c| position(c).to_array());
        let first = (0..3).reduce(|i, j| if at[j] < at[i] { j } else { i });
        let mut corners = corners;
        corners.rotate_left(first.unwrap_or(0));
        corners
    };
    let corners: Vec<[u32; 3]> = triangles.map(from_first).collect();
    Piece::from_values(0, corners.as_flattened()).bytes
}
