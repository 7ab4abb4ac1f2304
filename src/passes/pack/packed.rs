//! A part packed for upload, and the space reserved for it in the buffers that all parts share.
//!
//! A static part is uploaded in its final position. A moving part (it has a pose, or was elsewhere a frame ago) is uploaded
//! once, in the rest pose, and placed by the pose pass, which also fills its vertex range. If a part's mesh changes, only
//! that part is packed again: reserved ranges stay where they are as long as everything fits, and those of parts whose
//! mesh has changed before have a quarter to spare.

use std::sync::{Arc, OnceLock};

use glam::DAffine3;

use super::classifiers::{Classifiers, Sorted};
use super::packed_closing::PackedClosing;
use super::packed_vertex_paint::PackedVertexPaint;
use super::rest_part::RestPart;
use super::sliced::Sliced;
use super::vertex::{Vertex, packed_triangles};
use crate::plan::pack::pack_normal;
use crate::plan::{Contents, INDEX_BYTES, Piece, VERTEX_BYTES};
use crate::scene::memo::is_same;
use crate::scene::{
    Bounds, Mesh, Motion, Part, PreparedPart, SceneSpace, doubled_faces, tolerance_of,
};

/// A part packed for upload.
#[derive(Clone, Debug)]
pub(crate) struct Packed {
    mesh: Arc<Mesh>,
    motion: Option<Arc<Motion>>,
    world_from_part: DAffine3,
    space: SceneSpace,
    /// The part without its cuts and its material.
    pub(crate) part: PreparedPart,
    /// Vertices of a static part.
    vertices: Option<Arc<[u8]>>,
    pub(crate) indices: Arc<[u8]>,
    pub(crate) vertex_count: u32,
    /// Rest data of a moving part.
    pub(crate) rest: Option<Arc<RestPart>>,
    /// Its vertex paint, if its mesh has one.
    pub(crate) vertex_paint: Option<Arc<PackedVertexPaint>>,
    /// Triangles that coincide with another triangle.
    doubled: Arc<Vec<u32>>,
    /// Reusable slicing data.
    pub(crate) sliced: Arc<Sliced>,
    /// Its closing triangles, found on first use; `None` in it if the mesh is closed.
    closing: Arc<OnceLock<Option<Arc<PackedClosing>>>>,
    /// True if the part's mesh has changed before.
    is_other: bool,
}

impl Packed {
    /// Packs a part, reusing whatever is still valid from the previous packing.
    pub(crate) fn of(index: usize, part: &Part, space: &SceneSpace, before: Option<&Self>) -> Self {
        let known = before.filter(|b| b.is_of(part));
        let moves = |known: &Self| {
            known.rest.is_some()
                || known.world_from_part != part.world_from_part
                || known.space != *space
        };
        let packed = if !part.pose.is_rest() || known.is_some_and(moves) {
            Self::moving(index, part, space, known)
        } else if let Some(known) = known {
            known.clone()
        } else {
            Self::still(index, part, space)
        };
        Self {
            is_other: before.is_some_and(|b| b.is_other || !Arc::ptr_eq(&b.mesh, &part.mesh)),
            ..packed
        }
    }

    /// Returns true if the mesh and the motion are the same objects; equal copies do not count.
    fn is_of(&self, part: &Part) -> bool {
        is_same(self.motion.as_ref(), part.motion.as_ref()) && Arc::ptr_eq(&self.mesh, &part.mesh)
    }

    fn still(index: usize, part: &Part, space: &SceneSpace) -> Self {
        let placed = PreparedPart::place(index, part, space, Vec::new());
        let shading = &placed.shading;
        let at = shading.positions_of_vertex.iter();
        let vertices: Vec<Vertex> = (at.zip(&shading.normals))
            .map(|(p, n)| Vertex {
                position: placed.positions[*p as usize].to_array(),
                normal: pack_normal(*n),
            })
            .collect();
        Self {
            vertices: Some(Piece::from_values(0, &vertices).bytes),
            vertex_count: vertices.len() as u32,
            indices: packed_triangles(shading.triangles.iter().copied(), |v| {
                placed.positions[shading.positions_of_vertex[v as usize] as usize]
            }),
            rest: None,
            vertex_paint: part.mesh.vertex_paint.as_ref().map(|vertex_paint| {
                let mirrored = part.world_from_part.matrix3.determinant() < 0.0;
                Arc::new(PackedVertexPaint::of(
                    vertex_paint,
                    &shading.triangles,
                    mirrored,
                ))
            }),
            doubled: Arc::new(doubled_faces(&part.mesh)),
            ..Self::unpacked(part, space, placed)
        }
    }

