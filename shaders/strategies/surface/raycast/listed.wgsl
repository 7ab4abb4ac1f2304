// One invocation owns the list of crossings of one pixel in which they can matter, if lanes were marked by slabs. Rays are followed between
// the depths of the cut parts in their picture tile. Lanes that were marked by slabs become lanes of crossings.
//
// A crossing can matter if its surface's slab holds a fragment of the pixel, or has an odd number of fragments of a part behind it. Where no
// other slab meets that one along the ray, and all cut parts have the same cuts, it does not matter if the cuts remove both sides or keep
// both; or if the ray leaves what is kept there, no fragment is within, and what the ray entered is shown; or behind a cap that is certain.
// Surfaces are walked if their crossings matter, and where their slabs meet those that do: elsewhere one crossing anywhere in the slab will
// do.

#import cutaway::asked::Interval
#import cutaway::crossing_list::{List, add, begin_list, finish}
#import cutaway::cuts::{NO_RELIEF, cut_table, is_removed}
#import cutaway::frame::{buffer_from_depth, centre_of, frame, pixel_index}
#import cutaway::interval_in_tile::interval_in_tile
#import cutaway::pixel_list::{reach_at, share_of_list, turns_of_list}
#import cutaway::plane_crossing::cross_level
#import cutaway::relief_crossing::cross_relief
#import cutaway::slab_bits::{SlabBits, slab_count}
#import cutaway::slab_spread::{slab_bits_of, spread}
#import cutaway::slabs::{UNREACHED, SlabIntervals, interval_of, rising, slab_intervals, slabs_before, slabs_between}
#import cutaway::surfaces::surface_of

override capacity: u32 = 8u;
override lane_bits: u32 = 32u;
// The near plane may be inside a solid.
override near_inside: bool = false;

// The cuts of every cut part; 0 if they differ.
override cuts: u32 = 0u;

// Bits of the clip-surfaces that are walked, if crossings are listed from a depth on.
fn walked_surfaces(slabs: SlabIntervals, bits: SlabBits, first_depth: f32) -> u32 {
    // The side on which the ray starts matters for the cap of the near plane.
    var walked = select(0u, slabs_between(slabs, vec2<f32>(frame.near)), near_inside);
    var end = UNREACHED;
    // Where the ray has come into a solid, something is drawn: a surface, or a cap of the near plane.
    let shows_entries = frame.near_cap != 0u && (near_inside || !bits.is_total_odd);
    let rises = rising(slabs);
    let count = slab_count();
    for (var s = 0u; s < count; s++) {
        let bit = 1u << s;
        let slab = interval_of(slabs, s);
        let met = slabs_between(slabs, slab);
        var matters = ((bits.odd | bits.within) & bit) != 0u;
        if cuts != 0u && met == bit {
            let passed = slabs_before(slabs, slab.x);
            let others = ((rises & ~passed) | (passed & ~rises)) & ~bit;
            let is_entered = (rises & bit) != 0u;
            let changes = is_removed(others | bit, cuts) != is_removed(others, cuts);
            matters &= changes && (is_entered || !shows_entries || (bits.within & bit) != 0u);
            let is_inside = (bits.odd & ~bits.within & bit) != 0u && !bits.is_lost;
            let is_cap = changes && is_entered && is_inside && slab.x > first_depth;
            end = select(end, min(end, slab.y), is_cap);
        }
        walked |= select(0u, met, matters);
    }
    return walked & slabs_between(slabs, vec2<f32>(-UNREACHED, end));
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
        let walked = walked_surfaces(slabs, bits, interval.part.x);
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
