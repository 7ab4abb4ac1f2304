//! Vertex paints of parts, packed for upload: a row for each painted part, and 13 words for each of its triangles.
//!
//! A triangle's corners refer to vertices in the shared buffer, so that a vertex paint follows the vertices wherever the pose pass moves
//! them. Unchanged vertex paint objects are packed only once.

use super::packed::{Packed, Room};
use crate::plan::pack::{VERTEX_PAINT_WORDS, VertexPaintRow};
use crate::plan::{Contents, Piece};
use crate::scene::{Part, Scene, VertexPaint};

/// Maximum words of all vertex paints: what one binding holds on any device, 2.5 million triangles. Parts beyond it get a single colour.
const MOST_WORDS: u64 = 32 << 20;

/// The vertex paints of a scene.
#[derive(Clone, Debug)]
pub(crate) struct VertexPaints {
    /// A row for each part that has a vertex paint.
    pub(crate) rows: Vec<VertexPaintRow>,
    /// Triangle count of each vertex paint.
    pub(crate) triangles: Vec<u32>,
    pub(crate) words: Contents,
    /// The numbers 0, 1, 2 and so on, three per triangle of the part with the most triangles.
    pub(crate) indices: Contents,
}

/// Returns the vertex paint of a part's mesh if the part shows it.
pub(crate) fn shown(part: &Part) -> Option<&VertexPaint> {
    let vertex_paint = part.mesh.vertex_paint.as_ref();
    vertex_paint.filter(|_| !part.material.is_painted_over)
}

impl VertexPaints {
    /// Vertex paints of the parts that show one; `None` if none does. Their textures begin at `first_image`, in the order of parts. Index
    /// lists are reused from before if they have the same length.
    pub(crate) fn of(
        scene: &Scene,
        (packed, rooms): (&[Packed], &[Room]),
        first_image: u32,
        before: Option<&Self>,
    ) -> Option<Self> {
        let mut next = VertexPaintRow {
            first_image,
            ..bytemuck::Zeroable::zeroed()
        };
        let (mut rows, mut triangles, mut pieces) = (Vec::new(), Vec::new(), Vec::new());
        for (part, (of, packed)) in (0..).zip(scene.parts.iter().zip(packed)) {
            let (Some(vertex_paint), Some(words)) = (shown(of), &packed.vertex_paint) else {
                continue;
            };
            // The textures of a part that is left out are numbered nevertheless.
            let first_image = next.first_image;
            next.first_image += vertex_paint.images.len() as u32;
            let end =
                u64::from(next.first_word) + u64::from(words.triangles) * VERTEX_PAINT_WORDS as u64;
            if end > MOST_WORDS || words.triangles == 0 {
                continue;
            }
            rows.push(VertexPaintRow {
                part,
                first_vertex: rooms[part as usize].first_vertex,
                first_image,
                ..next
            });
            triangles.push(words.triangles);
            pieces.push(Piece {
                offset: u64::from(next.first_word) * 4,
                bytes: words.words.clone(),
            });
            next.first_word += words.triangles * VERTEX_PAINT_WORDS as u32;
        }
        let most = triangles.iter().max()? * 3;
        let is_long = |before: &&Self| before.indices.len() >= u64::from(most) * 4;
        Some(Self {
            rows,
            triangles,
            words: Contents::in_pieces(u64::from(next.first_word) * 4, pieces, false),
            indices: match before.filter(is_long) {
                Some(before) => before.indices.clone(),
                None => Contents::from_values(&(0..most).collect::<Vec<u32>>()),
            },
        })
    }
}
