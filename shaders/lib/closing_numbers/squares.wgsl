// Numbers of closing triangles where they are settled for a square of pixels, by `strategies/inside/winding/expand`.

#define_import_path cutaway::closing_numbers

#import cutaway::closings::NO_CLOSING
#import cutaway::cuts::parts
#import cutaway::lanes::{Lanes, MOST_LANES}
#import cutaway::parity::mask
#import cutaway::settled::{NOTHING, UNSETTLED, settled_at}

// A number, 0 for a part that is closed, and where the mask already holds what is decided pixel by pixel.
fn number_at(closing: u32, at: vec2<u32>, is_near: bool) -> i32 {
    if closing == NO_CLOSING {
        return 0;
    }
    let number = mask[settled_at(arrayLength(&mask), closing, at, is_near)];
    return select(bitcast<i32>(number), 0, number == UNSETTLED);
}

// The number around the crossings of a pixel at which a part begins to be kept.
fn number_around(closing: u32, at: vec2<u32>) -> i32 {
    return number_at(closing, at, false);
}

// The number where the ray of a pixel starts.
fn number_near(closing: u32, at: vec2<u32>) -> i32 {
    return number_at(closing, at, true);
}

// Whether no part has a number at a pixel.
fn is_without(lanes: Lanes, at: vec2<u32>) -> bool {
    for (var place = 0u; place < min(lanes.count, MOST_LANES); place++) {
        let closing = parts[place].closing;
        let numbers = vec2<i32>(number_around(closing, at), number_near(closing, at));
        if any(numbers != vec2<i32>(0) & numbers != vec2<i32>(NOTHING)) {
            return false;
        }
    }
    return true;
}
