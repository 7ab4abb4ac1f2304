// What a covered sample does. The mask has two more planes after its lanes: the greatest depth-buffer value of the kept
// samples, as bits, which order as the values do; and the number of the triangle that it came from, counted from the end so
// that a maximum finds the first of equals.
//
// Marking ranks the sample in its pixel's list of crossings, marks those it lies behind, and raises the depth if it is kept.
// Claiming, once all depths are known, sets the triangle: two steps of 32 bits in the place of one of 64.

#define_import_path cutaway::sample

#import cutaway::crossings::rank_of
#import cutaway::cuts::is_removed
#import cutaway::frame::pixel_count
#import cutaway::mask::{add_fragment, mask}
#import cutaway::sweep::{drawn_parts, sweep}

fn take_sample(pixel: u32, z: f32, triangle: u32, place: u32, lane_bits: u32, mask_words: u32) {
    let nearest = mask_words * pixel_count() + pixel;
    let claim = nearest + pixel_count();
    let part = drawn_parts.parts[place];
    if sweep.claims != 0u {
        if bitcast<u32>(z) == atomicLoad(&mask[nearest]) && !is_removed(rank_of(z, pixel).sides, part.cuts) {
            atomicMax(&mask[claim], 0xffffffffu - triangle);
        }
        return;
    }
    let rank = rank_of(z, pixel);
    if part.has_lane != 0u {
        add_fragment(pixel, part.lane_word, part.lane_shift, lane_bits, rank.behind);
    }
    if !is_removed(rank.sides, part.cuts) && bitcast<u32>(z) > atomicLoad(&mask[nearest]) {
        atomicMax(&mask[nearest], bitcast<u32>(z));
    }
}
