// One invocation owns the list of crossings of one pixel, if all clip-surfaces are planes: closed form, no march. Those that are drawn as
// sheets are left to the pass that merges them.

#import cutaway::begun::make_ready
#import cutaway::crossing_list::{begin_list, finish}
#import cutaway::cuts::{MAX_SURFACES, cut_table}
#import cutaway::frame::{frame, box_interval, centre_of, pixel_index, ray_through}
#import cutaway::plane_crossing::cross_plane
#import cutaway::share::{pixel_at, turns}
#import cutaway::surfaces::surface_of

override capacity: u32 = 1u;
// Bits of the clip-surfaces that are drawn as sheets.
override sheets: u32 = 0u;

fn cross(xy: vec2<u32>) {
    let pixel = pixel_index(xy);
    make_ready(pixel);
    var list = begin_list(pixel, capacity, false);
    let at = centre_of(xy);
    let interval = box_interval(ray_through(at));
    if interval.x < interval.y {
        // Backwards: among crossings at one depth the last is the cap's, and among coplanar clip-surfaces the first has the cap.
        for (var left = min(cut_table.surface_count, MAX_SURFACES); left > 0u; left--) {
            let s = surface_of(left - 1u);
            if ((sheets >> s) & 1u) == 0u {
                cross_plane(&list, s, at, interval);
            }
        }
    }
    finish(&list);
}

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
            cross(xy);
        }
    }
}
