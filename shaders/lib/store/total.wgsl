// A fragment's contribution if the inside test uses sections and one of them is not closed: it flips the top bit of its lane. That bit ends
// as the parity of all fragments, and shows where the mesh is open.

#define_import_path cutaway::store

#import cutaway::lanes::Fragment
#import cutaway::mask::{add_fragment, clear}

fn store(fragment: Fragment) {
    let lane = fragment.lane;
    add_fragment(fragment.pixel, lane.word, lane.shift, lane.bits, 0u);
}

// Prepares a pixel for its first fragment.
fn begin(pixel: u32) {
    clear(pixel);
}
