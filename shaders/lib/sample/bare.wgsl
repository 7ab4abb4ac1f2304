// What a covered sample does where no list of crossings is known and no surface is wanted: it is left to the open module `store`.

#define_import_path cutaway::sample

#import cutaway::lanes::{Fragment, Lane}
#import cutaway::store::store
#import cutaway::sweep::{NO_LANE, drawn_parts}

struct Sample {
    pixel: u32,
    z: f32,
    triangle: u32,
    // Row of the part in the table of drawn parts.
    row: u32,
    front: bool,
    lane_bits: u32,
}

fn take(sample: Sample) {
    let part = drawn_parts.parts[sample.row];
    if part.place != NO_LANE {
        let lane = Lane(part.lane_word, part.lane_shift, sample.lane_bits);
        store(Fragment(sample.pixel, lane, part.place, sample.z, 0u, sample.front));
    }
}
