// Lists of sheet fragments in one buffer: the layout. Bound as @group(1) @binding(6).
//
// First one word per pixel: the fragment last added to its list; then the number of all fragments; then the fragments, each with its depth,
// its word (`sheet_words`) and the previous fragment of its list.

#define_import_path cutaway::sheet_pool

struct SheetPool {
    // Number of lists, which is also the number of words before the fragment count.
    lists: u32,
    // Capacity in fragments.
    capacity: u32,
    padding: vec2<u32>,
}

@group(1) @binding(6) var<uniform> sheet_pool: SheetPool;

// Marks the end of a list, or that its further fragments exceeded the capacity.
const ENDS: u32 = 0xffffffffu;
const LOST: u32 = 0xfffffffeu;

// Index of a fragment's first word.
fn words_before(fragment: u32) -> u32 {
    return sheet_pool.lists + 1u + 3u * fragment;
}
