// Inserts the crossings of rays with sheets into the per-pixel lists of crossings. One invocation owns one pixel at a time.
//
// Only crossings inside the ray's interval in the box of the cut solids count, and their sides alternate in list order: at a fold of a
// sheet seen edge-on two of them may have been swapped by rounding, which then does no harm. The side on which the ray begins is decided at
// the end of the interval that is farther from the sheet (the open module `sheet_side`); if that is too near to decide, the facing of the
// crossings decides. If the two ends and the number of crossings disagree, the sheet has a hole, and the pixel is marked. A sheet that
// bounds a solid uses no facing: the ray begins inside, on the removed side, if an odd number of all its crossings lies ahead. These carry
// their own normals.

#import cutaway::crossing_list::{List, add, finish, need, resume}
#import cutaway::crossing_words::HAS_NORMAL
#import cutaway::cuts::{MAX_SURFACES, cut_table}
#import cutaway::frame::{Ray, box_interval, centre_of, depth_from_buffer, frame, is_behind, pixel_index, ray_through}
#import cutaway::share::{pixel_at, turns}
#import cutaway::sheet_pool::LOST
#import cutaway::sheet_runs::{MOST_SHEET_FRAGMENTS, fragment_at, fragment_count, is_fragment, last_of}
#import cutaway::sheet_side::height_over_sheet
#import cutaway::sheet_words::{sheet_of, shows_front}

override capacity: u32 = 1u;
// Bits of the clip-surfaces whose sheets have a facing, and of those whose sheets bound a solid.
override by_facing: u32 = 0u;
override by_parity: u32 = 0u;
// Among the latter: those whose outside is the removed side, and those whose box contains no ray origin of the picture.
override keeps_inside: u32 = 0u;
override closed: u32 = 0u;
// Uncertainty of heights over a sheet, in scene units: a smaller height does not decide the side; one below ten times this proves no hole.
override beside: f32 = 0.0;

// Word of the need buffer for sheet fragments.
const NEED_OF_SHEETS: u32 = 3u;

// A crossing to be added: its depth-buffer value, its word, and the number of its fragment, which breaks ties in depth.
struct Crossing {
    z: f32,
    word: u32,
    fragment: u32,
}

// True if a fragment comes before a crossing. Lists are unordered, even by fragment number.
fn precedes(z: f32, fragment: u32, crossing: Crossing) -> bool {
    return is_behind(crossing.z, z) || (!is_behind(z, crossing.z) && fragment < crossing.fragment);
}

// Summary of one sheet's fragments in a list.
struct Share {
    // The number of all fragments, of those beyond the begin of the interval, and of those within it.
    all: u32,
    ahead: u32,
    within: u32,
    // Among the fragments within: number of fronts minus number of backs, and the nearest fragment.
    fronts: i32,
    nearest: Crossing,
    // True if some fragments of the list overflowed, or the list is too long.
    is_short: bool,
}

fn share_of(last: u32, surface: u32, interval: vec2<f32>) -> Share {
    var share = Share();
    var at = last;
    for (var i = 0u; i < MOST_SHEET_FRAGMENTS && is_fragment(at); i++) {
        let fragment = fragment_at(at);
        let depth = depth_from_buffer(fragment.z);
        let is_ahead = depth > interval.x;
        let is_own = sheet_of(fragment.word) == surface;
        share.all += u32(is_own);
        share.ahead += u32(is_own && is_ahead);
        if is_own && is_ahead && depth < interval.y {
            if share.within == 0u || precedes(fragment.z, at, share.nearest) {
                share.nearest = Crossing(fragment.z, fragment.word, at);
            }
            share.within++;
            share.fronts += select(-1, 1, shows_front(fragment.word));
        }
        at = fragment.before;
    }
    share.is_short = at == LOST || is_fragment(at);
    return share;
}

