//! Items distributed to buckets that fit into a cache, in parallel.
//!
//! Sorting or joining 150 million items as a whole misses the cache at nearly every step; bucket by bucket it does not. Each thread writes
//! the buckets of its own share of the sources, which are then read share after share.
//!
//! Cost: each item is written once and read once. Memory: twice the items while the vectors grow, and 24 bytes for each bucket of each share.

use rayon::prelude::*;

/// Number of items of a bucket, if they are evenly distributed: 512 KiB of `u64`.
const ITEMS_PER_BUCKET: usize = 1 << 16;

/// Fewest sources of a share.
const LEAST_SHARE: usize = 1 << 14;

/// Shares for each thread, so that threads end at about the same time.
const SHARES_PER_THREAD: usize = 4;

/// Items by share of the sources, then by bucket.
pub(super) struct Buckets<T> {
    shares: Vec<Vec<Vec<T>>>,
    number: usize,
}

/// Number of bits that number buckets for so many items.
pub(super) fn bits_for(items: usize) -> u32 {
    (items / ITEMS_PER_BUCKET).max(1).ilog2()
}

impl<T: Copy + Send + Sync> Buckets<T> {
    /// Distributes the items of each source to a number of buckets. `items_of` is given a source and its index, and returns items with their
    /// buckets.
    pub(super) fn of<S: Sync, I: IntoIterator<Item = (usize, T)>>(
        sources: &[S],
        number: usize,
        items_of: impl Fn(usize, &S) -> I + Sync,
    ) -> Self {
        let shares = SHARES_PER_THREAD * rayon::current_num_threads();
        let share = sources.len().div_ceil(shares).max(LEAST_SHARE);
        let shares = sources.par_chunks(share).enumerate().map(|(i, some)| {
            let mut buckets = vec![Vec::new(); number];
            for (index, source) in (i * share..).zip(some) {
                for (bucket, item) in items_of(index, source) {
                    buckets[bucket].push(item);
                }
            }
            buckets
        });
        Self {
            shares: shares.collect(),
            number,
        }
    }

    /// The items of each bucket, in the order of their sources.
    pub(super) fn par_iter(&self) -> impl IndexedParallelIterator<Item = impl Iterator<Item = T>> {
        (0..self.number).into_par_iter().map(|bucket| {
            let shares = self.shares.iter();
            shares.flat_map(move |share| share[bucket].iter().copied())
        })
    }

    /// Sorts the items of each bucket and maps them.
    pub(super) fn par_map_sorted<R: Send>(
        &self,
        map: impl Fn(&[T]) -> R + Sync + Send,
    ) -> impl IndexedParallelIterator<Item = R>
    where
        T: Ord,
    {
        self.par_iter().map_init(Vec::new, move |sorted, items| {
            sorted.clear();
            sorted.extend(items);
            sorted.sort_unstable();
            map(sorted)
        })
    }
}
