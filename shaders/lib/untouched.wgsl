// Resets the touched tiles: no tile is touched.

#define_import_path cutaway::untouched

#import cutaway::blank::kind_of_blank
#import cutaway::touched::{blank_of_frame, tile_count}
#import cutaway::touching::touched

// Called with each number from 0 to that of the last tile, and possibly beyond.
fn reset_tile(number: u32) {
    if number == 0u {
        atomicStore(&touched.count, 0u);
        atomicStore(&touched.anywhere, 0u);
        atomicStore(&touched.nearest, 0u);
        atomicStore(&touched.farthest, 0u);
        touched.blank = blank_of_frame(kind_of_blank());
    }
    if number < tile_count() {
        atomicStore(&touched.tiles[number].is_touched, 0u);
        atomicStore(&touched.tiles[number].nearest, 0u);
        atomicStore(&touched.tiles[number].farthest, 0u);
    }
}