// The nearest fragment of a sheet behind another one, inside the interval, if any. A list is unordered and rarely long: it is searched
// again for each fragment but the first.
fn next_after(before: Crossing, last: u32, surface: u32, interval: vec2<f32>) -> Crossing {
    var next = before;
    var found = false;
    var at = last;
    for (var i = 0u; i < MOST_SHEET_FRAGMENTS && is_fragment(at); i++) {
        let fragment = fragment_at(at);
        let z = fragment.z;
        let is_later = at != before.fragment && !precedes(z, at, before);
        let is_next = is_later && (!found || precedes(z, at, next)) && sheet_of(fragment.word) == surface;
        // Fragments after it are deeper, so they are beyond the begin of the interval.
        if is_next && depth_from_buffer(z) < interval.y {
            next = Crossing(z, fragment.word, at);
            found = true;
        }
        at = fragment.before;
    }
    return next;
}

// The side on which the ray begins, for a sheet with a facing.
fn begins_by_facing(list: ptr<function, List>, surface: u32, ray: Ray, interval: vec2<f32>, share: Share) -> bool {
    let is_odd = share.within % 2u == 1u;
    let start = height_over_sheet(surface, ray.origin + interval.x * ray.direction);
    let end = height_over_sheet(surface, ray.origin + interval.y * ray.direction);
    let start_is_farther = abs(start) >= abs(end);
    let agree = ((start >= 0.0) == (end >= 0.0)) != is_odd;
    if !agree && min(abs(start), abs(end)) > 10.0 * beside {
        (*list).cut_short = true;
    }
    if share.within > 0u && max(abs(start), abs(end)) < beside {
        // Crossings that show their front leave the kept side.
        return share.fronts > 0 || (share.fronts == 0 && shows_front(share.nearest.word));
    }
    return select((end >= 0.0) != is_odd, start >= 0.0, start_is_farther);
}

// The side on which the ray begins, for a sheet that bounds a solid.
fn begins_by_parity(list: ptr<function, List>, surface: u32, share: Share) -> bool {
    let keeps_outside = ((keeps_inside >> surface) & 1u) == 0u;
    if share.all % 2u == 1u && ((closed >> surface) & 1u) != 0u {
        (*list).cut_short = true;
    }
    return keeps_outside != (share.ahead % 2u == 1u);
}

// Adds all crossings with a sheet; sides alternate.
fn cross(list: ptr<function, List>, last: u32, surface: u32, ray: Ray, interval: vec2<f32>) {
    let has_facing = ((by_facing >> surface) & 1u) != 0u;
    let bounds_solid = ((by_parity >> surface) & 1u) != 0u;
    if !has_facing && !bounds_solid {
        return;
    }
    let share = share_of(last, surface, interval);
    if share.is_short {
        (*list).cut_short = true;
    }
    var kept = false;
    if has_facing {
        kept = begins_by_facing(list, surface, ray, interval, share);
    } else {
        kept = begins_by_parity(list, surface, share);
    }
    if !kept {
        (*list).sides |= 1u << surface;
    }
    var crossing = share.nearest;
    for (var n = 0u; n < min(share.within, MOST_SHEET_FRAGMENTS); n++) {
        if n > 0u {
            crossing = next_after(crossing, last, surface, interval);
        }
        kept = !kept;
        // Only a sheet that bounds a solid has its own normals.
        add(list, crossing.z, select(surface, crossing.word | HAS_NORMAL, bounds_solid), kept);
    }
}

fn merge(xy: vec2<u32>) {
    let ray = ray_through(centre_of(xy));
    let interval = box_interval(ray);
    if !(interval.x < interval.y) {
        return;
    }
    let pixel = pixel_index(xy);
    let last = last_of(pixel);
    var list = resume(pixel, capacity);
    // No `surface_of` here: the software driver of Mesa 22.3.6 crashes if uniforms of a known row control loops and are in two bindings.
    // Backwards: among crossings at one depth the last is the cap's, and among coplanar clip-surfaces the first has the cap.
    for (var left = min(cut_table.surface_count, MAX_SURFACES); left > 0u; left--) {
        cross(&list, last, left - 1u, ray, interval);
    }
    finish(&list);
}

@compute @workgroup_size(16, 16)
fn main(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_id) local: vec3<u32>,
) {
    if all(group == vec3<u32>(0u)) && all(local == vec3<u32>(0u)) {
        atomicStore(&need[NEED_OF_SHEETS], fragment_count());
    }
    let end = turns(group, groups);
    for (var turn = 0u; turn < end; turn++) {
        let xy = pixel_at(turn, group, groups, local);
        if all(xy < frame.size_px) {
            merge(xy);
        }
    }
}
