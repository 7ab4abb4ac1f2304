// Processing of a covered sample without a list of crossings and without surfaces: only the open module `store` uses the sample.

#define_import_path cutaway::sample

#import cutaway::frame::pixel_index
#import cutaway::lanes::{Fragment, Lane}
#import cutaway::store::store
#import cutaway::sweep::{NO_LANE, Sample}

// Returns true if a later sweep must visit the triangle.
fn take(sample: Sample) -> bool {
    let part = sample.part;
    if part.place != NO_LANE {
        let lane = Lane(part.lane_word, part.lane_shift, sample.lane_bits);
        store(Fragment(pixel_index(sample.at), lane, part.place, sample.z, 0u, sample.front));
    }
    return true;
}
