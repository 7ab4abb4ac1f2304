// The touched tiles, while they are sought. Each is added to the list when first encountered; the order is arbitrary, and has no effect.

#define_import_path cutaway::touching

#import cutaway::touched::{Blank, TILE_PX, tile_at}

// As in `touched_list`.
struct Tile {
    listed: u32,
    is_touched: atomic<u32>,
    nearest: atomic<u32>,
    farthest: atomic<u32>,
}

struct Touched {
    count: atomic<u32>,
    anywhere: atomic<u32>,
    nearest: atomic<u32>,
    farthest: atomic<u32>,
    blank: Blank,
    tiles: array<Tile>,
}

@group(2) @binding(7) var<storage, read_write> touched: Touched;

fn touch_tile(tile: u32) {
    if atomicLoad(&touched.tiles[tile].is_touched) == 0u && atomicExchange(&touched.tiles[tile].is_touched, 1u) == 0u {
        let place = atomicAdd(&touched.count, 1u);
        touched.tiles[place].listed = tile;
    }
}

// Side in tiles of the largest box that one invocation touches.
const MOST_SIDE: u32 = 6u;

// The tiles that a pixel box of the picture covers: the first tile, and the number along each axis.
struct Box {
    first: vec2<u32>,
    size: vec2<u32>,
}

fn box_of(first: vec2<i32>, last: vec2<i32>) -> Box {
    let first_tile = vec2<u32>(first) / TILE_PX;
    return Box(first_tile, min(vec2<u32>(last) / TILE_PX - first_tile + 1u, vec2<u32>(MOST_SIDE)));
}

// Touches the tiles that a pixel box of the picture covers. The box has at most 65 pixels a side.
fn touch_box(first: vec2<i32>, last: vec2<i32>) {
    let box = box_of(first, last);
    for (var y = 0u; y < box.size.y; y++) {
        for (var x = 0u; x < box.size.x; x++) {
            touch_tile(tile_at(box.first + vec2<u32>(x, y)));
        }
    }
}

// Widens a tile's depth range, with depths in the stored encoding.
fn widen(tile: u32, nearest: u32, farthest: u32) {
    if nearest > atomicLoad(&touched.tiles[tile].nearest) {
        atomicMax(&touched.tiles[tile].nearest, nearest);
    }
    if farthest > atomicLoad(&touched.tiles[tile].farthest) {
        atomicMax(&touched.tiles[tile].farthest, farthest);
    }
}

// The nearest and the farthest of three depth-buffer values, in the stored encoding.
fn reach_of(z: vec3<f32>) -> vec2<u32> {
    let nearest = max(max(z.x, max(z.y, z.z)), 0.0);
    let farthest = max(min(z.x, min(z.y, z.z)), 0.0);
    return vec2<u32>(bitcast<u32>(nearest), ~bitcast<u32>(farthest));
}

// Touches the tiles that the box of a triangle's pixels covers, and widens their depth ranges by the depth-buffer values `z` of its corners if
// its part is cut. The box has at most 65 pixels a side.
fn touch_box_at_depths(first: vec2<i32>, last: vec2<i32>, z: vec3<f32>, is_cut: bool) {
    let box = box_of(first, last);
    let reach = reach_of(z);
    for (var y = 0u; y < box.size.y; y++) {
        for (var x = 0u; x < box.size.x; x++) {
            let tile = tile_at(box.first + vec2<u32>(x, y));
            touch_tile(tile);
            if is_cut {
                widen(tile, reach.x, reach.y);
            }
        }
    }
}
