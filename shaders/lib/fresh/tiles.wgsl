// When a frame's screen is transformed, the touched tiles are reset too.

#define_import_path cutaway::fresh

#import cutaway::untouched::reset_tile

// Called with each number from 0 to that of the last tile, and possibly beyond.
fn freshen(number: u32) {
    reset_tile(number);
}
