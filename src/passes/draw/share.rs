//! Distribution of triangle samples among invocations.
//!
//! **Bounded work.** Drivers stop long loops: llvmpipe when an invocation's loops have taken 65,535 rounds in total, GPUs by a watchdog. A
//! covered sample's rounds depend on its crossings, its lane and its preclassified faces, so the samples that an invocation covers are
//! limited ([`Share`]); no other loop grows with mesh or picture. The first pass to visit the triangles queues the larger ones; a prefix
//! sum over the queue counts the pieces, and one workgroup is dispatched for each (`shaders/lib/rasterise/pieces.wgsl`).
//!
//! Cannot: stay below llvmpipe's limit where a single sample takes more than 700 rounds (a list of that many crossings with several
//! clip-surfaces). A triangle with 64 samples in a row is then cut off, which the parity bit shows.

use super::store::Store;
use crate::passes::frame::buffers::SceneBuffers;
use crate::passes::frame::crossings::CrossingSource;

/// Loop rounds available to the samples of one invocation: fewer than llvmpipe's 65,535, because other loops need rounds too.
const ROUNDS_OF_SAMPLES: u32 = 48_000;

/// Distribution of samples among invocations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Share {
    /// A triangle whose bounding box has no side longer than this, in pixels, is covered by one invocation.
    small_px: u32,
    /// Samples in a row that one invocation covers of a larger triangle, plus up to three tiles of 64; below 1, one tile.
    piece_px: f64,
}

impl Share {
    /// Share for fragments that write to a store and count no crossings.
    pub(crate) fn of_store(store: &Store) -> Self {
        Self::of_rounds(store.rounds)
    }

    /// Share for fragments that also count the crossings in front of them.
    pub(crate) fn of_crossings(
        scene: &SceneBuffers<'_>,
        store: &Store,
        crossings: &CrossingSource,
    ) -> Self {
        // One loop moves a preclassified face to its side of each crossing, another to its side of each crossing with a cutter.
        let preclassified = match scene.preclassified {
            Some(_) => 2 * crossings.capacity,
            None => 0,
        };
        Self::of_rounds(store.rounds + crossings.rounds() + preclassified)
    }

    /// The largest share of samples for a given number of loop rounds per sample.
    fn of_rounds(rounds: u32) -> Self {
        let most = ROUNDS_OF_SAMPLES / (rounds + 2);
        let small = [64, 32, 16, 8].into_iter().find(|px| px * px <= most);
        let piece = [512, 256, 64].into_iter().find(|px| px + 192 <= most);
        Self {
            small_px: small.unwrap_or(4),
            piece_px: piece.map_or(0.25, f64::from),
        }
    }

    /// The share as override constants.
    pub(crate) fn constants(self) -> [(&'static str, f64); 2] {
        [
            ("small_px", f64::from(self.small_px)),
            ("piece_px", self.piece_px),
        ]
    }
}

/// Index of the queue word that holds the first queued triangle's first piece; must match `shaders/lib/rasterise/queue.wgsl`.
pub(crate) fn first_piece_at(triangle_count: u32) -> u32 {
    2 + 2 * triangle_count
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_keep_within_the_rounds_of_an_invocation() {
        for rounds in [0, 1, 9, 43, 100, 257, 600] {
            let Share { small_px, piece_px } = Share::of_rounds(rounds);
            let small = small_px * (small_px * (rounds + 1) + 1);
            let line = if piece_px < 1.0 {
                64
            } else {
                piece_px as u32 + 192
            };
            let large = line * (rounds + 1) + 257;
            assert!(small.max(large) < 65_535, "{rounds}: {small}, {large}");
        }
        assert_eq!(Share::of_rounds(1).small_px, 64, "a plane costs nothing");
        // Control: a share for one round is too large for a thousand rounds.
        assert!(Share::of_rounds(1000).small_px < 8);
    }
}
