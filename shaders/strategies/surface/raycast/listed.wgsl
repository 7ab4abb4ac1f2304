// One invocation owns the list of crossings of one pixel in which they can matter, if lanes were marked by slabs. Rays are followed between
// the depths of the cut parts in their picture tile. Lanes that were marked by slabs become lanes of crossings.
//
// A crossing matters if its surface's slab holds a fragment of the pixel, or has an odd number of fragments of a part behind it. Other
// surfaces are walked only where their slabs meet the depths at which crossings matter: elsewhere one crossing anywhere in the slab will do.

#import cutaway::asked::Interval
#import cutaway::crossing_list::{List, add, begin_list, finish}
#import cutaway::cuts::{NO_RELIEF, cut_table}
#import cutaway::frame::{buffer_from_depth, centre_of, frame, pixel_index}
#import cutaway::interval_in_tile::interval_in_tile
#import cutaway::pixel_list::{reach_at, share_of_list, turns_of_list}
#import cutaway::plane_crossing::cross_level
#import cutaway::relief_crossing::cross_relief
#import cutaway::slab_bits::{SlabBits, slab_count}
#import cutaway::slab_spread::{slab_bits_of, spread}
#import cutaway::slabs::{UNREACHED, SlabIntervals, interval_of, rising, slab_intervals, slabs_between}
#import cutaway::surfaces::surface_of

override capacity: u32 = 8u;
override lane_bits: u32 = 32u;
// The near plane may be inside a solid.
override near_inside: bool = false;

// The depths between which crossings matter.
fn mattering(slabs: SlabIntervals, bits: SlabBits) -> vec2<f32> {
    let surfaces = bits.odd | bits.within;
    // The side on which the ray starts matters for the cap of the near plane.
    var depths = select(vec2<f32>(UNREACHED, -UNREACHED), vec2<f32>(frame.near), near_inside);
    let count = slab_count();
    for (var s = 0u; s < count; s++) {
        let slab = interval_of(slabs, s);
        if ((surfaces >> s) & 1u) != 0u {
            depths = vec2<f32>(min(depths.x, slab.x), max(depths.y, slab.y));
        }
    }
    return depths;
}

// Adds the crossings with a relief. A walk that may end early adds one where the ray leaves the slab, if the ray would else end on the wrong
// side. That one is never the nearest cap: a crossing before it entered the kept side inside the same parts.
fn walk(list: ptr<function, List>, surface: u32, at_px: vec2<f32>, interval: Interval, slab_end: f32, rises: bool) {
    let found = (*list).found;
    cross_relief(list, surface, at_px, interval);
    let begins_kept = (((*list).sides >> surface) & 1u) == 0u;
    let is_even = (((*list).found - found) & 1u) == 0u;
    let ends_kept = begins_kept == is_even;
    if (*list).is_first_enough && ends_kept != rises && slab_end < interval.part.y {
        add(list, buffer_from_depth(slab_end), surface, rises);
    }
}

fn cross(xy: vec2<u32>) {
    let pixel = pixel_index(xy);
    var list = begin_list(pixel, capacity, false);
    let bits = slab_bits_of(pixel, lane_bits);
    let interval = interval_in_tile(xy, reach_at(xy), near_inside);
    if interval.part.x < interval.part.y {
        let slabs = slab_intervals(xy);
        let walked = slabs_between(slabs, mattering(slabs, bits));
        // Backwards: among crossings at one depth the last is the cap's, and among coplanar clip-surfaces the first has the cap.
        for (var left = slab_count(); left > 0u; left--) {
            let s = surface_of(left - 1u);
            let slab = interval_of(slabs, s);
            let is_relief = cut_table.surfaces[s].first_texel != NO_RELIEF;
            if is_relief && ((walked >> s) & 1u) != 0u {
                list.is_first_enough = ((bits.within >> s) & 1u) == 0u && slabs_between(slabs, slab) == (1u << s);
                walk(&list, s, centre_of(xy), interval, slab.y, ((rising(slabs) >> s) & 1u) != 0u);
            } else {
                let heights = cut_table.surfaces[s].slab;
                cross_level(&list, s, -0.5 * (heights.x + heights.y), centre_of(xy), interval.part);
            }
        }
    }
    spread(&list, lane_bits);
    list.cut_short |= bits.is_lost;
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
