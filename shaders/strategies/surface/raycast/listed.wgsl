// One invocation owns the list of crossings of one pixel in which they can matter, if the only clip-surface is a relief. Rays are followed
// between the depths of the cut parts in their picture tile. Lanes that were marked by slabs become lanes of crossings.

#import cutaway::crossing_list::{begin_list, finish}
#import cutaway::frame::{centre_of, frame, pixel_index}
#import cutaway::interval_in_tile::interval_in_tile
#import cutaway::pixel_list::{reach_at, share_of_list, turns_of_list}
#import cutaway::relief_crossing::cross_relief
#import cutaway::slab_spread::{is_first_enough, spread}

override capacity: u32 = 8u;
override lane_bits: u32 = 32u;
// The near plane may be inside a solid.
override near_inside: bool = false;

fn cross(xy: vec2<u32>) {
    let pixel = pixel_index(xy);
    var list = begin_list(pixel, capacity, is_first_enough(pixel, lane_bits));
    let interval = interval_in_tile(xy, reach_at(xy), near_inside);
    if interval.part.x < interval.part.y {
        cross_relief(&list, 0u, centre_of(xy), interval);
    }
    spread(&list, lane_bits);
    finish(&list);
}

@compute @workgroup_size(16, 16)
fn main(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_id) local: vec3<u32>,
) {
    let end = turns_of_list(group, groups);
    for (var turn = 0u; turn < end; turn++) {
        let xy = share_of_list(turn, group, groups, local);
        if all(xy < frame.size_px) {
            cross(xy);
        }
    }
}
