// The touched tiles while they are found. Each goes to the list when it is met first; in which order is left to chance, and nothing
// hangs on it.

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

// Touches the tiles of a box of pixels of the picture.
fn touch_box(first: vec2<i32>, last: vec2<i32>) {
    let first_tile = vec2<u32>(first) / TILE_PX;
    let last_tile = vec2<u32>(last) / TILE_PX;
    for (var y = first_tile.y; y <= last_tile.y; y++) {
        for (var x = first_tile.x; x <= last_tile.x; x++) {
            touch_tile(tile_at(vec2<u32>(x, y)));
        }
    }
}
