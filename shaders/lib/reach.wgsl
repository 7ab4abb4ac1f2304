// Between which depths the cut parts lie, by tile of the picture: bits of the greatest depth-buffer value of their triangles, and of the
// least those of its complement, so that both only grow and 0 is nothing. The first pair is that of triangles that may be anywhere.

#define_import_path cutaway::reach

#import cutaway::frame::frame

// Pixels along a side of a tile.
const TILE_PX: u32 = 16u;

fn tiles_of_row() -> u32 {
    return (frame.size_px.x + TILE_PX - 1u) / TILE_PX;
}

// How many pairs there are.
fn reach_count() -> u32 {
    return 1u + tiles_of_row() * ((frame.size_px.y + TILE_PX - 1u) / TILE_PX);
}

// The pair of a tile.
fn tile_at(tile: vec2<u32>) -> u32 {
    return 1u + tile.y * tiles_of_row() + tile.x;
}
