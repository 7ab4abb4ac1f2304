// Layout of a screen's queue, in words: the number of queued triangles; the number of triangles to visit again; a range with two words for
// each queued triangle, from the front, and one for each to visit again, from the back; then the first piece of each queued triangle.
//
// A triangle is queued or visited again, never both, so two words per triangle and one more word per triangle behind them suffice.

#define_import_path cutaway::queue

#import cutaway::pieces::Pieces

// Words before the queued triangles.
const HEAD: u32 = 2u;
// Bit of a queued triangle that crosses the near plane or the guard band.
const CLIPPED: u32 = 0x80000000u;

// The two words of a queued triangle: its number and CLIPPED; the first row of tiles of its pieces, and the number of pieces per row.
fn queued_at(place: u32) -> u32 {
    return HEAD + 2u * place;
}

fn again_at(place: u32, triangle_count: u32) -> u32 {
    return HEAD + 2u * triangle_count - 1u - place;
}

fn first_piece_at(place: u32, triangle_count: u32) -> u32 {
    return HEAD + 2u * triangle_count + place;
}

fn packed(pieces: Pieces) -> u32 {
    return u32(pieces.first_row) | (u32(pieces.columns) << 16u);
}

fn first_row_of(word: u32) -> u32 {
    return word & 0xffffu;
}

fn columns_of(word: u32) -> u32 {
    return word >> 16u;
}
