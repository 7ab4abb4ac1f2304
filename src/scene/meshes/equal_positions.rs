//! Numbers positions so that equal ones have the same number, wherever they are stored.
//!
//! Most positions of a file equal one that appeared recently. The rest are hashed in parallel, in buckets that fit into a cache.
//!
//! Memory: five bytes for each position. Limit: coordinates that were made to have the same hash take a time that grows with the square of
//! their number.

use std::sync::atomic::{AtomicU32, Ordering};

use glam::DVec3;
use hashbrown::HashTable;
use rayon::prelude::*;

use super::buckets::{Buckets, bits_for};

/// Number of positions that a thread takes at once.
const SHARE: usize = 1 << 20;

/// New indices in order of first appearance; equal coordinates get equal indices.
pub(super) fn joined_where_equal(count: usize, at: impl Fn(usize) -> DVec3 + Sync) -> Vec<u32> {
    let first = joined_with_recent(count, &at);
    let bits = bits_for(count);
    let buckets = Buckets::of(&first, 1 << bits, |i, first| {
        // The table of a bucket uses the low and the highest bits: the ones between them number the bucket.
        let bucket = || (hash(at(i)) >> 32) as usize & ((1 << bits) - 1);
        let is_first = first.load(Ordering::Relaxed) as usize == i;
        is_first.then(|| (bucket(), i as u32))
    });
    buckets.par_iter().for_each(|items| {
        let mut firsts: HashTable<(u32, u64)> = HashTable::new();
        for i in items {
            let p = at(i as usize);
            let hash = hash(p);
            let is_same = |(j, _): &(u32, u64)| at(*j as usize) == p;
            let of_place = firsts.entry(hash, is_same, |(_, hash)| *hash);
            let (j, _) = *of_place.or_insert((i, hash)).get();
            first[i as usize].store(j, Ordering::Relaxed);
        }
    });
    drop(buckets);
    numbered(first)
}

/// For each position, the index of an equal one before it, or its own. Only positions that appeared recently are found, but these are most:
/// files list triangles next to each other.
fn joined_with_recent(count: usize, at: impl Fn(usize) -> DVec3 + Sync) -> Vec<AtomicU32> {
    const RECENT: usize = 1 << 16;
    let first: Vec<AtomicU32> = (0..count)
        .into_par_iter()
        .map(|i| AtomicU32::new(i as u32))
        .collect();
    first
        .par_chunks(SHARE)
        .enumerate()
        .for_each(|(share, some)| {
            let places = some.len().next_power_of_two().min(RECENT);
            let mut recent = vec![(u32::MAX, DVec3::NAN); places];
            for (i, first) in (share * SHARE..).zip(some) {
                let p = at(i);
                let last = &mut recent[hash(p) as usize % places];
                if last.1 == p {
                    first.store(last.0, Ordering::Relaxed);
                } else {
                    *last = (i as u32, p);
                }
            }
        });
    first
}

/// A hash of coordinates. It is the same for `-0.0` and `0.0`.
pub(super) fn hash(p: DVec3) -> u64 {
    // Multiples of the golden ratio's bits; the upper half of a product depends on all bits of the factors.
    const ODD: u64 = 0x9e37_79b9_7f4a_7c15;
    let mix = |hash: u64, c: f64| {
        let product = u128::from(hash ^ (c + 0.0).to_bits()) * u128::from(ODD);
        (product >> 64) as u64 ^ product as u64
    };
    p.to_array().into_iter().fold(ODD, mix)
}

/// Consecutive new indices of sets. `first` gives, for each member, an earlier one, which gives the first; the first gives itself.
pub(super) fn numbered(first: Vec<AtomicU32>) -> Vec<u32> {
    let is_first = |i: usize| first[i].load(Ordering::Relaxed) as usize == i;
    let is_first: Vec<bool> = (0..first.len()).into_par_iter().map(is_first).collect();
    // The first of a set gives the set's number from here on, and each other member the first.
    let resolve = |(first_of, is_first): (&AtomicU32, &bool)| {
        if !is_first {
            let before = first_of.load(Ordering::Relaxed);
            let first = first[before as usize].load(Ordering::Relaxed);
            first_of.store(first, Ordering::Relaxed);
        }
    };
    first.par_iter().zip(&is_first).for_each(resolve);
    let shares = is_first.par_chunks(SHARE);
    let counts: Vec<u32> = (shares.clone())
        .map(|some| some.iter().map(|is_first| u32::from(*is_first)).sum())
        .collect();
    let shares = shares.zip(first.par_chunks(SHARE)).enumerate();
    shares.for_each(|(share, (is_first, first))| {
        let firsts = first
            .iter()
            .zip(is_first)
            .filter(|(_, is_first)| **is_first);
        let before = counts[..share].iter().sum::<u32>();
        for (number, (first, _)) in (before..).zip(firsts) {
            first.store(number, Ordering::Relaxed);
        }
    });
    let number = |(first_of, is_first): (&AtomicU32, &bool)| {
        if !is_first {
            let first_of_set = first_of.load(Ordering::Relaxed);
            let number = first[first_of_set as usize].load(Ordering::Relaxed);
            first_of.store(number, Ordering::Relaxed);
        }
    };
    first.par_iter().zip(&is_first).for_each(number);
    first.into_iter().map(AtomicU32::into_inner).collect()
}

#[cfg(test)]
pub(super) mod tests {
    use std::collections::HashMap;

    use super::*;

    /// Corners on a small grid, in an order that repeats places at once and after very many others, with both zeros.
    pub(crate) fn scattered(count: usize) -> Vec<DVec3> {
        let mut state = 1_u64;
        let mut next = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            ((state >> 40) % 41) as f64 - 20.0
        };
        let mut all = Vec::new();
        while all.len() < count {
            let p = DVec3::new(next(), next(), next());
            all.extend([p, -p, p]);
        }
        all.truncate(count);
        all
    }

    #[test]
    fn equal_corners_are_joined_whatever_their_number_and_order() {
        // More than a share, and many buckets.
        let corners = scattered(3 * 360_000);
        assert!(bits_for(corners.len()) > 3 && corners.len() > SHARE);
        let joined = joined_where_equal(corners.len(), |i| corners[i]);
        let mut known: HashMap<[u64; 3], u32> = HashMap::new();
        for (p, joined) in corners.iter().zip(&joined) {
            let number = known.len() as u32;
            let bits = (*p + DVec3::ZERO).to_array().map(f64::to_bits);
            assert_eq!(*known.entry(bits).or_insert(number), *joined, "{p}");
        }
        assert!(known.len() < corners.len() / 10);
    }
}
