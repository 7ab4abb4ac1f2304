// The inside mask while it is made from stored fragments: an invocation owns its pixel, so no atomics are needed. Behind the planes of
// lanes is one more, which marks pixels whose answer is uncertain. Bound as @group(1) @binding(4).

#define_import_path cutaway::reduced

#import cutaway::frame::pixel_count
#import cutaway::lanes::MOST_LANE_WORDS

@group(1) @binding(4) var<storage, read_write> mask: array<u32>;

fn doubt_plane() -> u32 {
    return arrayLength(&mask) / pixel_count() - 1u;
}

fn clear_words(pixel: u32) {
    let last = min(doubt_plane(), MOST_LANE_WORDS);
    for (var word = 0u; word <= last; word++) {
        mask[word * pixel_count() + pixel] = 0u;
    }
}

fn toggle(pixel: u32, word: u32, bits: u32) {
    mask[word * pixel_count() + pixel] ^= bits;
}

// Toggles a bit of a lane that begins in this word.
fn toggle_bit(pixel: u32, word: u32, shift: u32, bit: u32) {
    toggle(pixel, word + bit / 32u, 1u << (shift + bit % 32u));
}

fn doubt(pixel: u32) {
    mask[doubt_plane() * pixel_count() + pixel] = 1u;
}
