// Lists the tiles that are to be drawn. An invocation owns a tile. In which order they are listed is left to chance, and nothing hangs on it.

#import cutaway::drawn_marks::drawn
#import cutaway::touched::{TILE_PX, place_of, tile_at, tile_count, tiles_of_row}

// How far from what is shown something may be drawn, in tiles.
override reach: i32 = 1;
// The rows of pixels that somebody asks for.
override first_row: u32 = 0u;
override end_row: u32 = 0xffffffffu;

fn is_drawn(tile: u32) -> bool {
    let place = vec2<i32>(place_of(tile));
    let last = vec2<i32>(i32(tiles_of_row()), i32(tile_count() / tiles_of_row())) - 1;
    var shown = 0u;
    for (var y = -reach; y <= reach; y++) {
        for (var x = -reach; x <= reach; x++) {
            let near = clamp(place + vec2<i32>(x, y), vec2<i32>(0), last);
            shown |= drawn.tiles[tile_at(vec2<u32>(near))].is_shown;
        }
    }
    return shown != 0u;
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let tile = id.x;
    if tile >= tile_count() {
        return;
    }
    let row = place_of(tile).y * TILE_PX;
    if row + TILE_PX <= first_row || row >= end_row {
        return;
    }
    let is_drawn_now = is_drawn(tile);
    let was_drawn = drawn.tiles[tile].was_drawn != 0u;
    drawn.tiles[tile].was_drawn = u32(is_drawn_now);
    if is_drawn_now || was_drawn {
        drawn.tiles[atomicAdd(&drawn.count, 1u)].listed = tile;
    }
}
