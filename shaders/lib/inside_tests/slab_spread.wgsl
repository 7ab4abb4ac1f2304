// Turns what a pixel's lanes hold about slabs into bits of its crossings: every crossing begins with the parity of the fragments behind the
// slab of its surface. Fragments within it follow in a pass of their own. All lanes of a word are turned at once. Bound as @group(1)
// @binding(4).

#define_import_path cutaway::slab_spread

#import cutaway::crossing_list::{List, word_of}
#import cutaway::frame::pixel_count
#import cutaway::lanes::{CROSSINGS_OF_A_WORD, MOST_LANE_WORDS, lowest_bits}
#import cutaway::slab_bits::{SlabBits, slab_bits}
#import cutaway::surfaces::surface_of

@group(1) @binding(4) var<storage, read_write> mask: array<u32>;

// What the lanes of a pixel hold together.
fn slab_bits_of(pixel: u32, lane_bits: u32) -> SlabBits {
    let words = min(arrayLength(&mask) / pixel_count(), MOST_LANE_WORDS);
    var any = 0u;
    for (var w = 0u; w < words; w++) {
        any |= mask[w * pixel_count() + pixel];
    }
    return slab_bits(any, lane_bits);
}

fn spread(list: ptr<function, List>, lane_bits: u32) {
    let count = min(min((*list).found, (*list).capacity), CROSSINGS_OF_A_WORD);
    let lowest = lowest_bits(lane_bits);
    let words = min(arrayLength(&mask) / pixel_count(), MOST_LANE_WORDS);
    for (var w = 0u; w < words; w++) {
        let at = w * pixel_count() + (*list).pixel;
        let word = mask[at];
        var turned = word & (lowest << (lane_bits - 1u));
        for (var i = 0u; i < count; i++) {
            turned |= ((word >> surface_of(word_of(list, i))) & lowest) << i;
        }
        mask[at] = turned;
    }
}
