// Touches the tiles in which an open part may hold a point of a clip-surface although neither its mesh nor its closing triangles cover any
// pixel: the winding number may be large between triangles that are seen from the side. At such a pixel no fragment is counted, so the number is
// that of the closing triangles alone. If crossings are listed later, the depths at which they are sought are widened too.
//
// An invocation owns a tile. For each open part and clip-surface it steps through the depths that the surface has in the tile and in the part's
// box, in spheres that grow where bounds show that the number stays below a half, and shrink elsewhere. Cost: one or two spheres in most tiles;
// among cutters, whose depths are not known before they are drawn, more.

#import cutaway::closings::{Closing, closing_of}
#import cutaway::cuts::{MAX_SURFACES, cut_table}
#import cutaway::frame::{Ray, buffer_from_depth, centre_of, frame, ray_through}
#import cutaway::lanes::MOST_LANES
#import cutaway::local_sum::sum_in
#import cutaway::local_winding::{doubt_at, sphere_around}
#import cutaway::touched::{TILE_PX, place_of, tile_count}
#import cutaway::touching::{reach_of, touch_tile, touched, widen}

// Number of open parts.
override closing_count: u32 = 1u;
// Whether crossings are listed, for touched tiles and their depths.
override has_lists: bool = false;
// Whether the near plane may open a part.
override near_inside: bool = false;

const MOST_SPHERES: u32 = 64u;
const NEVER: f32 = 3e38;

// Depths along the rays of a tile; empty if the first is greater.
struct Depths {
    nearest: f32,
    farthest: f32,
}

// The depths in a tile of a part's box, outside of which nothing is inside.
fn depths_of_box(closing: Closing, first: vec2<u32>) -> Depths {
    var low = vec3<f32>(NEVER);
    var high = vec3<f32>(-NEVER);
    var is_clipped = false;
    for (var i = 0u; i < 8u; i++) {
        let corner = select(closing.least, closing.greatest, vec3<bool>((i & 1u) != 0u, (i & 2u) != 0u, (i & 4u) != 0u));
        let clip = frame.clip_from_scene * vec4<f32>(corner, 1.0);
        let px = (0.5 + vec2<f32>(0.5, -0.5) * clip.xy / clip.w) * vec2<f32>(frame.size_px);
        let depth = dot(corner - frame.ray_origin[0].xyz, frame.forward.xyz);
        low = min(low, vec3<f32>(px, depth));
        high = max(high, vec3<f32>(px, depth));
        is_clipped |= depth < frame.near;
    }
    let tile = vec2<f32>(first);
    // A pixel more on all sides, for rounding. A corner before the near plane has no place in the picture.
    let is_before = all(low.xy - 1.0 < tile + f32(TILE_PX)) && all(high.xy + 1.0 > tile);
    if !is_before && !is_clipped {
        return Depths(1.0, 0.0);
    }
    return Depths(max(low.z, frame.near), high.z);
}

// The depths of a relief, or a plane, between its least and greatest height along a ray.
fn depths_along(surface: u32, ray: Ray) -> Depths {
    let row = cut_table.surfaces[surface].height_row;
    let heights = -cut_table.surfaces[surface].slab - dot(row.xyz, ray.origin) - row.w;
    let rise = dot(row.xyz, ray.direction);
    let depths = heights / rise;
    // Along the plane, the whole ray or nothing.
    let is_along = abs(rise) * NEVER <= max(abs(heights.x), abs(heights.y));
    return Depths(
        select(min(depths.x, depths.y), 0.0, is_along),
        select(max(depths.x, depths.y), NEVER, is_along),
    );
}

// The depths of a clip-surface in a tile.
fn depths_of_surface(surface: u32, first: vec2<u32>) -> Depths {
    var all = Depths(NEVER, 0.0);
    // Cutters have no heights.
    if cut_table.has_normals != 0u {
        return Depths(0.0, NEVER);
    }
    for (var i = 0u; i < 4u; i++) {
        let corner = first + vec2<u32>(i & 1u, i >> 1u) * (TILE_PX - 1u);
        let here = depths_along(surface, ray_through(centre_of(corner)));
        // A surface that is behind the eye at one corner, in part or whole, may be at any distance between two.
        all.nearest = min(all.nearest, select(here.nearest, NEVER, here.farthest < 0.0));
        all.farthest = max(all.farthest, select(here.farthest, NEVER, here.nearest < 0.0));
    }
    return all;
}

// Whether the number of a part's closing triangles is less than a half at all points of a tile between two depths.
fn is_outside(closing: Closing, first: vec2<u32>, depths: Depths) -> bool {
    let sphere = sphere_around(first, TILE_PX, depths.nearest, depths.farthest);
    if any(sphere.centre + sphere.radius < closing.least) || any(sphere.centre - sphere.radius > closing.greatest) {
        return true;
    }
    let sum = sum_in(closing.tree, sphere);
    return abs(sum.number) + sum.swing < 0.5;
}

// Touches a tile where a part may hold something between two depths.
fn search(closing: Closing, tile: u32, depths: Depths) {
    let first = place_of(tile) * TILE_PX;
    let least_step = doubt_at(depths.farthest, f32(TILE_PX));
    var step = max(depths.farthest - depths.nearest, least_step);
    var start = depths.nearest;
    var n = 0u;
    for (; n < MOST_SPHERES; n++) {
        let end = min(start + step, depths.farthest);
        if is_outside(closing, first, Depths(start, end)) {
            if end >= depths.farthest {
                return;
            }
            start = end;
            step *= 2.0;
        } else if step > least_step {
            step *= 0.5;
        } else {
            break;
        }
    }
    touch_tile(tile);
    if has_lists {
        let reach = reach_of(vec3<f32>(buffer_from_depth(start), vec2<f32>(buffer_from_depth(depths.farthest))));
        widen(tile, reach.x, reach.y);
    }
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let tile = id.x + id.y * 64u * groups.x;
    // Where triangles may be in any tile, all tiles are processed, but the depths of some may be too few.
    let is_anywhere = atomicLoad(&touched.anywhere) != 0u && !has_lists;
    if tile >= tile_count() || is_anywhere {
        return;
    }
    for (var i = 0u; i < min(closing_count, MOST_LANES); i++) {
        let closing = closing_of(i);
        let box = depths_of_box(closing, place_of(tile) * TILE_PX);
        if closing.is_flat || box.nearest > box.farthest {
            continue;
        }
        let surface_count = min(cut_table.surface_count, MAX_SURFACES);
        let count = surface_count + select(0u, 1u, near_inside);
        for (var s = 0u; s < min(count, MAX_SURFACES + 1u); s++) {
            var of_surface = Depths(frame.near, frame.near);
            if s < surface_count {
                of_surface = depths_of_surface(s, place_of(tile) * TILE_PX);
            }
            let depths = Depths(max(box.nearest, of_surface.nearest), min(box.farthest, of_surface.farthest));
            let is_touched = atomicLoad(&touched.tiles[tile].is_touched) != 0u;
            if depths.nearest <= depths.farthest && (has_lists || !is_touched) {
                search(closing, tile, depths);
            }
        }
    }
}
