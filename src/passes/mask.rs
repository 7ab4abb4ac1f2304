//! The inside mask as a resource: a lane of bits or of counts for each cut part, as wide as the list of crossings is long.
//!
//! Written by fragments, or made once they have left what they know. What is made from something bounded has one more plane of
//! a word per pixel, which says where not all found room.

use super::{Recorder, pixels};
use crate::plan::{Clock, Resource, ResourceId};

impl Recorder<'_> {
    /// Makes lanes wide enough for lists of so many crossings; before anything mentions the table of parts. Up to 32 bits they are
    /// a power of two, beyond that whole words, so that none straddles a word.
    pub fn lay_lanes(&mut self, crossings: u32) {
        let bits = crossings + 1;
        self.lane_bits = if bits > 32 {
            bits.next_multiple_of(32)
        } else {
            bits.next_power_of_two().max(2)
        };
    }

    /// The mask that fragments write.
    pub fn mask(&mut self) -> ResourceId {
        self.mask_of(0)
    }

    /// The mask that is made from what fragments left.
    pub fn reduced_mask(&mut self) -> ResourceId {
        self.mask_of(1)
    }

    fn mask_of(&mut self, planes_beside: u64) -> ResourceId {
        let words = u64::from(self.lane_table().words);
        let bytes = pixels(self.view.size_px) * 4 * (words + planes_beside);
        self.once("mask", |_| Resource::storage("mask", bytes, Clock::Frame))
    }
}
