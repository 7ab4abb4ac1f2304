// First step of the sweeps that class samples by a slab: a sample in front of the slab or behind it marks its lane by the slab instead of
// crossings; the others are listed until their pixel's crossings are known.

#define_import_path cutaway::slab_counting

#import cutaway::claims::code_of
#import cutaway::cuts::is_removed
#import cutaway::exits::is_passed
#import cutaway::frame::pixel_index
#import cutaway::slab_mask::{mark_slab, mark_within}
#import cutaway::slab_sides::{SlabSide, slab_side}
#import cutaway::sweep::{NO_LANE, Sample}
#import cutaway::within_list::list_within

fn is_kept_by(side: SlabSide, sample: Sample) -> bool {
    // A part without cuts is kept everywhere.
    let is_known = !side.is_within || sample.part.cuts == 0u;
    return is_known && !is_removed(u32(side.is_removed), sample.part.cuts) && !is_passed(sample.front);
}

// True if a sample is kept whatever the crossings of its pixel are.
fn is_kept_for_certain(sample: Sample) -> bool {
    return is_kept_by(slab_side(sample.z, sample.at), sample);
}

// Marks a sample of the first sweep; returns true if it is kept for certain.
fn mark_sample(sample: Sample) -> bool {
    let part = sample.part;
    let side = slab_side(sample.z, sample.at);
    if part.place != NO_LANE {
        let pixel = pixel_index(sample.at);
        mark_slab(pixel, part.lane_word, part.lane_shift, sample.lane_bits, side.is_behind);
        if side.is_within {
            let code = code_of(sample.triangle, sample.front);
            let is_lost = !list_within(sample.at, sample.z, code, sample.row);
            mark_within(pixel, part.lane_word, part.lane_shift, sample.lane_bits, is_lost);
        }
    }
    return is_kept_by(side, sample);
}
