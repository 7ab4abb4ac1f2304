// Lanes of bits while they are read: bit i of a lane is set if crossing i has an odd number of fragments behind it, the top bit if the
// total is odd. A mask made from bounded buffers has one more plane behind the lanes, nonzero where a buffer overflowed. Bound as @group(1)
// @binding(2).

#define_import_path cutaway::parity

#import cutaway::cuts::parts
#import cutaway::frame::pixel_count
#import cutaway::lanes::{Lanes, MOST_LANES, MOST_LANE_WORDS, lowest_bits}

@group(1) @binding(2) var<storage, read> mask: array<u32>;

// A word of a pixel.
fn word_at(word: u32, pixel: u32) -> u32 {
    return mask[word * pixel_count() + pixel];
}

// The bits that any word of a pixel has.
fn all_bits(pixel: u32) -> u32 {
    let words = min(arrayLength(&mask) / pixel_count(), MOST_LANE_WORDS + 1u);
    var any = 0u;
    for (var w = 0u; w < words; w++) {
        any |= word_at(w, pixel);
    }
    return any;
}

// True if all words of a pixel are zero.
fn is_zero(pixel: u32) -> bool {
    return all_bits(pixel) == 0u;
}

// True if a bit of a part's lane is set.
fn is_odd_at(place: u32, pixel: u32, bit: u32) -> bool {
    let word = word_at(parts[place].lane_word + bit / 32u, pixel);
    return ((word >> (parts[place].lane_shift + bit % 32u)) & 1u) != 0u;
}

fn is_odd_in_all(lanes: Lanes, place: u32, pixel: u32) -> bool {
    return is_odd_at(place, pixel, lanes.bits - 1u);
}

// The first part-table index, from `place` on, whose lane has a bit set, or the number of lanes: word by word, because most words are zero
// if there are many parts. Used only if all lanes are consecutive bits.
fn next_odd(lanes: Lanes, place: u32, pixel: u32, bit: u32) -> u32 {
    if lanes.bits > 32u {
        let words = lanes.bits / 32u;
        for (var p = place; p < min(lanes.count, MOST_LANES); p++) {
            if ((word_at(p * words + bit / 32u, pixel) >> (bit % 32u)) & 1u) != 0u {
                return p;
            }
        }
        return lanes.count;
    }
    let of_word = 32u / lanes.bits;
    // The bit `bit` of every lane in a word.
    let pattern = lowest_bits(lanes.bits) << bit;
    let end = min((lanes.count + of_word - 1u) / of_word, MOST_LANE_WORDS);
    let first = place / of_word;
    for (var w = first; w < end; w++) {
        let passed = select(0u, (place % of_word) * lanes.bits, w == first);
        let found = word_at(w, pixel) & pattern & (0xffffffffu << passed);
        if found != 0u {
            return w * of_word + firstTrailingBit(found) / lanes.bits;
        }
    }
    return lanes.count;
}

// True if the mask marks a buffer overflow. Used only if all lanes are bits.
fn is_doubted(lanes: Lanes, pixel: u32) -> bool {
    // Lanes are a power of two wide, or whole words: either way no lane straddles two shared words.
    let plane = (lanes.count * lanes.bits + 31u) / 32u;
    let word = plane * pixel_count() + pixel;
    return word < arrayLength(&mask) && mask[word] != 0u;
}
