// The nearest fragments per pixel and part: a plane of counts, then a plane for the nearest, the next, and so on. Depth-buffer values are
// stored as bits, which sort like the values; 0 is an empty slot. Bound as @group(1) @binding(6).

#define_import_path cutaway::cascade

#import cutaway::frame::pixel_count

// Most fragments stored per pixel and part.
const MOST_SLOTS: u32 = 32u;

struct Cascade {
    // Slots per pixel and part.
    slots: u32,
    // Number of parts.
    lanes: u32,
    padding: vec2<u32>,
}

@group(1) @binding(6) var<uniform> cascade: Cascade;

// Word that counts a part's fragments in a pixel; its slots follow at intervals of one plane.
fn first_word(place: u32, pixel: u32) -> u32 {
    return place * (cascade.slots + 1u) * pixel_count() + pixel;
}
