//! Layout of the parts' words within a pixel, for inside tests that store such words; and the mask made from them.
//!
//! Even-odd parts have lanes of bits: as many lanes to a word as fit, or several words per lane if lists are long. If the inside test
//! supports the nonzero rule, nonzero parts have separate words after all lanes of bits.
//!
//! The mask is either written by fragments, or made from what they stored. A mask made from a bounded buffer has one more
//! word per pixel, which marks the pixels that lost fragments.

use super::input::Input;
use crate::plan::{Clock, Plan, Resource, ResourceId};
use crate::scene::Fill;

/// `lane_shift` of a part whose lane holds counts; must match `WINDING` in `shaders/lib/inside_tests/lanes.wgsl`.
const COUNTS: u32 = 32;

/// Maximum words per pixel, and thus rounds of a loop over them; must match `shaders/lib/inside_tests/lanes.wgsl`.
pub(crate) const MOST_LANE_WORDS: u32 = 1024;

/// The lanes of all parts that need an inside test.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Lanes {
    /// Width in bits of a lane of bits.
    pub bits: u32,
    /// First word and shift of each part, in table order.
    places: Vec<[u32; 2]>,
    /// Number of words per pixel.
    pub words: u32,
}

impl Lanes {
    /// No lanes, for a strategy that keeps no words.
    pub(crate) fn none() -> Self {
        Self {
            bits: 32,
            places: Vec::new(),
            words: 0,
        }
    }

    /// Lanes of bits for all parts, wide enough for lists of `crossings` crossings. Widths up to 32 bits are powers of two, larger ones
    /// whole words, so that none straddles a word.
    pub(crate) fn of_bits(input: &Input<'_>, crossings: u32) -> Self {
        Self::with_counts(input, crossings, 0)
    }

    /// As [`Self::of_bits`], except that nonzero parts have `words_of_counts` words each.
    pub(crate) fn with_counts(input: &Input<'_>, crossings: u32, words_of_counts: u32) -> Self {
        let bits = crossings + 1;
        let bits = if bits > 32 {
            bits.next_multiple_of(32)
        } else {
            bits.next_power_of_two().max(2)
        };
        let parts = &input.model.prepared.parts;
        let counts = |rank: &usize| {
            words_of_counts > 0
                && (parts[*rank].fill == Fill::Nonzero || input.closing_of(*rank).is_some())
        };
        let ranks = input.active_cuts.cut_parts();
        let of_bits = ranks.iter().filter(|r| !counts(r)).count() as u32;
        let mut lane = 0;
        let mut words = (of_bits * bits).div_ceil(32);
        let places = ranks
            .iter()
            .map(|rank| {
                if counts(rank) {
                    words += words_of_counts;
                    [words - words_of_counts, COUNTS]
                } else {
                    lane += 1;
                    let bit = (lane - 1) * bits;
                    [bit / 32, bit % 32]
                }
            })
            .collect();
        Self {
            bits,
            places,
            words,
        }
    }

    /// First word and shift of the part at a table position; zeros if it has no lane.
    pub(crate) fn of_place(&self, place: usize) -> [u32; 2] {
        self.places.get(place).copied().unwrap_or_default()
    }

    /// The width as an override constant.
    pub(crate) fn constant(&self) -> (&'static str, f64) {
        ("lane_bits", f64::from(self.bits))
    }

    /// The mask that fragments write, with `more_words` behind it.
    pub(crate) fn mask(&self, plan: &mut Plan, input: &Input<'_>, more_words: u64) -> ResourceId {
        let words = input.pixel_count() * u64::from(self.words) + more_words;
        plan.add_resource(Resource::storage("mask", 4 * words, Clock::Frame))
    }

    /// The mask that is made from what fragments stored.
    pub(crate) fn reduced_mask(&self, plan: &mut Plan, input: &Input<'_>) -> ResourceId {
        self.mask(plan, input, input.pixel_count())
    }
}
