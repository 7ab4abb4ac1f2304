// Lanes of bits while they are read: bit i of a lane says whether crossing i has an odd number of fragments behind it, the top
// bit whether the total is odd. A mask that was made from something bounded has one more plane behind the lanes, not zero where
// some of that did not fit. Bound as @group(1) @binding(2).

#define_import_path cutaway::parity

#import cutaway::cuts::parts
#import cutaway::frame::pixel_count
#import cutaway::lanes::Lanes

@group(1) @binding(2) var<storage, read> mask: array<u32>;

// A word of a pixel.
fn word_at(word: u32, pixel: u32) -> u32 {
    return mask[word * pixel_count() + pixel];
}

// The lane of a part, aligned to bit 0.
fn lane_of(lanes: Lanes, place: u32, pixel: u32) -> u32 {
    let word = word_at(parts[place].lane_word, pixel);
    return (word >> parts[place].lane_shift) & (0xffffffffu >> (32u - lanes.bits));
}

fn is_odd_at(lanes: Lanes, place: u32, pixel: u32, crossing: u32) -> bool {
    return ((lane_of(lanes, place, pixel) >> crossing) & 1u) != 0u;
}

fn is_odd_in_all(lanes: Lanes, place: u32, pixel: u32) -> bool {
    return (lane_of(lanes, place, pixel) >> (lanes.bits - 1u)) != 0u;
}

// Whether the mask says that something found no room. Asked only where all lanes are bits.
fn is_doubted(lanes: Lanes, pixel: u32) -> bool {
    let lanes_per_word = 32u / lanes.bits;
    let plane = (lanes.count + lanes_per_word - 1u) / lanes_per_word;
    let word = plane * pixel_count() + pixel;
    return word < arrayLength(&mask) && mask[word] != 0u;
}
