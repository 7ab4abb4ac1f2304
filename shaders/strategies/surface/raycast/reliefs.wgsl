// One invocation owns the list of crossings of one pixel, where some clip-surface has a relief: planes in closed form, reliefs
// by a walk over the cells of the offset map that the ray passes inside the slab of its heights.
//
// Along the ray the bilinear height of a cell is a quadratic in the depth. Whether a cell holds a crossing is decided by
// signs: the sign at a cell's entry is the one carried over from the cell before, so the number of crossings has the parity
// that the two ends of the ray imply. Roots only locate: citardauq form, clamped to the cell.

#import cutaway::crossing_list::{List, add, finish, need}
#import cutaway::cuts::{cut_table, NO_RELIEF}
#import cutaway::frame::{frame, box_interval, buffer_from_depth, centre_of, pixel_index, ray_through}
#import cutaway::plane_crossing::cross_plane
#import cutaway::quadratic::roots_in
#import cutaway::rays::{ray_table, along_ray}
#import cutaway::relief::{cell_of, height_in, map_of}
#import cutaway::store::begin

override capacity: u32 = 8u;
// Bits of the clip-surfaces that are drawn as sheets: the pass that merges them adds theirs.
override sheets: u32 = 0u;

// Depth at which a linear value reaches a border of cells, counted by integers; infinite where it never does.
fn depth_at_border(border: i32, value: vec2<f32>) -> f32 {
    return select((f32(border) - value.x) / value.y, 3.4e38, value.y == 0.0);
}

fn cross_relief(list: ptr<function, List>, surface: u32, at_px: vec2<f32>, interval: vec2<f32>) {
    let height = along_ray(ray_table.surfaces[surface].height, at_px);
    let slab = cut_table.surfaces[surface].slab;
    // Above -slab.x the point is kept and below -slab.y removed, whatever the map says; a margin of a few ulp lets the
    // walk begin and end where that is beyond doubt.
    let margin = 1e-6 * (abs(slab.x) + abs(slab.y) + abs(height.x) * 0.25);
    let kept_above = -slab.x + margin;
    let removed_below = -slab.y - margin;
    var walk = interval;
    if height.y != 0.0 {
        let a = (kept_above - height.x) / height.y;
        let b = (removed_below - height.x) / height.y;
        walk = vec2<f32>(max(interval.x, min(a, b)), min(interval.y, max(a, b)));
    }
    let at_start = height.x + interval.x * height.y;
    if walk.x >= walk.y || (height.y == 0.0 && (height.x >= kept_above || height.x <= removed_below)) {
        // The ray passes the slab nowhere inside the interval: no crossing, one side throughout.
        if at_start < 0.5 * (kept_above + removed_below) {
            (*list).sides |= 1u << surface;
        }
        return;
    }

    // From here on, s is the depth beyond walk.x.
    let texel_x = along_ray(ray_table.surfaces[surface].texel_x, at_px);
    let texel_y = along_ray(ray_table.surfaces[surface].texel_y, at_px);
    let x = vec2<f32>(texel_x.x + walk.x * texel_x.y, texel_x.y);
    let y = vec2<f32>(texel_y.x + walk.x * texel_y.y, texel_y.y);
    let over_plane = vec2<f32>(height.x + walk.x * height.y, height.y);
    let end = walk.y - walk.x;
    let map = map_of(surface);
    let relief_scale = cut_table.surfaces[surface].scale.z;
    let step = vec2<i32>(select(-1, 1, x.y > 0.0), select(-1, 1, y.y > 0.0));
    // The border ahead of cell i is i + 1 when walking up, i when walking down.
    let ahead = vec2<i32>(select(0, 1, x.y > 0.0), select(0, 1, y.y > 0.0));
    let cell_limit = cut_table.surfaces[surface].cell_limit;
    var cell = vec2<i32>(vec2<f32>(floor(x.x), floor(y.x)));
    var entry = 0.0;
    var kept = true;
    var begun = false;
    for (var n = 0u; n < cell_limit; n++) {
        let border_x = depth_at_border(cell.x + ahead.x, x);
        let border_y = depth_at_border(cell.y + ahead.y, y);
        let exit = max(entry, min(end, min(border_x, border_y)));
        let length = exit - entry;

        let form = cell_of(map, cell);
        let at = vec2<f32>(x.x + entry * x.y - f32(cell.x), y.x + entry * y.y - f32(cell.y));
        let slope = form.along + form.twist * at.yx;
        let a = relief_scale * form.twist * x.y * y.y;
        let b = over_plane.y + relief_scale * dot(slope, vec2<f32>(x.y, y.y));
        let c = over_plane.x + entry * over_plane.y + relief_scale * height_in(form, at);
        if !begun {
            begun = true;
            // Where the walk begins on the slab's border, the side is known without the map.
            kept = c >= 0.0;
            if walk.x > interval.x {
                kept = height.y < 0.0;
            }
            if !kept {
                (*list).sides |= 1u << surface;
            }
        }
        var kept_at_exit = c + length * (b + a * length) >= 0.0;
        let last = exit >= end;
        if last && walk.y < interval.y {
            kept_at_exit = height.y > 0.0;
        }
        let roots = roots_in(a, b, c, length, kept, kept_at_exit);
        var now_kept = kept;
        for (var i = 0u; i < roots.count; i++) {
            now_kept = !now_kept;
            let depth = walk.x + entry + select(roots.at.y, roots.at.x, i == 0u);
            add(list, buffer_from_depth(depth), surface, now_kept);
        }
        kept = kept_at_exit;
        if last {
            return;
        }
        // Ties step in x first; the cell between has no length.
        if border_x <= border_y {
            cell.x += step.x;
        } else {
            cell.y += step.y;
        }
        entry = exit;
    }
    // Cells beyond the limit are not walked: say so.
    (*list).cut_short = true;
    atomicMax(&need[1], cell_limit + 1u);
}

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
        for (var s = 0u; s < cut_table.surface_count; s++) {
            if ((sheets >> s) & 1u) != 0u {
                continue;
            }
            if cut_table.surfaces[s].first_texel == NO_RELIEF {
                cross_plane(&list, s, at, interval);
            } else {
                cross_relief(&list, s, at, interval);
            }
        }
    }
    finish(&list);
}
