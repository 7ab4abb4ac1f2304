// Any number of parts: a triangle's part is found by bisection.

#define_import_path cutaway::rows

#import cutaway::sweep::{drawn_parts, sweep}

// Row of the part to which a triangle belongs.
fn row_of_triangle(triangle: u32) -> u32 {
    var row = 0u;
    for (var i = 0u; i < min(sweep.search_steps, 10u); i++) {
        let ahead = row + (1u << (sweep.search_steps - 1u - i));
        if drawn_parts.parts[ahead].first_triangle <= triangle {
            row = ahead;
        }
    }
    return row;
}
