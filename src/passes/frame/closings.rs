//! Open parts of a frame, closed for counting: their closing triangles follow the indices of all parts, and are drawn as parts that one more
//! cut, without clip-surfaces, removes entirely. So their fragments count like all others, and are never kept.

use super::input::Input;
use super::refusal::Refusal;
use crate::passes::pack::model::Model;
use crate::plan::pack::MAX_SURFACES;
use crate::plan::{Contents, Draw, INDEX_BYTES, Piece};

/// Bytes of four words, in which trees are addressed.
const VECTOR_BYTES: u64 = 16;

/// An open part that needs an inside test.
#[derive(Clone, Debug)]
pub(crate) struct ClosedPart {
    pub rank: usize,
    /// First index of its closing triangles, and the end of them.
    pub indices: std::ops::Range<u32>,
    /// Address of its tree, in vectors of four words.
    pub tree: u32,
}

/// The open parts that need an inside test.
#[derive(Clone, Debug)]
pub(crate) struct Closings {
    pub parts: Vec<ClosedPart>,
    /// Indices of all closing triangles.
    indices: Vec<Piece>,
    /// Their trees, one after the other.
    pub trees: Contents,
}

impl Input<'_> {
    /// The same input with the open parts among those that need an inside test; the reason if a frame has no cut to spare. Without
    /// open parts, the input is unchanged.
    pub(crate) fn closed(&self) -> Result<Self, Refusal> {
        let mut closed = self.clone();
        closed.closings = Closings::of(self.model, self.active_cuts.cut_parts());
        if closed.closings.is_some() && self.active_cuts.cuts.len() >= MAX_SURFACES {
            return Err(Refusal::amount(format!(
                "open parts are closed by one more cut, and a frame has at most {MAX_SURFACES}"
            )));
        }
        Ok(closed)
    }

    /// The open parts that are closed for counting.
    pub(crate) fn closed_parts(&self) -> &[ClosedPart] {
        self.closings
            .as_ref()
            .map_or(&[], |closings| &closings.parts)
    }

    /// Returns true if the part with a given rank is closed for counting.
    pub(crate) fn closes(&self, rank: usize) -> bool {
        self.closed_parts().iter().any(|part| part.rank == rank)
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
        self.closed_parts()
            .iter()
            .enumerate()
            .map(move |(number, part)| Draw {
                indices: part.indices.clone(),
                instance: (first + number) as u32,
                ..self.draws_of(&[part.rank]).remove(0)
            })
    }
}

impl Closings {
    /// The open ones among the parts with given ranks; `None` if all are closed.
    fn of(model: &Model, ranks: &[usize]) -> Option<Self> {
        let mut closings = Self {
            parts: Vec::new(),
            indices: Vec::new(),
            trees: Contents::from_values::<u32>(&[]),
        };
        let mut first_index = model.indices.len() / INDEX_BYTES;
        let (mut tree, mut trees) = (0, Vec::new());
        for rank in ranks {
            let Some(closing) = model.closing(*rank) else {
                continue;
            };
            let end = first_index + u64::from(closing.index_count());
            let bytes = model.closing_tree(*rank, &closing);
            closings.parts.push(ClosedPart {
                rank: *rank,
                indices: first_index as u32..end as u32,
                tree: (tree / VECTOR_BYTES) as u32,
            });
            closings.indices.push(Piece {
                offset: first_index * INDEX_BYTES,
                bytes: closing.indices.clone(),
            });
            first_index = end;
            let offset = tree;
            tree += bytes.len() as u64;
            trees.push(Piece { offset, bytes });
        }
        closings.trees = Contents::in_pieces(tree, trees, model.indices.changes());
        (!closings.parts.is_empty()).then_some(closings)
    }
}
