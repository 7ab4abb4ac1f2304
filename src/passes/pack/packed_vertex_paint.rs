//! The vertex paint of a part, packed for upload: 13 words per triangle.

use std::sync::Arc;

use crate::plan::Piece;
use crate::plan::pack::{NO_TEXTURE, VERTEX_PAINT_WORDS};
use crate::scene::{TexturedTriangle, VertexPaint, facing_out};

/// The vertex paint of a part, packed: words with images numbered from 0.
#[derive(Clone, Debug)]
pub(crate) struct PackedVertexPaint {
    pub(crate) words: Arc<[u8]>,
    pub(crate) triangles: u32,
}

impl PackedVertexPaint {
    /// Packs a vertex paint with the drawn vertices in place of its corners; both are in the order of the mesh, with the vertices already
    /// reversed if the placement mirrors.
    pub(crate) fn of(vertex_paint: &VertexPaint, vertices: &[[u32; 3]], mirrored: bool) -> Self {
        let rows = vertex_paint
            .triangles
            .iter()
            .zip(vertices)
            .map(|(textured, vertices)| {
                let TexturedTriangle { colors, uv, image } = textured;
                let (colors, uv) = (facing_out(*colors, mirrored), facing_out(*uv, mirrored));
                let mut row = [0_u32; VERTEX_PAINT_WORDS];
                for i in 0..3 {
                    row[i] = vertices[i];
                    row[3 + i] = u32::from_le_bytes(colors[i]);
                    row[6 + 2 * i] = uv[i].x.to_bits();
                    row[7 + 2 * i] = uv[i].y.to_bits();
                }
                row[12] = image.unwrap_or(NO_TEXTURE);
                row
            });
        let rows: Vec<[u32; VERTEX_PAINT_WORDS]> = rows.collect();
        Self {
            triangles: rows.len() as u32,
            words: Piece::from_values(0, rows.as_flattened()).bytes,
        }
    }
}
