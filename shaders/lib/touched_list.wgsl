// The touched tiles, for passes that process them.

#define_import_path cutaway::touched_list

#import cutaway::touched::{Blank, tile_count}

struct Tile {
    // The tile at this index of the list.
    listed: u32,
    is_touched: u32,
    // Bits of the greatest depth-buffer value of the cut triangles, and of the complement of the least value; 0 if there are none.
    reach: vec2<u32>,
}

struct Touched {
    // Length of the list.
    count: u32,
    // Nonzero if triangles may be in any tile.
    anywhere: u32,
    // The depth range of those of these triangles that are cut.
    reach: vec2<u32>,
    // The background that the list was made with.
    blank: Blank,
    tiles: array<Tile>,
}

@group(2) @binding(7) var<storage, read> touched: Touched;

// Number of tiles to process.
fn touched_count() -> u32 {
    return select(touched.count, tile_count(), touched.anywhere != 0u);
}

// The tile at an index of the list.
fn touched_at(place: u32) -> u32 {
    return select(touched.tiles[place].listed, place, touched.anywhere != 0u);
}
