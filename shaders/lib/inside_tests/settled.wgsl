// Whole numbers in place of winding numbers of closing triangles, where one is right for all points in a square of pixels: the winding number
// of a part there is a count less this number, rounded. Stored behind the lanes of the mask, of whose words the last ones are those of the
// first closing.

#define_import_path cutaway::settled

#import cutaway::local_winding::{square_count, square_of}

// In place of a number: the part encloses nothing there.
const NOTHING: i32 = 0x7fffffff;
// In place of a number: the square has no single one.
const UNSETTLED: u32 = 0x80000000u;

// Whether a part is filled at a point with a count and the number of its closing triangles.
fn is_filled(is_nonzero: bool, count: i32, number: i32) -> bool {
    let whole = count - number;
    return number != NOTHING && select((whole & 1) != 0, whole != 0, is_nonzero);
}

// Word of the number in a pixel's square, in a mask of `length` words: around its crossings, or at the near plane.
fn settled_at(length: u32, closing: u32, at: vec2<u32>, is_near: bool) -> u32 {
    return length - 2u * (closing + 1u) * square_count() + 2u * square_of(at) + select(0u, 1u, is_near);
}
