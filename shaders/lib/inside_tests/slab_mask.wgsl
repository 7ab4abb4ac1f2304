// Marks the lanes of samples that are classed by a slab (`slab_bits`). Bound as @group(1) @binding(4).

#define_import_path cutaway::slab_mask

#import cutaway::frame::pixel_count
#import cutaway::slab_bits::{LOST_FROM_END, WITHIN_FROM_END}

@group(1) @binding(4) var<storage, read_write> mask: array<atomic<u32>>;

fn mark_slab(pixel: u32, word: u32, shift: u32, lane_bits: u32, is_behind: bool) {
    atomicXor(&mask[word * pixel_count() + pixel], (u32(is_behind) | (1u << (lane_bits - 1u))) << shift);
}

fn mark_within(pixel: u32, word: u32, shift: u32, lane_bits: u32, is_lost: bool) {
    let bits = (1u << (lane_bits - WITHIN_FROM_END)) | (u32(is_lost) << (lane_bits - LOST_FROM_END));
    atomicOr(&mask[word * pixel_count() + pixel], bits << shift);
}
