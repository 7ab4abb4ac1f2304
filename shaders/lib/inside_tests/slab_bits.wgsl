// The bits of a lane until its pixel's crossings are known. With N clip-surfaces bits 0 to N - 1 are the parities of the fragments behind
// their slabs; bits N to 2 N - 1 are set if a fragment is within the slab, bit 2 N if such a fragment was lost; and the last bit is the
// parity of all fragments. `src/passes/draw/slabs.rs` makes lanes wide enough.

#define_import_path cutaway::slab_bits

#import cutaway::cuts::cut_table
#import cutaway::planes::MOST_PLANES

struct SlabBits {
    odd: u32,
    within: u32,
    is_lost: bool,
    is_total_odd: bool,
}

fn slab_count() -> u32 {
    return min(cut_table.surface_count, MOST_PLANES);
}

// What the lanes of a word hold together.
fn slab_bits(word: u32, lane_bits: u32) -> SlabBits {
    var bits = word;
    bits |= select(0u, bits >> 16u, lane_bits <= 16u);
    bits |= select(0u, bits >> 8u, lane_bits <= 8u);
    bits |= select(0u, bits >> 4u, lane_bits <= 4u);
    let count = slab_count();
    let all = (1u << count) - 1u;
    return SlabBits(
        bits & all,
        (bits >> count) & all,
        ((bits >> (2u * count)) & 1u) != 0u,
        ((bits >> (lane_bits - 1u)) & 1u) != 0u,
    );
}
