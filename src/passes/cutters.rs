//! Cutters packed for upload: one vertex for each triangle, which has its normal, and as few others as there need be.
//!
//! A cap on a cutter has the normal of a triangle, and core WebGPU tells a fragment neither which triangle it is of nor anything
//! flat but what the triangle's first vertex says. So each triangle begins with a vertex that no other begins with: one of its own
//! corners where one is free, else a copy. A closed mesh of V vertices and 2 V triangles thus has 2 V of them.
//!
//! Each cutter is a piece of the buffers: one that moves has its own vertices uploaded again and nothing else.

use std::sync::Arc;

use super::MeshRange;
use super::model::Vertex;
use crate::plan::pack::pack_normal;
use crate::plan::{Contents, INDEX_BYTES, Piece, VERTEX_BYTES};
use crate::scene::{Mesh, PreparedSurface, PreparedVolume};
use glam::Vec3;

/// The cutters of a scene, packed.
#[derive(Clone, Debug)]
pub struct Cutters {
    /// Vertices of all cutters.
    pub vertices: Contents,
    /// Indices of all cutters.
    pub indices: Contents,
    /// Where each is, by number of the clip-surface.
    ranges: Vec<Option<MeshRange>>,
    packed: Vec<Packed>,
}

/// One cutter, packed.
#[derive(Clone, Debug)]
struct Packed {
    surface: usize,
    volume: Arc<PreparedVolume>,
    order: Arc<Order>,
    vertices: Arc<[u8]>,
}

impl Cutters {
    /// Packs the cutters among some clip-surfaces, with what is still right of how they were packed before.
    pub(super) fn of(surfaces: &[PreparedSurface], before: Option<&Self>) -> Self {
        let old = before.map_or(&[] as &[Packed], |b| &b.packed);
        let cutters = surfaces.iter().enumerate();
        let packed: Vec<Packed> = cutters
            .filter_map(|(surface, s)| Some((surface, s.volume.as_ref()?)))
            .map(|(surface, volume)| {
                let known = old.iter().find(|p| p.surface == surface);
                Packed::of(surface, volume, known)
            })
            .collect();
        let mut ranges = vec![None; surfaces.len()];
        let (mut vertices, mut indices) = (Vec::new(), Vec::new());
        let (mut first_vertex, mut first_index) = (0, 0);
        for one in &packed {
            let count = one.order.corners.len() as u32;
            let end_index = first_index + (one.order.indices.len() as u64 / INDEX_BYTES) as u32;
            ranges[one.surface] = Some(MeshRange {
                indices: first_index..end_index,
                base_vertex: u32::cast_signed(first_vertex),
                vertex_count: count,
            });
            vertices.push(Piece {
                offset: u64::from(first_vertex) * VERTEX_BYTES,
                bytes: one.vertices.clone(),
            });
            indices.push(Piece {
                offset: u64::from(first_index) * INDEX_BYTES,
                bytes: one.order.indices.clone(),
            });
            (first_vertex, first_index) = (first_vertex + count, end_index);
        }
        let contents = |len: u64, pieces: Vec<Piece>, before: Option<&Contents>| {
            let now =
                Contents::in_pieces(len, pieces.clone(), before.is_some_and(Contents::changes));
            match before {
                // That it changes is known only now.
                Some(before) if *before != now => Contents::in_pieces(len, pieces, true),
                Some(before) => before.clone(),
                None => now,
            }
        };
        Self {
            vertices: contents(
                u64::from(first_vertex) * VERTEX_BYTES,
                vertices,
                before.map(|b| &b.vertices),
            ),
            indices: contents(
                u64::from(first_index) * INDEX_BYTES,
                indices,
                before.map(|b| &b.indices),
            ),
            ranges,
            packed,
        }
    }

    /// Where the triangles of a clip-surface are, if it is a cutter.
    pub fn range(&self, surface: usize) -> Option<&MeshRange> {
        self.ranges.get(surface)?.as_ref()
    }
}

