//! Cutters packed for upload: one vertex per triangle, which identifies it, and as few further vertices as possible.
//!
//! A cap on a cutter may take depth and normal from a triangle's plane, but core WebGPU gives a fragment neither its triangle's
//! number nor any flat value except those of the triangle's first vertex. So each triangle begins with a vertex that no other triangle
//! begins with: one of its own corners if one is free, else a copy. A closed mesh of V vertices and 2 V triangles thus has 2 V of them.
//! The triangle's data is stored in a second buffer at that vertex's number: 64 bytes per vertex in all.
//!
//! Each cutter is a separate piece of the buffers: if one moves, only its vertices are uploaded again.

use std::sync::Arc;

use bytemuck::Zeroable;
use glam::Vec3;

use super::vertex::{MeshRange, Vertex};
use crate::plan::pack::{CutterFace, pack_normal};
use crate::plan::{Contents, INDEX_BYTES, Piece, VERTEX_BYTES};
use crate::scene::{PreparedSurface, PreparedVolume};

const FACE_BYTES: u64 = size_of::<CutterFace>() as u64;

/// The cutters of a scene, packed.
#[derive(Clone, Debug)]
pub struct Cutters {
    /// Vertices of all cutters.
    pub vertices: Contents,
    /// For each vertex, the triangle that begins with it, as a [`CutterFace`].
    pub faces: Contents,
    /// Indices of all cutters.
    pub indices: Contents,
    /// Range of each cutter, indexed by clip-surface number.
    ranges: Vec<Option<MeshRange>>,
    packed: Vec<PackedCutter>,
}

/// One cutter, packed.
#[derive(Clone, Debug)]
struct PackedCutter {
    surface: usize,
    volume: Arc<PreparedVolume>,
    order: Arc<Order>,
    vertices: Arc<[u8]>,
    faces: Arc<[u8]>,
}

