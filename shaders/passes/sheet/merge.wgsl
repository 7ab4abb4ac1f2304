// Inserts the crossings with sheets into the one list of each pixel. One invocation owns one pixel.
//
// Only crossings inside the ray's interval in the box of the cut solids count, and they alternate by their order: at a fold of a
// sheet seen edge-on two of them may have changed places by rounding, which then does no harm. On which side the ray begins is
// asked at the end of the interval that is farther from the sheet (the open module `sheet_side`); where that is too near to tell,
// the crossings say it by the side that they show. Where the two ends and the number of crossings do not agree, the sheet has a
// hole, and the pixel is marked. A sheet that bounds a solid shows nothing: the ray begins inside, on the removed side, where an
// odd number of all its crossings lies ahead. These bring their normals with them.

#import cutaway::crossing_list::{List, add, finish, resume}
#import cutaway::crossing_words::HAS_NORMAL
#import cutaway::cuts::cut_table
#import cutaway::fragment_runs::{Run, depth_of, owner_of, run_of}
#import cutaway::frame::{Ray, box_interval, centre_of, depth_from_buffer, frame, is_behind, pixel_index, ray_through}
#import cutaway::sheet_side::height_over_sheet
#import cutaway::sheet_words::{sheet_of, shows_front}

override capacity: u32 = 1u;
// Bits of the clip-surfaces whose sheets have a facing, and of those whose sheets bound a solid.
override by_facing: u32 = 0u;
override by_parity: u32 = 0u;
// Of the latter: those whose outside is the removed side, and those that no ray of the picture begins inside the box of.
override keeps_inside: u32 = 0u;
override closed: u32 = 0u;
// A point nearer to a sheet than this, in scene units, is not decided by its height; ten times as near it proves no hole.
override beside: f32 = 0.0;

struct Fragment {
    index: u32,
    z: f32,
}

// What a run holds of a sheet.
struct Share {
    // All fragments, those beyond the begin of the interval, and those within it.
    all: u32,
    ahead: u32,
    within: u32,
    // Of those within: by how many more show their front than their back, and the nearest.
    fronts: i32,
    nearest: Fragment,
}

fn share_of(run: Run, surface: u32, interval: vec2<f32>) -> Share {
    var share = Share();
    for (var i = run.first; i < run.end; i++) {
        let word = owner_of(i);
        if sheet_of(word) != surface {
            continue;
        }
        let z = depth_of(i);
        let depth = depth_from_buffer(z);
        share.all++;
        share.ahead += select(0u, 1u, depth > interval.x);
        if depth > interval.x && depth < interval.y {
            if share.within == 0u || is_behind(share.nearest.z, z) {
                share.nearest = Fragment(i, z);
            }
            share.within++;
            share.fronts += select(-1, 1, shows_front(word));
        }
    }
    return share;
}

// The nearest fragment of a sheet behind another one, inside the interval, if there is one. A run is in no order and hardly ever
// long: it is looked through again for each but the first.
fn next_after(before: Fragment, run: Run, surface: u32, interval: vec2<f32>) -> Fragment {
    var next = before;
    var found = false;
    for (var i = run.first; i < run.end; i++) {
        let z = depth_of(i);
        let is_later = is_behind(z, before.z) || (!is_behind(before.z, z) && i > before.index);
        if !is_later || (found && !is_behind(next.z, z)) || sheet_of(owner_of(i)) != surface {
            continue;
        }
        // Later is deeper: beyond the begin of the interval already.
        if depth_from_buffer(z) < interval.y {
            next = Fragment(i, z);
            found = true;
        }
    }
    return next;
}

// What the list keeps of a crossing.
fn word_of(fragment: u32, surface: u32) -> u32 {
    return select(surface, owner_of(fragment) | HAS_NORMAL, ((by_parity >> surface) & 1u) != 0u);
}

// Adds all crossings with a sheet; sides alternate.
fn cross(list: ptr<function, List>, run: Run, surface: u32, interval: vec2<f32>, share: Share, begins_kept: bool) {
    if !begins_kept {
        (*list).sides |= 1u << surface;
    }
    var kept = begins_kept;
    var crossing = share.nearest;
    for (var n = 0u; n < share.within; n++) {
        if n > 0u {
            crossing = next_after(crossing, run, surface, interval);
        }
        kept = !kept;
        add(list, crossing.z, word_of(crossing.index, surface), kept);
    }
}

fn cross_by_facing(list: ptr<function, List>, run: Run, surface: u32, ray: Ray, interval: vec2<f32>) {
    let share = share_of(run, surface, interval);
    let is_odd = share.within % 2u == 1u;
    let start = height_over_sheet(surface, ray.origin + interval.x * ray.direction);
    let end = height_over_sheet(surface, ray.origin + interval.y * ray.direction);
    let start_is_farther = abs(start) >= abs(end);
    var begins_kept = select((end >= 0.0) != is_odd, start >= 0.0, start_is_farther);
    if share.within > 0u && max(abs(start), abs(end)) < beside {
        // Crossings that show their front leave the kept side.
        begins_kept = share.fronts > 0 || (share.fronts == 0 && shows_front(owner_of(share.nearest.index)));
    }
    let agree = ((start >= 0.0) == (end >= 0.0)) != is_odd;
    if !agree && min(abs(start), abs(end)) > 10.0 * beside {
        (*list).cut_short = true;
    }
    cross(list, run, surface, interval, share, begins_kept);
}

fn cross_by_parity(list: ptr<function, List>, run: Run, surface: u32, interval: vec2<f32>) {
    let share = share_of(run, surface, interval);
    let keeps_outside = ((keeps_inside >> surface) & 1u) == 0u;
    if share.all % 2u == 1u && ((closed >> surface) & 1u) != 0u {
        (*list).cut_short = true;
    }
    cross(list, run, surface, interval, share, keeps_outside != (share.ahead % 2u == 1u));
}

@compute @workgroup_size(16, 16)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= frame.size_px) {
        return;
    }
    let ray = ray_through(centre_of(id.xy));
    let interval = box_interval(ray);
    if !(interval.x < interval.y) {
        return;
    }
    let pixel = pixel_index(id.xy);
    let run = run_of(pixel);
    var list = resume(pixel, capacity);
    if !run.fits {
        list.cut_short = true;
    }
    // Backwards: of crossings at one depth the last is the cap's, and of clip-surfaces in one plane the first has the cap.
    for (var left = cut_table.surface_count; left > 0u; left--) {
        let s = left - 1u;
        if ((by_facing >> s) & 1u) != 0u {
            cross_by_facing(&list, run, s, ray, interval);
        } else if ((by_parity >> s) & 1u) != 0u {
            cross_by_parity(&list, run, s, interval);
        }
    }
    finish(&list);
}
