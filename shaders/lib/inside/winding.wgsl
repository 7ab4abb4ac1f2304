// The inside test of parts whose lane holds counts: parts filled by the nonzero rule, and open parts. A crossing is inside where the steps of
// the fragments behind it, less the number of the part's closing triangles, pass the part's fill rule. Other parts are tested by parity.

#define_import_path cutaway::inside

#import cutaway::closing_numbers::{is_without, number_around, number_near}
#import cutaway::cuts::parts
#import cutaway::frame::pixel_index
#import cutaway::lanes::{Lanes, MOST_LANES, WINDING}
#import cutaway::parity::{is_odd_at, is_odd_in_all, is_zero, word_at}
#import cutaway::settled::is_filled
#import cutaway::winding::{count_at, may_exceed, sum_and_number}

// Whether no crossing of a pixel is inside anything, and nothing is in doubt.
fn is_blank(lanes: Lanes, at: vec2<u32>) -> bool {
    return is_zero(pixel_index(at)) && is_without(lanes, at);
}

fn is_inside(place: u32, at: vec2<u32>, crossing: u32) -> bool {
    let part = parts[place];
    if part.lane_shift != WINDING {
        return is_odd_at(place, pixel_index(at), crossing);
    }
    let count = count_at(word_at(part.lane_word + 1u + crossing / 4u, pixel_index(at)), crossing % 4u);
    return is_filled(part.is_nonzero != 0u, count, number_around(part.closing, at));
}

// Whether the ray of a pixel starts inside a part, judged by its fragments: a total that is filled. If the ray cannot start there, this means
// that faces are oriented inconsistently, or that the mesh is open.
fn starts_inside(lanes: Lanes, place: u32, at: vec2<u32>) -> bool {
    let part = parts[place];
    if part.lane_shift != WINDING {
        return is_odd_in_all(lanes, place, pixel_index(at));
    }
    let total = sum_and_number(word_at(part.lane_word, pixel_index(at))).x;
    return is_filled(part.is_nonzero != 0u, total, number_near(part.closing, at));
}

// The first part-table index, from `place` on, of a part that a crossing of a pixel is inside, or the number of parts.
fn next_inside(lanes: Lanes, place: u32, at: vec2<u32>, crossing: u32) -> u32 {
    for (var p = place; p < min(lanes.count, MOST_LANES); p++) {
        if is_inside(p, at, crossing) {
            return p;
        }
    }
    return lanes.count;
}

// The first part-table index, from `place` on, of a part in which the pixel's ray starts, or the number of parts.
fn next_starting(lanes: Lanes, place: u32, at: vec2<u32>) -> u32 {
    for (var p = place; p < min(lanes.count, MOST_LANES); p++) {
        if starts_inside(lanes, p, at) {
            return p;
        }
    }
    return lanes.count;
}

// Returns true if the answers for a pixel may be wrong because of too many fragments: a byte may have overflowed.
fn in_doubt(lanes: Lanes, at: vec2<u32>) -> bool {
    for (var place = 0u; place < min(lanes.count, MOST_LANES); place++) {
        let part = parts[place];
        if part.lane_shift == WINDING && may_exceed(sum_and_number(word_at(part.lane_word, pixel_index(at)))) {
            return true;
        }
    }
    return false;
}