impl Cutters {
    /// Packs the cutters among the given clip-surfaces, reusing whatever is still valid from the previous packing.
    pub(crate) fn of(surfaces: &[PreparedSurface], before: Option<&Self>) -> Self {
        let old = before.map_or(&[] as &[PackedCutter], |b| &b.packed);
        let cutters = surfaces.iter().enumerate();
        let packed: Vec<PackedCutter> = cutters
            .filter_map(|(surface, s)| Some((surface, s.volume.as_ref()?)))
            .map(|(surface, volume)| {
                let known = old.iter().find(|p| p.surface == surface);
                PackedCutter::of(surface, volume, known)
            })
            .collect();
        let mut ranges = vec![None; surfaces.len()];
        let (mut vertices, mut faces, mut indices) = (Vec::new(), Vec::new(), Vec::new());
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
            faces.push(Piece {
                offset: u64::from(first_vertex) * FACE_BYTES,
                bytes: one.faces.clone(),
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
                // Only at this point is it known that the contents change.
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
            faces: contents(
                u64::from(first_vertex) * FACE_BYTES,
                faces,
                before.map(|b| &b.faces),
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

    /// Range of a clip-surface's triangles, if it is a cutter.
    pub fn range(&self, surface: usize) -> Option<&MeshRange> {
        self.ranges.get(surface)?.as_ref()
    }
}

impl PackedCutter {
    fn of(surface: usize, volume: &Arc<PreparedVolume>, before: Option<&Self>) -> Self {
        let splits = |v: &PreparedVolume| v.shading.as_ref().map(Arc::as_ptr);
        let known = before.filter(|b| {
            Arc::ptr_eq(&b.volume.mesh, &volume.mesh) && splits(&b.volume) == splits(volume)
        });
        let order = known.map_or_else(|| Arc::new(Order::of(volume)), |k| k.order.clone());
        let still = known.filter(|k| Arc::ptr_eq(&k.volume.positions, &volume.positions));
        let (vertices, faces) = still.map_or_else(
            || (order.vertices(volume), order.faces(volume)),
            |k| (k.vertices.clone(), k.faces.clone()),
        );
        Self {
            surface,
            volume: volume.clone(),
            order,
            vertices,
            faces,
        }
    }
}

/// A vertex, and the triangle that begins with it, if any.
#[derive(Clone, Copy, Debug)]
struct CutterVertex {
    position: u32,
    normal: Vec3,
    begins: Option<u32>,
}

/// Vertices and the triangles that index them; both depend only on the mesh and its creases.
#[derive(Debug)]
struct Order {
    corners: Vec<CutterVertex>,
    indices: Arc<[u8]>,
}

impl Order {
    fn of(volume: &PreparedVolume) -> Self {
        let corner = |position, normal| CutterVertex {
            position,
            normal,
            begins: None,
        };
        let (mut corners, triangles): (Vec<CutterVertex>, &[[u32; 3]]) = match &volume.shading {
            None => {
                let all = 0..volume.positions.len() as u32;
                (
                    all.map(|p| corner(p, Vec3::Z)).collect(),
                    volume.triangles(),
                )
            }
            Some(shading) => {
                let all = shading.positions_of_vertex.iter().zip(&shading.normals);
                let corners = all.map(|(p, n)| corner(*p, *n)).collect();
                (corners, &shading.triangles)
            }
        };
        let mut indices: Vec<[u32; 3]> = Vec::with_capacity(triangles.len());
        for (number, triangle) in triangles.iter().enumerate() {
            let free = (0..3).find(|i| corners[triangle[*i] as usize].begins.is_none());
            let mut turned = *triangle;
            turned.rotate_left(free.unwrap_or(0));
            if free.is_none() {
                corners.push(corners[turned[0] as usize]);
                turned[0] = corners.len() as u32 - 1;
            }
            corners[turned[0] as usize].begins = Some(number as u32);
            indices.push(turned);
        }
        Self {
            corners,
            indices: Piece::from_values(0, indices.as_flattened()).bytes,
        }
    }

    fn vertices(&self, volume: &PreparedVolume) -> Arc<[u8]> {
        let corners = self.corners.iter();
        let vertices: Vec<Vertex> = corners
            .map(|corner| Vertex {
                position: volume.positions[corner.position as usize].to_array(),
                normal: pack_normal(corner.normal),
            })
            .collect();
        Piece::from_values(0, &vertices).bytes
    }

    fn faces(&self, volume: &PreparedVolume) -> Arc<[u8]> {
        let is_smooth = f32::from(u8::from(volume.shading.is_some()));
        let of = |corner: &CutterVertex| {
            let Some(number) = corner.begins else {
                return CutterFace::zeroed();
            };
            let mut corners = volume.triangles()[number as usize];
            let first = corners.iter().position(|p| *p == corner.position);
            corners.rotate_left(first.unwrap_or(0));
            let [a, b, c] = corners.map(|p| volume.positions[p as usize]);
            let [ab, ac] = [b, c].map(|end| end.as_dvec3() - a.as_dvec3());
            let normal = ab.cross(ac).normalize_or(glam::DVec3::Z).as_vec3();
            CutterFace {
                second: b.extend(0.0).to_array(),
                third: c.extend(0.0).to_array(),
                normal: normal.extend(is_smooth).to_array(),
            }
        };
        let faces: Vec<CutterFace> = self.corners.iter().map(of).collect();
        Piece::from_values(0, &faces).bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::shapes::shape;
    use crate::scene::{Cut, Cutter, Prepared, Scene};

    #[test]
    fn every_triangle_begins_with_a_vertex_of_its_own() {
        for spec in [
            "cube",
            "torus?segments=12&sides=8",
            "sponge?level=1",
            "knot",
        ] {
            let part = shape(spec).unwrap().remove(0);
            let mesh = part.mesh.clone();
            for is_smooth in [false, true] {
                let mut cutter = Cutter::new(spec, mesh.clone()).unwrap();
                cutter.is_smooth = is_smooth;
                let scene = Scene {
                    parts: vec![part.clone()],
                    cuts: vec![Cut::by(cutter)],
                    ..Scene::default()
                };
                let prepared = Prepared::new(&scene);
                let volume = prepared.surfaces[0].volume.as_ref().unwrap();
                let order = Order::of(volume);
                let indices: &[u32] = bytemuck::cast_slice(&order.indices);
                for (number, triangle) in indices.chunks(3).enumerate() {
                    let begins = order.corners[triangle[0] as usize].begins;
                    assert_eq!(begins, Some(number as u32), "{spec}");
                    let corners = triangle.iter().map(|v| order.corners[*v as usize].position);
                    let mut at: Vec<u32> = corners.collect();
                    let own = mesh.triangles[number];
                    let turn = at.iter().position(|p| *p == own[0]).unwrap();
                    at.rotate_left(turn);
                    assert_eq!(at, own, "{spec}: a triangle turns as it did");
                }
                let vertices = match &volume.shading {
                    Some(shading) => shading.normals.len(),
                    None => mesh.positions.len(),
                };
                let most = mesh.triangles.len().max(vertices) * 9 / 8;
                assert!(
                    order.corners.len() <= most,
                    "{spec}: {} vertices",
                    order.corners.len()
                );
            }
        }
    }
}