impl Packed {
    fn of(surface: usize, volume: &Arc<PreparedVolume>, before: Option<&Self>) -> Self {
        let known = before.filter(|b| Arc::ptr_eq(&b.volume.mesh, &volume.mesh));
        let order = known.map_or_else(|| Arc::new(Order::of(&volume.mesh)), |k| k.order.clone());
        let still = known.filter(|k| Arc::ptr_eq(&k.volume.positions, &volume.positions));
        let vertices = still.map_or_else(
            || order.vertices(&volume.positions, volume.triangles()),
            |k| k.vertices.clone(),
        );
        Self {
            surface,
            volume: volume.clone(),
            order,
            vertices,
        }
    }
}

/// Which vertices there are, and which of them make the triangles: what hangs on the mesh alone.
#[derive(Debug)]
struct Order {
    /// For each vertex its position and the triangle that begins with it, if one does.
    corners: Vec<(u32, Option<u32>)>,
    indices: Arc<[u8]>,
}

impl Order {
    fn of(mesh: &Mesh) -> Self {
        let mut corners: Vec<(u32, Option<u32>)> = (0..mesh.positions.len() as u32)
            .map(|p| (p, None))
            .collect();
        let mut indices: Vec<[u32; 3]> = Vec::with_capacity(mesh.triangles.len());
        for (number, triangle) in mesh.triangles.iter().enumerate() {
            let number = number as u32;
            let free = (0..3).find(|i| corners[triangle[*i] as usize].1.is_none());
            let mut turned = *triangle;
            turned.rotate_left(free.unwrap_or(0));
            match free {
                Some(_) => corners[turned[0] as usize].1 = Some(number),
                None => {
                    corners.push((turned[0], Some(number)));
                    turned[0] = corners.len() as u32 - 1;
                }
            }
            indices.push(turned);
        }
        Self {
            corners,
            indices: Piece::from_values(0, indices.as_flattened()).bytes,
        }
    }

    fn vertices(&self, positions: &[Vec3], triangles: &[[u32; 3]]) -> Arc<[u8]> {
        let normal = |triangle: u32| {
            let corners = triangles[triangle as usize].map(|i| positions[i as usize].as_dvec3());
            let [a, b, c] = corners;
            (b - a).cross(c - a).normalize_or(glam::DVec3::Z).as_vec3()
        };
        let vertices: Vec<Vertex> = (self.corners.iter())
            .map(|(position, begins)| Vertex {
                position: positions[*position as usize].to_array(),
                normal: begins.map_or(0, |triangle| pack_normal(normal(triangle))),
            })
            .collect();
        Piece::from_values(0, &vertices).bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::shapes::shape;

    #[test]
    fn every_triangle_begins_with_a_vertex_of_its_own() {
        for spec in [
            "cube",
            "torus?segments=12&sides=8",
            "sponge?level=1",
            "knot",
        ] {
            let mesh = shape(spec).unwrap().remove(0).mesh;
            let order = Order::of(&mesh);
            let indices: &[u32] = bytemuck::cast_slice(&order.indices);
            for (number, triangle) in indices.chunks(3).enumerate() {
                let begins = order.corners[triangle[0] as usize].1;
                assert_eq!(begins, Some(number as u32), "{spec}");
                let mut at: Vec<u32> = triangle
                    .iter()
                    .map(|v| order.corners[*v as usize].0)
                    .collect();
                let own = mesh.triangles[number];
                let turn = at.iter().position(|p| *p == own[0]).unwrap();
                at.rotate_left(turn);
                assert_eq!(at, own, "{spec}: a triangle turns as it did");
            }
            let most = mesh.triangles.len().max(mesh.positions.len()) * 9 / 8;
            assert!(
                order.corners.len() <= most,
                "{spec}: {} vertices",
                order.corners.len()
            );
        }
    }
}
