// The picture tiles that a frame touches, and the depth range of the cut parts in each: the layout of the list. `touched_list` reads it,
// `touching` writes it. Bound as @group(2) @binding(7).
//
// Everything outside the touched tiles is background, and is skipped. The list persists after its frame: the next frame resets the tiles in
// it to background (`passes/rasterise/blank.wgsl`), and no others.

#define_import_path cutaway::touched

#import cutaway::frame::{depth_from_buffer, frame}

// Side of a tile in pixels.
const TILE_PX: u32 = 16u;

// Inputs of a picture's background; all zero before the first frame.
struct Blank {
    size_px: vec2<u32>,
    band: vec2<u32>,
    // Bits of the depth value at infinity.
    depth: u32,
    // Kind of background that is kept; never 0.
    kind: u32,
}

fn blank_of_frame(kind: u32) -> Blank {
    return Blank(frame.size_px, frame.band, bitcast<u32>(depth_from_buffer(0.0)), kind);
}

fn tiles_of_row() -> u32 {
    return (frame.size_px.x + TILE_PX - 1u) / TILE_PX;
}

fn tile_count() -> u32 {
    return tiles_of_row() * ((frame.size_px.y + TILE_PX - 1u) / TILE_PX);
}

// Number of the tile at a position in tiles.
fn tile_at(place: vec2<u32>) -> u32 {
    return place.y * tiles_of_row() + place.x;
}

// Most tiles per workgroup: `src/passes/frame/touched.rs` gives each eight, and one more if the division leaves a remainder.
const MOST_TURNS: u32 = 16u;

// Number of tiles, out of `count`, that a workgroup processes if each of N workgroups takes every N-th tile.
fn turns_among(count: u32, group: u32, groups: u32) -> u32 {
    return min((count + groups - 1u - group) / groups, MOST_TURNS);
}

// The position of a tile, in tiles. In floats, which are exact here: integer division is slow.
fn place_of(tile: u32) -> vec2<u32> {
    let row = u32((f32(tile) + 0.5) / f32(tiles_of_row()));
    return vec2<u32>(tile - row * tiles_of_row(), row);
}

// The pixel at a position in a tile, possibly outside the picture.
fn pixel_in(tile: u32, local: vec2<u32>) -> vec2<u32> {
    return place_of(tile) * TILE_PX + local;
}
