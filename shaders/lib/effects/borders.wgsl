// Borders: neighbouring samples that a stroke separates, and the stroke's class. A pixel's word has the class of the border to its
// right in bits 0-3 and of the one below it in bits 4-7; 0 is none. The words of all pixels are followed by one per tile, which is nonzero
// if the tile contains a border: most tiles have none.

#define_import_path cutaway::borders

#import cutaway::frame::pixel_count
#import cutaway::touched::{TILE_PX, tile_at}

const NO_BORDER: u32 = 0u;
// One side is background.
const OUTLINE: u32 = 1u;
// One side is a cap; the other has another kind or part.
const CUT: u32 = 2u;
// Between surfaces of two parts.
const PART: u32 = 3u;
// Between caps of one part by two clip-surfaces.
const FACE: u32 = 4u;
// The depth of one part jumps.
const CONTOUR: u32 = 5u;
// A surface is folded.
const CREASE: u32 = 6u;

// Index of a tile's word.
fn word_of_tile(tile: vec2<u32>) -> u32 {
    return pixel_count() + tile_at(tile);
}

// Greatest reach of strokes in pixels, and greatest number of tiles within that distance along one axis.
const MOST_REACH_PX: i32 = 96;
const MOST_TILES_AROUND: u32 = 14u;

fn tiles_around(at: vec2<u32>, reach_px: i32, size_px: vec2<u32>) -> vec4<u32> {
    let first = max(vec2<i32>(at) - reach_px, vec2<i32>(0));
    let last = min(vec2<i32>(at) + reach_px, vec2<i32>(size_px) - 1);
    return vec4<u32>(vec2<u32>(first), vec2<u32>(last)) / TILE_PX;
}

fn right_of(word: u32) -> u32 {
    return word & 15u;
}

fn below_of(word: u32) -> u32 {
    return (word >> 4u) & 15u;
}
