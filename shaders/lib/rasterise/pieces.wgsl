// Pieces: how a triangle with many samples is divided among workgroups.
//
// Tiles have 64 x 64 samples. A row of tiles that the triangle's box meets is one piece. If the triangle is wide, it is several, which
// take its tiles in turn, so that a line of samples in a piece is at most `piece_px` plus three tiles long, for any triangle and picture.
// Thin triangles have few samples in a large box, so the number of pieces follows from the triangle's own width: its largest horizontal
// extent, which is twice its area divided by its height.

#define_import_path cutaway::pieces

#import cutaway::screen::{first_pixel, last_pixel}

struct Pieces {
    first_row: i32,
    // Rows of tiles; 0 if the box holds no sample.
    rows: i32,
    // Pieces per row.
    columns: i32,
}

fn piece_count(pieces: Pieces) -> u32 {
    return u32(pieces.rows * pieces.columns);
}

// The pieces of a box in steps, whose content is at most `width_px` wide.
fn pieces_of(low: vec2<i32>, high: vec2<i32>, width_px: f32, piece_px: f32) -> Pieces {
    let first = first_pixel(low);
    let last = last_pixel(high);
    if any(first > last) {
        return Pieces(0, 0, 0);
    }
    let tiles = (last >> vec2<u32>(6u)) - (first >> vec2<u32>(6u)) + 1;
    let columns = 1 + i32(min(width_px, f32(64 * tiles.x)) / piece_px);
    return Pieces(first.y >> 6u, tiles.y, min(columns, tiles.x));
}
