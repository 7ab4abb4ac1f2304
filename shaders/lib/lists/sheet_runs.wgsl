// Filled lists of sheet fragments, unordered. Bound as @group(1) @binding(5).

#define_import_path cutaway::sheet_runs

#import cutaway::sheet_pool::{LOST, sheet_pool, words_before}

@group(1) @binding(5) var<storage, read> sheets: array<u32>;

struct Fragment {
    z: f32,
    word: u32,
    // The fragment added to the list before this one, or an end marker.
    before: u32,
}

// The last fragment of a pixel's list, or an end marker.
fn last_of(pixel: u32) -> u32 {
    return sheets[pixel];
}

fn is_fragment(fragment: u32) -> bool {
    return fragment < LOST;
}

fn fragment_at(fragment: u32) -> Fragment {
    let first = words_before(fragment);
    return Fragment(bitcast<f32>(sheets[first]), sheets[first + 1u], sheets[first + 2u]);
}

// Most fragments of a list that are read: a longer list is marked. Each fragment is searched for among all, in quadratic time.
const MOST_SHEET_FRAGMENTS: u32 = 240u;

// The number of all fragments, stored or not.
fn fragment_count() -> u32 {
    return sheets[sheet_pool.lists];
}
