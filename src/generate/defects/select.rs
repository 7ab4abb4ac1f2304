//! Selection of faces: a seeded shuffle of all faces, patches grown from the first ones, and charts that partition the surface.

use std::collections::VecDeque;

use super::edit::ShadedFace;

/// A hash of a seed and a number (the finaliser of SplitMix64).
pub(super) fn mixed(seed: u64, number: u64) -> u64 {
    let mut h = seed
        .wrapping_add(1)
        .wrapping_mul(0x9E37_79B9_7F4A_7C15)
        .wrapping_add(number.wrapping_mul(0xD1B5_4A32_D192_ED03));
    h = (h ^ (h >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    h = (h ^ (h >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    h ^ (h >> 31)
}

/// A pseudo-random value in -1..1 from a seed and a number.
pub(super) fn signed(seed: u64, number: u64) -> f64 {
    let high = (mixed(seed, number) >> 32) as u32;
    f64::from(high) / f64::from(u32::MAX) * 2.0 - 1.0
}

/// All face indices in an order that depends only on the seed.
pub(super) fn shuffled(count: usize, seed: u64) -> Vec<u32> {
    let mut order: Vec<u32> = (0..count as u32).collect();
    order.sort_by_cached_key(|face| mixed(seed, u64::from(*face)));
    order
}

/// A share of a count, rounded to the nearest integer.
pub(super) fn share_of(count: usize, share: f64) -> usize {
    (count as f64 * share).round().clamp(0.0, count as f64) as usize
}

/// Edge adjacency of faces.
pub(super) struct Neighbours {
    /// Sorted pairs of an edge, given by its two vertices, and a face that has this edge.
    edges: Vec<([u32; 2], u32)>,
}

impl Neighbours {
    /// The neighbours of all faces.
    pub(super) fn of(faces: &[ShadedFace]) -> Self {
        let numbered = (0..).zip(faces);
        let mut edges: Vec<_> = numbered
            .flat_map(|(number, face)| edges_of(face).map(|edge| (edge, number)))
            .collect();
        edges.sort_unstable();
        Self { edges }
    }

    /// Faces that share an edge with a face, and the face itself.
    fn around(&self, face: &ShadedFace) -> impl Iterator<Item = u32> {
        edges_of(face).into_iter().flat_map(|edge| {
            let first = self.edges.partition_point(|(e, _)| *e < edge);
            let uses = self.edges[first..].iter();
            uses.take_while(move |(e, _)| *e == edge).map(|(_, f)| *f)
        })
    }
}

/// The edges of a face, the smaller vertex first.
pub(super) fn edges_of(face: &ShadedFace) -> [[u32; 2]; 3] {
    let [a, b, c] = face.corners;
    [[a, b], [b, c], [c, a]].map(|[p, q]| [p.min(q), p.max(q)])
}

/// A share of the faces: patches of `patch` faces connected by edges, centred on the first faces of the shuffled order.
/// With the same seed and patch size, a larger share includes every face of a smaller one.
pub(super) fn chosen(faces: &[ShadedFace], share: f64, patch: u32, seed: u64) -> Vec<bool> {
    let mut is_chosen = vec![false; faces.len()];
    let mut left = share_of(faces.len(), share);
    let neighbours = (patch > 1).then(|| Neighbours::of(faces));
    for middle in shuffled(faces.len(), seed) {
        if left == 0 {
            break;
        }
        if is_chosen[middle as usize] {
            continue;
        }
        let mut queue = VecDeque::from([middle]);
        let mut of_patch = 0;
        while let Some(face) = queue.pop_front() {
            if of_patch == patch || left == 0 {
                break;
            }
            if std::mem::replace(&mut is_chosen[face as usize], true) {
                continue;
            }
            (of_patch, left) = (of_patch + 1, left - 1);
            if let Some(neighbours) = &neighbours {
                queue.extend(neighbours.around(&faces[face as usize]));
            }
        }
    }
    is_chosen
}

/// The chart of each face. Charts grow from seed faces at equal speed until they meet; a connected component without a seed is a
/// chart of its own.
pub(super) fn charts(faces: &[ShadedFace], count: u32, seed: u64) -> Vec<u32> {
    const NONE: u32 = u32::MAX;
    let neighbours = Neighbours::of(faces);
    let mut chart = vec![NONE; faces.len()];
    let mut next = 0;
    let mut queue = VecDeque::new();
    let order = shuffled(faces.len(), seed);
    let (seeds, rest) = order.split_at(order.len().min(count as usize));
    let mut begin = |face: u32, chart: &mut [u32], queue: &mut VecDeque<u32>| {
        if chart[face as usize] == NONE {
            chart[face as usize] = next;
            next += 1;
            queue.push_back(face);
        }
    };
    for face in seeds {
        begin(*face, &mut chart, &mut queue);
    }
    for left in std::iter::once(None).chain(rest.iter().map(Some)) {
        if let Some(face) = left {
            begin(*face, &mut chart, &mut queue);
        }
        while let Some(face) = queue.pop_front() {
            for beside in neighbours.around(&faces[face as usize]) {
                if chart[beside as usize] == NONE {
                    chart[beside as usize] = chart[face as usize];
                    queue.push_back(beside);
                }
            }
        }
    }
    chart
}
