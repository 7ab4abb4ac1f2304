// Lists of sheet fragments in one buffer: how it is laid out. Bound as @group(1) @binding(6).
//
// First a word for each pixel, the last fragment that its list has got; then how many fragments came in all; then the fragments, each
// with its depth, its word (`sheet_words`) and the one before it in its list.

#define_import_path cutaway::sheet_pool

struct SheetPool {
    // Lists, and words before the number of fragments.
    lists: u32,
    // Fragments that there is room for.
    capacity: u32,
    padding: vec2<u32>,
}

@group(1) @binding(6) var<uniform> sheet_pool: SheetPool;

// What ends a list: nothing, or fragments that found no room.
const ENDS: u32 = 0xffffffffu;
const LOST: u32 = 0xfffffffeu;

// Where a fragment begins.
fn words_before(fragment: u32) -> u32 {
    return sheet_pool.lists + 1u + 3u * fragment;
}
