//! Open parts of a frame, closed for counting: their closing triangles follow the indices of all parts, and are drawn as parts that one more
//! cut, without clip-surfaces, removes entirely. So their fragments count like all others, and are never kept.

use glam::DVec3;
use rayon::prelude::*;

use super::input::Input;
use super::refusal::Refusal;
use crate::passes::pack::model::Model;
use crate::plan::pack::MAX_CUTS;
use crate::plan::{Contents, Draw, INDEX_BYTES, Piece};

/// Bytes of four words, in which trees are addressed; and of the head of a part, in the layout of
/// `shaders/lib/inside_tests/closings.wgsl`.
const VECTOR_BYTES: u64 = 16;
const CLOSING_HEAD_BYTES: u64 = 2 * VECTOR_BYTES;

/// Most vectors that a list of triangles can address: six bits of a word count them.
const MOST_VECTORS: u64 = 1 << 26;

/// An open part.
#[derive(Clone, Debug)]
pub(crate) struct ClosedPart {
    pub rank: usize,
    /// First index of its closing triangles, and the end of them.
    pub indices: std::ops::Range<u32>,
}

/// The open parts of a scene.
#[derive(Clone, Debug)]
pub(crate) struct Closings {
    /// By rank.
    parts: Vec<ClosedPart>,
    /// Indices of all closing triangles.
    indices: Vec<Piece>,
    /// For each part its box and the address of its tree, then the trees.
    pub trees: Contents,
}

impl Input<'_> {
    /// The same input with the open parts among those that need an inside test; the reason if a frame has no cut to spare. Without
    /// open parts, the input is unchanged.
    pub(crate) fn closed(&self) -> Result<Self, Refusal> {
        let mut closed = self.clone();
        closed.closings = Closings::of(self.model, self.active_cuts.cut_parts());
        if closed.closings.is_some() {
            if self.active_cuts.cuts.len() >= MAX_CUTS {
                return Err(Refusal::amount(format!(
                    "open parts are closed by one more cut, and a frame has at most {MAX_CUTS}"
                )));
            }
            let vectors = closed.closings.as_ref().map_or(0, |c| c.trees.len()) / VECTOR_BYTES;
            if vectors > MOST_VECTORS {
                return Err(Refusal::amount(format!(
                    "the closing triangles of open parts take {vectors} vectors, and at most {MOST_VECTORS} can be addressed"
                )));
            }
            // Closing triangles need rows of the same table.
            closed.preclassified = closed.find_preclassified();
        }
        Ok(closed)
    }

    /// The open parts that are closed for counting.
    pub(crate) fn closed_parts(&self) -> &[ClosedPart] {
        self.closings
            .as_ref()
            .map_or(&[], |closings| &closings.parts)
    }

    /// The place among [`Self::closed_parts`] of the part with a given rank.
    pub(crate) fn closing_of(&self, rank: usize) -> Option<u32> {
        let parts = self.closed_parts();
        let found = parts.binary_search_by_key(&rank, |part| part.rank);
        found.ok().map(|place| place as u32)
    }

    /// Bits of a cut without clip-surfaces, which removes everything.
    pub(crate) fn cut_of_everything(&self) -> u32 {
        1 << self.active_cuts.cuts.len()
    }

    /// Index contents of all parts, followed by closing triangles.
    pub(crate) fn with_closings(&self, indices: &Contents) -> Contents {
        match &self.closings {
            None => indices.clone(),
            Some(closings) => {
                let all = indices.pieces().iter().chain(&closings.indices).cloned();
                let end = closings.indices.last().map_or(0, |piece| piece.range().end);
                Contents::in_pieces(end, all.collect(), indices.changes())
            }
        }
    }

    /// Row of the part table for the first closed part's closing triangles.
    pub(crate) fn first_closing_row(&self) -> usize {
        let parts = &self.model.prepared.parts;
        self.active_cuts.order.len().max(parts.len())
    }

    /// The draws of the closing triangles; the instance is their row of the part table.
    pub(crate) fn draws_of_closings(&self) -> impl Iterator<Item = Draw> {
        let first = self.first_closing_row();
        (self.closed_parts().iter().enumerate()).map(move |(number, part)| Draw {
            indices: part.indices.clone(),
            instance: (first + number) as u32,
            ..self.draws_of(&[part.rank]).remove(0)
        })
    }
}

impl Closings {
    /// The open ones among the parts with given ranks; `None` if all are closed.
    fn of(model: &Model, ranks: &[usize]) -> Option<Self> {
        let open = ranks.par_iter().filter_map(|rank| {
            let closing = model.closing(*rank)?;
            Some((*rank, model.closing_tree(*rank, &closing), closing))
        });
        let mut open: Vec<_> = open.collect();
        open.sort_by_key(|(rank, ..)| *rank);
        let (mut closed, mut indices, mut trees) = (Vec::new(), Vec::new(), Vec::new());
        let mut heads: Vec<[u32; 4]> = Vec::new();
        let mut first_index = model.indices.len() / INDEX_BYTES;
        let mut tree = open.len() as u64 * CLOSING_HEAD_BYTES;
        for (rank, bytes, closing) in open {
            let is_flat = closing.is_flat && model.moving[rank].is_none();
            let bounds = &model.prepared.parts[rank].bounds;
            let corner = |corner: DVec3| corner.as_vec3().to_array().map(f32::to_bits);
            let ([a, b, c], [d, e, f]) = (corner(bounds.min), corner(bounds.max));
            heads.extend([
                [a, b, c, (tree / VECTOR_BYTES) as u32],
                [d, e, f, u32::from(is_flat)],
            ]);
            let end = first_index + u64::from(closing.index_count());
            closed.push(ClosedPart {
                rank,
                indices: first_index as u32..end as u32,
            });
            indices.push(Piece {
                offset: first_index * INDEX_BYTES,
                bytes: closing.indices.clone(),
            });
            first_index = end;
            let offset = tree;
            tree += bytes.len() as u64;
            trees.push(Piece { offset, bytes });
        }
        trees.insert(0, Piece::from_values(0, &heads));
        (!closed.is_empty()).then(|| Self {
            parts: closed,
            indices,
            trees: Contents::in_pieces(tree, trees, model.indices.changes()),
        })
    }
}
