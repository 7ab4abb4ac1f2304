// First step of both kinds of sweeps that count the crossings in front of a sample. All later steps depend only on the list of crossings
// and the sample's own depth.

#define_import_path cutaway::counting

#import cutaway::crossings::crossings_before
#import cutaway::cuts::is_removed
#import cutaway::exits::is_passed
#import cutaway::frame::pixel_index
#import cutaway::lanes::{Fragment, Lane}
#import cutaway::store::store
#import cutaway::sweep::{NO_LANE, Sample}

// True if the cuts of its part keep a sample.
fn is_kept(sample: Sample) -> bool {
    let sides = crossings_before(sample.z, sample.at).sides;
    return !is_removed(sides, sample.part.cuts) && !is_passed(sample.front);
}

// Counts the crossings in front of a sample, stores the data for the inside test, and returns true if the sample is kept.
fn count_and_store(sample: Sample) -> bool {
    let part = sample.part;
    let before = crossings_before(sample.z, sample.at);
    if part.place != NO_LANE {
        let lane = Lane(part.lane_word, part.lane_shift, sample.lane_bits);
        store(Fragment(pixel_index(sample.at), lane, part.place, sample.z, before.behind, sample.front));
    }
    return !is_removed(before.sides, part.cuts) && !is_passed(sample.front);
}
