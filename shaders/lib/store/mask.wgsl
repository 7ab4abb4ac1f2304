// A fragment's contribution to the inside test `mask`: the thermometer of the crossings in front of it.

#define_import_path cutaway::store

#import cutaway::lanes::Fragment
#import cutaway::mask::{add_fragment, clear}

fn store(fragment: Fragment) {
    let lane = fragment.lane;
    add_fragment(fragment.pixel, lane.word, lane.shift, lane.bits, fragment.behind);
}

// Prepares a pixel for its first fragment.
fn begin(pixel: u32) {
    clear(pixel);
}
