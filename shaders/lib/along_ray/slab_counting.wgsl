// First step of the sweeps that class samples by slabs: a sample marks its lane by the slabs in front of it instead of crossings. If it is
// within slabs it is listed until the crossings there are known.

#define_import_path cutaway::slab_counting

#import cutaway::claims::code_of
#import cutaway::cuts::is_removed
#import cutaway::exits::is_passed
#import cutaway::frame::pixel_index
#import cutaway::slab_mask::{mark_slabs, mark_within}
#import cutaway::slabs::{SlabSides, slab_sides}
#import cutaway::sweep::{NO_LANE, Sample}
#import cutaway::within_list::list_within

fn is_kept_by(sides: SlabSides, sample: Sample) -> bool {
    return !is_removed(sides.removed | sides.within, sample.part.cuts) && !is_passed(sample.front);
}

// True if a sample is kept whatever the crossings of its pixel are.
fn is_kept_for_certain(sample: Sample) -> bool {
    return is_kept_by(slab_sides(sample.z, sample.at), sample);
}

// Marks a sample of the first sweep; returns true if it is kept for certain.
fn mark_sample(sample: Sample) -> bool {
    let part = sample.part;
    let sides = slab_sides(sample.z, sample.at);
    if part.place != NO_LANE {
        let pixel = pixel_index(sample.at);
        mark_slabs(pixel, part.lane_word, part.lane_shift, sample.lane_bits, sides.behind);
        if sides.within != 0u {
            let code = code_of(sample.triangle, sample.front);
            let is_lost = !list_within(sample.at, sample.z, code, sample.row, sides.within);
            mark_within(pixel, part.lane_word, part.lane_shift, sides.within, is_lost);
        }
    }
    return is_kept_by(sides, sample);
}
