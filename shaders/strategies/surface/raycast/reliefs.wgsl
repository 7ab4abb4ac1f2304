// One invocation owns the list of crossings of one pixel, if some clip-surface has a relief: planes in closed form, reliefs by the open
// module `relief_crossing`, which walks the cells of the offset map that the ray passes inside its height slab and the box of the cut
// solids.

#import cutaway::begun::make_ready
#import cutaway::crossing_list::{begin_list, finish}
#import cutaway::cuts::{MAX_SURFACES, NO_RELIEF, cut_table}
#import cutaway::frame::{frame, centre_of, pixel_index}
#import cutaway::interval::interval_at
#import cutaway::plane_crossing::cross_plane
#import cutaway::relief_crossing::cross_relief
#import cutaway::share::{pixel_at, turns}
#import cutaway::surfaces::surface_of

override capacity: u32 = 8u;
// Bits of the clip-surfaces that are drawn as sheets: the pass that merges them adds their crossings.
override sheets: u32 = 0u;
// The near plane may be inside a solid.
override near_inside: bool = false;

fn cross(xy: vec2<u32>) {
    let pixel = pixel_index(xy);
    make_ready(pixel);
    var list = begin_list(pixel, capacity, false);
    let at = centre_of(xy);
    let interval = interval_at(xy, near_inside);
    if interval.part.x < interval.part.y {
        // Backwards: among crossings at one depth the last is the cap's, and among coplanar clip-surfaces the first has the cap.
        for (var left = min(cut_table.surface_count, MAX_SURFACES); left > 0u; left--) {
            let s = surface_of(left - 1u);
            if ((sheets >> s) & 1u) != 0u {
                continue;
            }
            if cut_table.surfaces[s].first_texel == NO_RELIEF {
                cross_plane(&list, s, at, interval.part);
            } else {
                cross_relief(&list, s, at, interval);
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
