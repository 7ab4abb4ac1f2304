// Lists the tiles to process. An invocation owns a tile. The order of the list is arbitrary and does not affect the result.

#import cutaway::borders::MOST_REACH_PX
#import cutaway::effect_tile_marks::effect_tiles
#import cutaway::touched::{TILE_PX, place_of, tile_at, tile_count, tiles_of_row}

// Distance in tiles from a tile that is not background within which effects may draw.
override reach: i32 = 1;
// Greatest stroke reach in tiles, plus one.
const MOST_REACH: i32 = MOST_REACH_PX / i32(TILE_PX) + 1;
// Range of processed pixel rows: those that the picture keeps, and those around them that effects read.
override first_row: u32 = 0u;
override end_row: u32 = 0xffffffffu;

fn is_beside_shown(tile: u32) -> bool {
    let place = vec2<i32>(place_of(tile));
    let last = vec2<i32>(i32(tiles_of_row()), i32(tile_count() / tiles_of_row())) - 1;
    var shown = 0u;
    let around = min(reach, MOST_REACH);
    for (var y = -around; y <= around; y++) {
        for (var x = -around; x <= around; x++) {
            let near = clamp(place + vec2<i32>(x, y), vec2<i32>(0), last);
            shown |= effect_tiles.tiles[tile_at(vec2<u32>(near))].is_shown;
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
    let is_near_shown = is_beside_shown(tile);
    let was_listed = effect_tiles.tiles[tile].was_listed != 0u;
    effect_tiles.tiles[tile].was_listed = u32(is_near_shown);
    if is_near_shown || was_listed {
        effect_tiles.tiles[atomicAdd(&effect_tiles.count, 1u)].listed = tile;
    }
}
