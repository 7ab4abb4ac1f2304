// The inside mask while it is read: bit i of a lane says whether crossing i is inside the part, the top bit whether the total of
// its fragments is odd. A mask that was made from something bounded has one more plane behind the lanes, not zero where some of
// that did not fit. Bound as @group(1) @binding(2).

#define_import_path cutaway::inside

#import cutaway::cuts::parts
#import cutaway::frame::pixel_count
#import cutaway::lanes::Lanes

@group(1) @binding(2) var<storage, read> mask: array<u32>;

// The lane of a part, aligned to bit 0.
fn lane_of(lanes: Lanes, place: u32, pixel: u32) -> u32 {
    let word = mask[parts[place].lane_word * pixel_count() + pixel];
    return (word >> parts[place].lane_shift) & (0xffffffffu >> (32u - lanes.bits));
}

// Whether a crossing of a pixel is inside a part.
fn is_inside(lanes: Lanes, place: u32, pixel: u32, crossing: u32) -> bool {
    return ((lane_of(lanes, place, pixel) >> crossing) & 1u) != 0u;
}

// Whether the ray of a pixel starts inside a part, as far as its fragments tell: an odd total. Where no part can be there, it
// says that the mesh is open.
fn starts_inside(lanes: Lanes, place: u32, pixel: u32) -> bool {
    return (lane_of(lanes, place, pixel) >> (lanes.bits - 1u)) != 0u;
}

// Whether the answers for a pixel may be wrong because something found no room.
fn in_doubt(lanes: Lanes, pixel: u32) -> bool {
    let lanes_per_word = 32u / lanes.bits;
    let plane = (lanes.count + lanes_per_word - 1u) / lanes_per_word;
    let word = plane * pixel_count() + pixel;
    return word < arrayLength(&mask) && mask[word] != 0u;
}
