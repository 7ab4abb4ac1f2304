// A fragment's contribution to the inside test `mask` if some part is filled by the nonzero rule.
//
// A part filled even-odd keeps its lane of bits. A lane of counts begins with a word that holds the sum over all fragments and their
// number; after it each crossing has a byte, four to a word, that sums the fragments behind it: 1 for each that shows its inner side, where
// the ray leaves the mesh, -1 for the others. That is the winding number at the crossing.

#define_import_path cutaway::store

#import cutaway::frame::pixel_count
#import cutaway::lanes::{Fragment, MOST_CROSSINGS, WINDING}
#import cutaway::mask::{add_fragment, clear, mask}
#import cutaway::winding::{ones, with_number}

fn store(fragment: Fragment) {
    let lane = fragment.lane;
    if lane.shift != WINDING {
        add_fragment(fragment.pixel, lane.word, lane.shift, lane.bits, fragment.behind);
        return;
    }
    let step = select(1u, 0xffffffffu, fragment.front);
    let first = lane.word * pixel_count() + fragment.pixel;
    atomicAdd(&mask[first], with_number(step));
    let words = (min(fragment.behind, MOST_CROSSINGS) + 3u) / 4u;
    for (var w = 0u; w < words; w++) {
        let crossings = min(fragment.behind - 4u * w, 4u);
        atomicAdd(&mask[first + (w + 1u) * pixel_count()], step * ones(crossings));
    }
}

// Prepares a pixel for its first fragment.
fn begin(pixel: u32) {
    clear(pixel);
}
