// Turns what a pixel's lanes hold about the slab into bits of its crossings: every crossing begins with the parity of the fragments behind
// the slab. Fragments within the slab follow in a pass of their own. All lanes of a word are turned at once. Bound as @group(1) @binding(4).

#define_import_path cutaway::slab_spread

#import cutaway::crossing_list::List
#import cutaway::frame::pixel_count
#import cutaway::lanes::{CROSSINGS_OF_A_WORD, MOST_LANE_WORDS, lowest_bits}
#import cutaway::slab_bits::{LOST_FROM_END, WITHIN_FROM_END}

@group(1) @binding(4) var<storage, read_write> mask: array<u32>;

// True if no crossing after the first that enters the kept region can matter in a pixel: no fragment is within the slab, so that all
// crossings are inside the same parts.
fn is_first_enough(pixel: u32, lane_bits: u32) -> bool {
    let words = min(arrayLength(&mask) / pixel_count(), MOST_LANE_WORDS);
    var any = 0u;
    for (var w = 0u; w < words; w++) {
        any |= mask[w * pixel_count() + pixel];
    }
    return (any & (lowest_bits(lane_bits) << (lane_bits - WITHIN_FROM_END))) == 0u;
}

fn spread(list: ptr<function, List>, lane_bits: u32) {
    let count = min(min((*list).found, (*list).capacity), CROSSINGS_OF_A_WORD);
    let lowest = lowest_bits(lane_bits);
    let words = min(arrayLength(&mask) / pixel_count(), MOST_LANE_WORDS);
    for (var w = 0u; w < words; w++) {
        let at = w * pixel_count() + (*list).pixel;
        let word = mask[at];
        let total = word & (lowest << (lane_bits - 1u));
        // A product, because the bits of different lanes do not meet.
        mask[at] = total | ((word & lowest) * ((1u << count) - 1u));
        if (word & (lowest << (lane_bits - LOST_FROM_END))) != 0u {
            (*list).cut_short = true;
        }
    }
}
