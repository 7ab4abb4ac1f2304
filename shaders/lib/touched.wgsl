// Which tiles of the picture a frame touches, and between which depths its cut parts lie in each: how it is laid out. `touched_list` reads
// it, `touching` writes it. Bound as @group(2) @binding(7).
//
// What is in no touched tile is background, and is not looked at. The list outlives its frame: the next one sets back to background what
// is in it (`passes/rasterise/blank.wgsl`), and nothing else.

#define_import_path cutaway::touched

#import cutaway::frame::{depth_from_buffer, frame}

// Pixels along a side of a tile.
const TILE_PX: u32 = 16u;

// Inputs of the background of a picture; all zero before the first.
struct Blank {
    size_px: vec2<u32>,
    band: vec2<u32>,
    // Bits of the depth of what is infinitely far.
    depth: u32,
    // What is kept as background, not 0.
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

// Number of the tile at a place in units of tiles.
fn tile_at(place: vec2<u32>) -> u32 {
    return place.y * tiles_of_row() + place.x;
}

// Tiles that one workgroup takes, at most: `src/passes/frame/touched.rs` gives each eight, and one more where they do not go up.
const MOST_TURNS: u32 = 16u;

// How many of `count` tiles a workgroup takes, where of N workgroups each takes every N-th.
fn turns_among(count: u32, group: u32, groups: u32) -> u32 {
    return min((count + groups - 1u - group) / groups, MOST_TURNS);
}

// The place of a tile. By floats, which are exact here: integers divide slowly.
fn place_of(tile: u32) -> vec2<u32> {
    let row = u32((f32(tile) + 0.5) / f32(tiles_of_row()));
    return vec2<u32>(tile - row * tiles_of_row(), row);
}

// The pixel at a place in a tile, maybe outside of the picture.
fn pixel_in(tile: u32, local: vec2<u32>) -> vec2<u32> {
    return place_of(tile) * TILE_PX + local;
}
