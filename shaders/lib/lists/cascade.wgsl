// The nearest fragments of each pixel and part: a plane that counts all, then a plane for the nearest, the next, and so on.
// Depth-buffer values are kept as bits, which order as the values do; 0 is an empty slot. Bound as @group(1) @binding(6).

#define_import_path cutaway::cascade

#import cutaway::frame::pixel_count

// Fragments that are kept of a pixel and part, at most.
const MOST_SLOTS: u32 = 32u;

struct Cascade {
    // How many are kept of each pixel and part.
    slots: u32,
    // Parts.
    lanes: u32,
    padding: vec2<u32>,
}

@group(1) @binding(6) var<uniform> cascade: Cascade;

// Word that counts the fragments of a part in a pixel; its slots follow, a plane apart each.
fn first_word(place: u32, pixel: u32) -> u32 {
    return place * (cascade.slots + 1u) * pixel_count() + pixel;
}