    fn moving(index: usize, part: &Part, space: &SceneSpace, known: Option<&Self>) -> Self {
        let mirrored = part.world_from_part.matrix3.determinant() < 0.0;
        let rest = match known.and_then(|k| k.rest.clone()) {
            Some(rest) if rest.mirrored == mirrored => rest,
            _ => Arc::new(RestPart::of(part, mirrored)),
        };
        let of_part = if part.pose.is_rest() {
            rest.bounds
        } else {
            part.posed_bounds()
        };
        let corners = of_part.corners().map(|c| {
            let in_world = part.world_from_part.transform_point3(c);
            space.point(in_world)
        });
        let outline = PreparedPart::outline(
            index,
            part,
            Bounds::from_points(corners),
            rest.volume,
            Vec::new(),
        );
        let placed = PreparedPart {
            triangles: rest.triangles.clone(),
            plane_tolerance: tolerance_of(part, &rest.bounds, space),
            ..outline
        };
        Self {
            vertices: None,
            vertex_count: rest.vertex_count,
            indices: rest.indices.clone(),
            vertex_paint: rest.vertex_paint.clone(),
            rest: Some(rest),
            doubled: match known {
                Some(known) => known.doubled.clone(),
                None => Arc::new(doubled_faces(&part.mesh)),
            },
            sliced: match known {
                Some(k) if k.sliced.stands_as(part, space) => k.sliced.clone(),
                _ => Arc::new(Sliced::posed(part, space)),
            },
            closing: match known {
                // A placement that starts or ends to mirror turns the triangles.
                Some(known) if known.rest.as_ref().is_some_and(|k| k.mirrored == mirrored) => {
                    known.closing.clone()
                }
                _ => Arc::default(),
            },
            ..Self::unpacked(part, space, placed)
        }
    }

    fn unpacked(part: &Part, space: &SceneSpace, placed: PreparedPart) -> Self {
        Self {
            mesh: part.mesh.clone(),
            motion: part.motion.clone(),
            world_from_part: part.world_from_part,
            space: *space,
            part: placed,
            vertices: None,
            indices: Arc::new([]),
            vertex_count: 0,
            rest: None,
            vertex_paint: None,
            doubled: Arc::default(),
            sliced: Arc::default(),
            closing: Arc::default(),
            is_other: false,
        }
    }

    /// The triangles that close the part; `None` if it is closed.
    pub(crate) fn closing(&self) -> Option<Arc<PackedClosing>> {
        let find = || match &self.rest {
            Some(rest) => rest.closing(),
            None => {
                let (part, shading) = (&self.part, &self.part.shading);
                let vertices = &shading.positions_of_vertex;
                PackedClosing::of(&part.triangles, vertices, |p| part.positions[p as usize])
            }
        };
        self.closing.get_or_init(|| find().map(Arc::new)).clone()
    }

    /// The indices, preclassified triangles last; `None` if no triangle is preclassified.
    pub(crate) fn sorted(&self, part: &PreparedPart, by: &Classifiers) -> Option<Arc<Sorted>> {
        match (by.is_empty(), self.doubled.as_slice()) {
            (true, []) => None,
            _ => self.sliced.sorted(part, by, (&self.indices, &self.doubled)),
        }
    }

    pub(crate) fn index_count(&self) -> u32 {
        (self.indices.len() as u64 / INDEX_BYTES) as u32
    }
}

/// The ranges of a part in the shared buffers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Room {
    pub(crate) first_vertex: u32,
    vertices: u32,
    pub(crate) first_index: u32,
    indices: u32,
}

impl Room {
    /// The end of the index range.
    pub(crate) fn end_index(&self) -> u32 {
        self.first_index + self.indices
    }
}

/// Ranges for all parts: the previous ones if everything still fits.
pub(crate) fn rooms(packed: &[Packed], before: &[Room]) -> Vec<Room> {
    let fits = |(p, room): (&Packed, &Room)| {
        p.vertex_count <= room.vertices && p.index_count() <= room.indices
    };
    if packed.len() == before.len() && packed.iter().zip(before).all(fits) {
        return before.to_vec();
    }
    let (mut first_vertex, mut first_index) = (0, 0);
    let rooms = packed.iter().map(|p| {
        let spare = |count: u32| {
            if p.is_other { count + count / 4 } else { count }
        };
        let room = Room {
            first_vertex,
            vertices: spare(p.vertex_count),
            first_index,
            indices: spare(p.index_count()),
        };
        first_vertex += room.vertices;
        first_index += room.indices;
        room
    });
    rooms.collect()
}

/// The vertices and the indices of all parts; `changes` is true if they will change later.
pub(crate) fn contents(packed: &[Packed], rooms: &[Room], changes: bool) -> [Contents; 2] {
    let end = rooms
        .last()
        .map_or([0, 0], |r| [r.first_vertex + r.vertices, r.end_index()]);
    let piece = |offset: u64, bytes: &Arc<[u8]>| Piece {
        offset,
        bytes: bytes.clone(),
    };
    let vertices = (packed.iter().zip(rooms)).filter_map(|(p, room)| {
        let offset = u64::from(room.first_vertex) * VERTEX_BYTES;
        p.vertices.as_ref().map(|bytes| piece(offset, bytes))
    });
    let indices = (packed.iter().zip(rooms))
        .map(|(p, room)| piece(u64::from(room.first_index) * INDEX_BYTES, &p.indices));
    [
        Contents::in_pieces(
            u64::from(end[0]) * VERTEX_BYTES,
            vertices.collect(),
            changes,
        ),
        Contents::in_pieces(u64::from(end[1]) * INDEX_BYTES, indices.collect(), changes),
    ]
}
