// The inside test `mask`: a crossing is inside a part where an odd number of its fragments lies behind.

#define_import_path cutaway::inside

#import cutaway::lanes::Lanes
#import cutaway::parity::{is_doubted, is_odd_at, is_odd_in_all, is_zero}

// Whether no crossing of a pixel is inside anything, and nothing is in doubt.
fn is_blank(pixel: u32) -> bool {
    return is_zero(pixel);
}

// Whether a crossing of a pixel is inside a part.
fn is_inside(lanes: Lanes, place: u32, pixel: u32, crossing: u32) -> bool {
    return is_odd_at(place, pixel, crossing);
}

// Whether the ray of a pixel starts inside a part, as far as its fragments tell: an odd total. Where no part can be there, it
// says that the mesh is open.
fn starts_inside(lanes: Lanes, place: u32, pixel: u32) -> bool {
    return is_odd_in_all(lanes, place, pixel);
}

// Whether the answers for a pixel may be wrong because something found no room.
fn in_doubt(lanes: Lanes, pixel: u32) -> bool {
    return is_doubted(lanes, pixel);
}
