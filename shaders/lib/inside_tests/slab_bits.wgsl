// The bits of a lane until its pixel's crossings are known: bit 0 is the parity of the fragments behind the slab, the last bit that of all
// fragments, and two more bits are about fragments within the slab. `src/passes/draw/slabs.rs` makes lanes wide enough.

#define_import_path cutaway::slab_bits

// Distance from the end of a lane of the bit that is set if a fragment is within the slab, and of the bit that is set if one was lost.
const WITHIN_FROM_END: u32 = 2u;
const LOST_FROM_END: u32 = 3u;
