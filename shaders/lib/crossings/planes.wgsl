// The crossings of a pixel if all clip-surfaces are planes, at most eight. They are recomputed on each use. Nothing is stored or read.
//
// Pipelines may round a crossing differently, within the precision of an f32. The sweeps that judge a sample run the same code. Later
// passes compare it with crossings again only to find the cap in front of it: at equal depths either answer is right.

#define_import_path cutaway::crossings

#import cutaway::frame::{box_interval, centre_of, depth_from_buffer, ray_through}
#import cutaway::passed::{Before, Head}
#import cutaway::planes::{BITS_OF_PLACE, MOST_PLANES, crossed, order_of, passed_at_depth, passed_before, planes_at, starting_sides, z_of}
#import cutaway::surfaces::surface_of

fn head_of(at: vec2<u32>) -> Head {
    let planes = planes_at(centre_of(at));
    return Head(countOneBits(crossed(planes)), starting_sides(planes), order_of(planes));
}

// A computed crossing never overflows.
fn is_cut_short(at: vec2<u32>) -> bool {
    return false;
}

// The crossings that may be caps, from the first to before the second: those in the box of the cut solids.
fn cappable(at: vec2<u32>) -> vec2<u32> {
    let planes = planes_at(centre_of(at));
    let interval = box_interval(ray_through(centre_of(at)));
    return vec2<u32>(
        countOneBits(passed_at_depth(planes, interval.x)),
        countOneBits(passed_at_depth(planes, interval.y)),
    );
}

fn surface_at(head: Head, index: u32, at: vec2<u32>) -> u32 {
    return surface_of(word_at(head, index, at));
}

fn word_at(head: Head, index: u32, at: vec2<u32>) -> u32 {
    return (head.order >> (BITS_OF_PLACE * index)) & (MOST_PLANES - 1u);
}

fn z_at(head: Head, index: u32, at: vec2<u32>) -> f32 {
    return z_of(planes_at(centre_of(at)), word_at(head, index, at));
}

fn depth_at(head: Head, index: u32, at: vec2<u32>) -> f32 {
    return depth_from_buffer(z_at(head, index, at));
}

fn crossings_before(z: f32, at: vec2<u32>) -> Before {
    let planes = planes_at(centre_of(at));
    let passed = passed_before(planes, z);
    return Before(countOneBits(passed), passed ^ starting_sides(planes));
}
