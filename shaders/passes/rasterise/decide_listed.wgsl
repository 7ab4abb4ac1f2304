// Decides what the listed pixels show, as `decide.wgsl` does for all pixels of touched tiles. Workgroups share the list, an invocation owns a
// pixel of each turn.

#import cutaway::decide_pixel::decide_pixel
#import cutaway::frame::frame
#import cutaway::lanes::Lanes
#import cutaway::pixel_list::{share_of_list, turns_of_list}

override lane_bits: u32 = 32u;
override lane_count: u32 = 1u;
override near_inside: bool = false;
override overlaps: bool = false;

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
            decide_pixel(xy, Lanes(lane_bits, lane_count, near_inside, overlaps));
        }
    }
}
