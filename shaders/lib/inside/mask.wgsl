// The inside test `mask`: a crossing is inside a part where an odd number of its fragments lies behind.

#define_import_path cutaway::inside

#import cutaway::frame::pixel_index
#import cutaway::lanes::Lanes
#import cutaway::parity::{is_doubted, is_zero, next_odd}

// Whether no crossing of a pixel is inside anything, and nothing is in doubt.
fn is_blank(lanes: Lanes, at: vec2<u32>) -> bool {
    return is_zero(pixel_index(at));
}

// The first part-table index, from `place` on, of a part that a crossing of a pixel is inside, or the number of parts.
fn next_inside(lanes: Lanes, place: u32, at: vec2<u32>, crossing: u32) -> u32 {
    return next_odd(lanes, place, pixel_index(at), crossing);
}

// The first part-table index, from `place` on, of a part in which the pixel's ray starts, judged by its fragments: an odd total. If the ray
// cannot start in a part, an odd total means that the mesh is open.
fn next_starting(lanes: Lanes, place: u32, at: vec2<u32>) -> u32 {
    return next_odd(lanes, place, pixel_index(at), lanes.bits - 1u);
}

// Whether the answers for a pixel may be wrong because a buffer overflowed.
fn in_doubt(lanes: Lanes, at: vec2<u32>) -> bool {
    return is_doubted(lanes, pixel_index(at));
}
