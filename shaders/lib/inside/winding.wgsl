// The inside test `mask` if some part is filled by the nonzero rule: a crossing is inside such a part where the steps of the fragments
// behind it do not cancel. Other parts are tested by parity.

#define_import_path cutaway::inside

#import cutaway::cuts::parts
#import cutaway::lanes::{Lanes, MOST_LANES, WINDING}
#import cutaway::parity::{is_odd_at, is_odd_in_all, is_zero, word_at}
#import cutaway::winding::{count_at, may_exceed, sum_and_number}

// Whether no crossing of a pixel is inside anything, and nothing is in doubt.
fn is_blank(pixel: u32) -> bool {
    return is_zero(pixel);
}

fn is_inside(place: u32, pixel: u32, crossing: u32) -> bool {
    let part = parts[place];
    if part.lane_shift != WINDING {
        return is_odd_at(place, pixel, crossing);
    }
    return count_at(word_at(part.lane_word + 1u + crossing / 4u, pixel), crossing % 4u) != 0;
}

// Whether the ray of a pixel starts inside a part, judged by its fragments: a total that is not 0. If the ray cannot start there, this
// means that the mesh is open or its faces are oriented inconsistently.
fn starts_inside(lanes: Lanes, place: u32, pixel: u32) -> bool {
    let part = parts[place];
    if part.lane_shift != WINDING {
        return is_odd_in_all(lanes, place, pixel);
    }
    return sum_and_number(word_at(part.lane_word, pixel)).x != 0;
}

// The first part-table index, from `place` on, of a part that a crossing of a pixel is inside, or the number of parts.
fn next_inside(lanes: Lanes, place: u32, pixel: u32, crossing: u32) -> u32 {
    for (var p = place; p < min(lanes.count, MOST_LANES); p++) {
        if is_inside(p, pixel, crossing) {
            return p;
        }
    }
    return lanes.count;
}

// The first part-table index, from `place` on, of a part in which the pixel's ray starts, or the number of parts.
fn next_starting(lanes: Lanes, place: u32, pixel: u32) -> u32 {
    for (var p = place; p < min(lanes.count, MOST_LANES); p++) {
        if starts_inside(lanes, p, pixel) {
            return p;
        }
    }
    return lanes.count;
}

// Returns true if the answers for a pixel may be wrong because of too many fragments: a byte may have overflowed.
fn in_doubt(lanes: Lanes, pixel: u32) -> bool {
    for (var place = 0u; place < min(lanes.count, MOST_LANES); place++) {
        let part = parts[place];
        if part.lane_shift == WINDING && may_exceed(sum_and_number(word_at(part.lane_word, pixel))) {
            return true;
        }
    }
    return false;
}
