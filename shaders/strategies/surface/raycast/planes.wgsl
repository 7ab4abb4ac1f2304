// One invocation owns the list of crossings of one pixel, where all clip-surfaces are planes: closed form, no march. Those that
// are drawn as sheets are left to the pass that merges them.

#import cutaway::crossing_list::{List, finish}
#import cutaway::cuts::cut_table
#import cutaway::frame::{frame, box_interval, centre_of, pixel_index, ray_through}
#import cutaway::plane_crossing::cross_plane
#import cutaway::store::begin

override capacity: u32 = 1u;
// Bits of the clip-surfaces that are drawn as sheets.
override sheets: u32 = 0u;

@compute @workgroup_size(16, 16)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= frame.size_px) {
        return;
    }
    let pixel = pixel_index(id.xy);
    begin(pixel);
    var list = List(pixel, capacity, 0u, 0u, false);
    let at = centre_of(id.xy);
    let interval = box_interval(ray_through(at));
    if interval.x < interval.y {
        // Backwards: of crossings at one depth the last is the cap's, and of clip-surfaces in one plane the first has the cap.
        for (var left = cut_table.surface_count; left > 0u; left--) {
            let s = left - 1u;
            if ((sheets >> s) & 1u) == 0u {
                cross_plane(&list, s, at, interval);
            }
        }
    }
    finish(&list);
}
