//! Where the words of each part are among those of a pixel, for inside tests that keep such words.
//!
//! Parts filled even-odd have lanes of bits, as many to a word as fit, or several words each where lists are long. Parts filled nonzero have words of their own after all
//! of those, where the inside test has given them some ([`Recorder::winding_words`]).

use super::Recorder;
use crate::scene::Fill;

/// `lane_shift` of a part whose lane holds counts; `WINDING` in `shaders/lib/lanes.wgsl`.
const COUNTS: u32 = 32;

/// The lanes of all parts that need an inside test.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LaneTable {
    /// First word and shift, in table order.
    pub places: Vec<[u32; 2]>,
    /// Words of a pixel.
    pub words: u32,
}

impl Recorder<'_> {
    /// Where the lanes are.
    pub fn lane_table(&self) -> LaneTable {
        let counts = |rank: &usize| {
            self.winding_words > 0 && self.model.prepared.parts[*rank].fill == Fill::Nonzero
        };
        let ranks = self.relevance.cut_parts();
        let of_bits = ranks.iter().filter(|r| !counts(r)).count() as u32;
        let mut lane = 0;
        let mut words = (of_bits * self.lane_bits).div_ceil(32);
        let places = ranks
            .iter()
            .map(|rank| {
                if counts(rank) {
                    words += self.winding_words;
                    [words - self.winding_words, COUNTS]
                } else {
                    lane += 1;
                    let bit = (lane - 1) * self.lane_bits;
                    [bit / 32, bit % 32]
                }
            })
            .collect();
        LaneTable { places, words }
    }

    /// Whether some part that needs an inside test is filled nonzero.
    pub fn has_nonzero(&self) -> bool {
        let parts = &self.model.prepared.parts;
        let mut ranks = self.relevance.cut_parts().iter();
        ranks.any(|r| parts[*r].fill == Fill::Nonzero)
    }
}
