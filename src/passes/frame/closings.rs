//! Open parts of a frame, closed for counting: their closing triangles follow the indices of all parts, and are drawn as parts that one more
//! cut, without clip-surfaces, removes entirely. So their fragments count like all others, and are never kept.
//!
//! The winding number of the closing triangles is needed at many points, and nearly everywhere only to the nearest whole number. A grid of
//! cells around each open part stores it where one number serves a whole cell; a pass on the clock of the solid fills it.

use rayon::prelude::*;

use super::input::Input;
use super::refusal::Refusal;
use crate::passes::pack::model::Model;
use crate::plan::pack::MAX_CUTS;
use crate::plan::{Binding, Clock, Contents, Draw, INDEX_BYTES, Pass, Piece, Plan, Resource, Work};

/// Bytes of four words, in which trees are addressed.
const VECTOR_BYTES: u64 = 16;

/// Vectors of a grid, in the layout of `shaders/lib/inside_tests/closings.wgsl`.
const VECTORS_OF_GRID: u64 = 3;

/// Greatest number of cells of all grids of a frame.
const MOST_GRID_CELLS: f64 = 131_072.0;

/// Greatest number of cells along a side of a part, and of one whose cells are filled again in every frame.
const MOST_CELLS_ALONG: f64 = 48.0;
const MOST_CELLS_ALONG_MOVING: f64 = 16.0;

/// Invocations of a workgroup that fills cells: `shaders/strategies/inside/winding/cells.wgsl`.
const CELLS_OF_GROUP: u32 = 64;

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
    /// By rank; the number of a part is that of its grid.
    parts: Vec<ClosedPart>,
    /// Indices of all closing triangles.
    indices: Vec<Piece>,
    /// Grids of all parts, then their trees.
    pub trees: Contents,
    /// Number of cells of all grids, and of the largest one.
    cells: u32,
    most_cells: u32,
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

    /// The grid of the part with a given rank, if it is closed for counting.
    pub(crate) fn closing_grid(&self, rank: usize) -> Option<u32> {
        let parts = self.closed_parts();
        let found = parts.binary_search_by_key(&rank, |part| part.rank);
        found.ok().map(|grid| grid as u32)
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
        let parts = &model.prepared.parts;
        let open = ranks.par_iter().filter_map(|rank| {
            let closing = model.closing(*rank)?;
            Some((*rank, model.closing_tree(*rank, &closing), closing))
        });
        let mut open: Vec<_> = open.collect();
        open.sort_by_key(|(rank, ..)| *rank);
        let (mut closed, mut indices, mut trees) = (Vec::new(), Vec::new(), Vec::new());
        let mut grids: Vec<[u32; 4]> = Vec::new();
        let mut first_index = model.indices.len() / INDEX_BYTES;
        let count_of_open = open.len();
        let mut tree = count_of_open as u64 * VECTORS_OF_GRID * VECTOR_BYTES;
        let (mut cells, mut most_cells) = (0, 0);
        for (rank, bytes, closing) in open {
            let along = (MOST_GRID_CELLS / count_of_open as f64).cbrt();
            let along = along.min(match model.moving[rank] {
                Some(_) => MOST_CELLS_ALONG_MOVING,
                None => MOST_CELLS_ALONG,
            });
            let bounds = &parts[rank].bounds;
            let cell = (bounds.size().max_element() / along.floor().max(1.0)).max(1e-6);
            let counts = (bounds.size() / cell).ceil().max(glam::DVec3::ONE);
            // A grid without cells: nothing is inside.
            let counts = counts.to_array().map(|count| {
                match closing.is_flat && model.moving[rank].is_none() {
                    true => 0,
                    false => count as u32,
                }
            });
            let [x, y, z] = bounds.min.as_vec3().to_array().map(f32::to_bits);
            let [along_x, along_y, along_z] = counts;
            grids.extend([
                [x, y, z, (cell as f32).to_bits()],
                [along_x, along_y, along_z, cells],
                [(tree / VECTOR_BYTES) as u32, 0, 0, 0],
            ]);
            let count: u32 = counts.iter().product();
            (cells, most_cells) = (cells + count, count.max(most_cells));
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
        trees.insert(0, Piece::from_values(0, &grids));
        (!closed.is_empty()).then(|| Self {
            parts: closed,
            indices,
            trees: Contents::in_pieces(tree, trees, model.indices.changes()),
            cells,
            most_cells,
        })
    }

    /// Records the pass that fills the grids. `trees` binds [`Self::trees`].
    pub(super) fn fill_cells(&self, plan: &mut Plan, trees: &Binding) -> Binding {
        let bytes = u64::from(self.cells) * 4;
        let cells = Resource::storage("closing_cells", bytes, Clock::Solid);
        let cells = plan.add_resource(cells);
        let groups = [
            self.most_cells.div_ceil(CELLS_OF_GROUP),
            self.parts.len() as u32,
            1,
        ];
        let pass = Pass::new(
            "closing cells",
            "the winding number of each open part's closing triangles, in cells where it is one whole number throughout",
            "strategies/inside/winding/cells.wgsl",
            vec![trees.clone(), Binding::write("closing_cells", cells)],
            Work::Compute { groups },
        );
        plan.add_pass(pass.on(Clock::Solid));
        Binding::read("closing_cells", cells)
    }
}
