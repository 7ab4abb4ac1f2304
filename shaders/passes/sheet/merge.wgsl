// Inserts the crossings with sheets into the one list of each pixel. One invocation owns one pixel.
//
// Only crossings inside the ray's interval in the box of the cut solids count. Where they have a facing, the side on which the ray
// begins follows from the nearest of them, as the side after each does, and facings must alternate: a sheet with a hole shows
// itself. Two crossings closer than a tie may have changed places by rounding, at a fold of the sheet seen edge-on: such a pair says
// nothing. Where nothing says anything, the sheet lies on one side of the ray, and that of the interval's end farther from the sheet
// is asked (the open module `sheet_side`). A sheet that bounds a solid has no facing: crossings alternate by their order, and the
// ray begins inside, on the removed side, where an odd number of all of them lies ahead.

#import cutaway::crossing_list::{List, add, finish, resume}
#import cutaway::cuts::cut_table
#import cutaway::fragment_runs::{Run, depth_of, owner_of, run_of}
#import cutaway::frame::{Ray, box_interval, centre_of, depth_from_buffer, frame, is_behind, pixel_index, ray_through}
#import cutaway::sheet_side::height_over_sheet
#import cutaway::sheet_words::{sheet_of, shows_front}

override capacity: u32 = 1u;
// Bits of the clip-surfaces whose sheets have a facing, and of those whose sheets bound a solid.
override by_facing: u32 = 0u;
override by_parity: u32 = 0u;

struct Fragment {
    found: bool,
    index: u32,
    z: f32,
    front: bool,
}

// The nearest fragment of a sheet behind another one, inside the interval. A run is in no order and hardly ever long: it is looked
// through again for each.
fn next_after(before: Fragment, run: Run, surface: u32, interval: vec2<f32>) -> Fragment {
    var next = Fragment(false, 0u, 0.0, false);
    for (var i = run.first; i < run.end; i++) {
        let word = owner_of(i);
        let z = depth_of(i);
        let depth = depth_from_buffer(z);
        if sheet_of(word) != surface || depth <= interval.x || depth >= interval.y {
            continue;
        }
        let is_later = is_behind(z, before.z) || (!is_behind(before.z, z) && i > before.index);
        if (is_later || !before.found) && (!next.found || is_behind(next.z, z)) {
            next = Fragment(true, i, z, shows_front(word));
        }
    }
    return next;
}

// Whether two crossings may have changed places.
fn is_pair(a: Fragment, b: Fragment) -> bool {
    return b.found && a.front != b.front && a.z - b.z <= 2.0 * (a.z * frame.tie.x + frame.tie.y);
}

fn begins_kept_beside(surface: u32, ray: Ray, interval: vec2<f32>) -> bool {
    let near = height_over_sheet(surface, ray.origin + interval.x * ray.direction);
    let far = height_over_sheet(surface, ray.origin + interval.y * ray.direction);
    return select(far, near, abs(near) >= abs(far)) >= 0.0;
}

fn cross_by_facing(list: ptr<function, List>, run: Run, surface: u32, ray: Ray, interval: vec2<f32>) {
    var crossing = next_after(Fragment(false, 0u, 0.0, false), run, surface, interval);
    var begun = false;
    var begins_kept = true;
    var kept = true;
    var is_second = false;
    for (var n = run.first; n < run.end && crossing.found; n++) {
        let next = next_after(crossing, run, surface, interval);
        add(list, crossing.z, surface, !crossing.front);
        if is_second {
            is_second = false;
        } else if (!begun || crossing.front != kept) && is_pair(crossing, next) {
            is_second = true;
        } else {
            if !begun {
                begun = true;
                begins_kept = crossing.front;
                kept = begins_kept;
            }
            if crossing.front != kept {
                (*list).cut_short = true;
            }
            kept = !crossing.front;
        }
        crossing = next;
    }
    if !begun {
        begins_kept = begins_kept_beside(surface, ray, interval);
    }
    if !begins_kept {
        (*list).sides |= 1u << surface;
    }
}

fn cross_by_parity(list: ptr<function, List>, run: Run, surface: u32, interval: vec2<f32>) {
    var removed = false;
    for (var i = run.first; i < run.end; i++) {
        if sheet_of(owner_of(i)) == surface && depth_from_buffer(depth_of(i)) > interval.x {
            removed = !removed;
        }
    }
    if removed {
        (*list).sides |= 1u << surface;
    }
    var crossing = next_after(Fragment(false, 0u, 0.0, false), run, surface, interval);
    for (var n = run.first; n < run.end && crossing.found; n++) {
        add(list, crossing.z, surface, removed);
        removed = !removed;
        crossing = next_after(crossing, run, surface, interval);
    }
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
    for (var s = 0u; s < cut_table.surface_count; s++) {
        if ((by_facing >> s) & 1u) != 0u {
            cross_by_facing(&list, run, s, ray, interval);
        } else if ((by_parity >> s) & 1u) != 0u {
            cross_by_parity(&list, run, s, interval);
        }
    }
    finish(&list);
}
