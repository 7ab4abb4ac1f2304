// The inside mask while it is written: one lane of bits per part, packed in words. Bound as @group(1) @binding(4).

#define_import_path cutaway::mask

#import cutaway::frame::pixel_count
#import cutaway::lanes::{MOST_CROSSINGS, MOST_LANE_WORDS, thermometer}

@group(1) @binding(4) var<storage, read_write> mask: array<atomic<u32>>;

fn clear(pixel: u32) {
    let words = min(arrayLength(&mask) / pixel_count(), MOST_LANE_WORDS);
    for (var w = 0u; w < words; w++) {
        atomicStore(&mask[w * pixel_count() + pixel], 0u);
    }
}

// A fragment with `behind` crossings in front toggles the bits of these crossings in its lane (the thermometer), and the top bit, which
// ends as the parity of all fragments. In a lane of several words only words with bits to toggle are accessed.
fn add_fragment(pixel: u32, word: u32, shift: u32, lane_bits: u32, behind: u32) {
    let total = 1u << ((lane_bits - 1u) % 32u);
    var last = word;
    if lane_bits > 32u {
        last += lane_bits / 32u - 1u;
        let below = min((min(behind, MOST_CROSSINGS) + 31u) / 32u, lane_bits / 32u - 1u);
        for (var w = 0u; w < below; w++) {
            atomicXor(&mask[(word + w) * pixel_count() + pixel], thermometer(behind, w));
        }
    }
    atomicXor(&mask[last * pixel_count() + pixel], (thermometer(behind, last - word) | total) << shift);
}
