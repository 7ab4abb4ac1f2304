// What a covered sample does where a list of crossings is known.
//
// Marking ranks the sample in its pixel's list, leaves to the inside test what that wants of it (the open module `store`), and
// raises the pixel's depth if it is kept. Claiming, once all depths are known, sets the triangle: two steps of 32 bits in the
// place of one of 64.

#define_import_path cutaway::sample

#import cutaway::crossings::rank_of
#import cutaway::cuts::is_removed
#import cutaway::lanes::{Fragment, Lane}
#import cutaway::nearest::{claim, nearest_bits, raise}
#import cutaway::store::store
#import cutaway::sweep::{NO_LANE, drawn_parts, sweep}

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
    if sweep.again != 0u {
        if bitcast<u32>(sample.z) == nearest_bits(sample.pixel) && !is_removed(rank_of(sample.z, sample.pixel).sides, part.cuts) {
            claim(sample.pixel, sample.triangle);
        }
        return;
    }
    let rank = rank_of(sample.z, sample.pixel);
    if part.place != NO_LANE {
        let lane = Lane(part.lane_word, part.lane_shift, sample.lane_bits);
        store(Fragment(sample.pixel, lane, part.place, sample.z, rank.behind, sample.front));
    }
    if !is_removed(rank.sides, part.cuts) {
        raise(sample.pixel, sample.z);
    }
}
