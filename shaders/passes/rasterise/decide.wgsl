// Decides what each pixel shows, surface or cap, after the compute rasteriser has found the surfaces: `resolve` without the data that only
// painted pixels need. Workgroups share the touched tiles, an invocation owns a pixel of each.

#import cutaway::decide_pixel::decide_pixel
#import cutaway::frame::frame
#import cutaway::lanes::Lanes
#import cutaway::share::{pixel_at, turns}

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
    let end = turns(group, groups);
    for (var turn = 0u; turn < end; turn++) {
        let xy = pixel_at(turn, group, groups, local);
        if all(xy < frame.size_px) {
            decide_pixel(xy, Lanes(lane_bits, lane_count, near_inside, overlaps));
        }
    }
}
