// Lists of sheet fragments once they are filled, in no order. Bound as @group(1) @binding(5).

#define_import_path cutaway::sheet_runs

#import cutaway::sheet_pool::{LOST, sheet_pool, words_before}

@group(1) @binding(5) var<storage, read> sheets: array<u32>;

struct Fragment {
    z: f32,
    word: u32,
    // The one before it in its list, or what ends that.
    before: u32,
}

// The last fragment of a pixel's list, or what ends that.
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

// Fragments of a list that are looked at: a longer one is marked. Each is looked for among all, so that the rounds are its square.
const MOST_SHEET_FRAGMENTS: u32 = 240u;

// How many came in all, whether they found room or not.
fn fragment_count() -> u32 {
    return sheets[sheet_pool.lists];
}
