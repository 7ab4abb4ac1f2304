// The touched tiles, for passes that go over them.

#define_import_path cutaway::touched_list

#import cutaway::touched::{Blank, tile_count}

struct Tile {
    // The tile that is in this place of the list.
    listed: u32,
    is_touched: u32,
    // Bits of the greatest depth-buffer value of the cut triangles, and of the least those of its complement; 0 is nothing.
    reach: vec2<u32>,
}

struct Touched {
    // How long the list is.
    count: u32,
    // Not 0 where triangles may be in any tile.
    anywhere: u32,
    // The depths of those of them that are cut.
    reach: vec2<u32>,
    // Of which picture.
    blank: Blank,
    tiles: array<Tile>,
}

@group(2) @binding(7) var<storage, read> touched: Touched;

// How many tiles there are to go over.
fn touched_count() -> u32 {
    return select(touched.count, tile_count(), touched.anywhere != 0u);
}

// The tile in a place of the list.
fn touched_at(place: u32) -> u32 {
    return select(touched.tiles[place].listed, place, touched.anywhere != 0u);
}
