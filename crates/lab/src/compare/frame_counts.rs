//! Numbers of pixels of a frame by what they show, summed over the strips of a picture, so that the layers need not be kept.

use cutaway::layers::{Kind, Layers};
use cutaway::scene::{Prepared, View};

use super::may_be_wrong;

/// Numbers of pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FrameCounts {
    /// Pixels that show nothing.
    pub background: usize,
    /// Pixels that show a surface of the mesh.
    pub surface: usize,
    /// Pixels that show a cap.
    pub cap: usize,
    /// Pixels that show a cap shared by several solids.
    pub overlap: usize,
    /// Pixels that the strategy marks: their crossings are inconsistent, or a buffer was too small.
    pub unreliable: usize,
    /// Marked pixels whose content depends on what is inside a part ([`may_be_wrong`]).
    pub may_be_wrong: usize,
}

impl FrameCounts {
    /// Adds the pixels of layers, which are the rows of a view from `first_row` on.
    pub fn add(&mut self, layers: &Layers, prepared: &Prepared, view: &View, first_row: u32) {
        let view = view.rows(first_row, layers.size_px[1]);
        self.background += layers.count(Kind::Background);
        self.surface += layers.count(Kind::Surface);
        self.cap += layers.count(Kind::Cap);
        self.overlap += layers.overlap_px();
        self.unreliable += layers.pixels.iter().filter(|p| p.unreliable).count();
        let doubted = may_be_wrong(layers, prepared, &view);
        self.may_be_wrong += doubted.iter().filter(|w| **w).count();
    }

    /// The number of all pixels.
    pub fn total(&self) -> usize {
        self.background + self.surface + self.cap
    }
}
