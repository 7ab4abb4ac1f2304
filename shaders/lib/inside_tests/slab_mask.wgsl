// Marks the lanes of samples that are classed by slabs (`slab_bits`). Bound as @group(1) @binding(4).

#define_import_path cutaway::slab_mask

#import cutaway::frame::pixel_count
#import cutaway::slab_bits::slab_count

@group(1) @binding(4) var<storage, read_write> mask: array<atomic<u32>>;

fn mark_slabs(pixel: u32, word: u32, shift: u32, lane_bits: u32, behind: u32) {
    atomicXor(&mask[word * pixel_count() + pixel], (behind | (1u << (lane_bits - 1u))) << shift);
}

fn mark_within(pixel: u32, word: u32, shift: u32, within: u32, is_lost: bool) {
    let bits = (within | (u32(is_lost) << slab_count())) << slab_count();
    atomicOr(&mask[word * pixel_count() + pixel], bits << shift);
}
