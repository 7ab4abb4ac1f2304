// Finds which tiles of the picture the parts touch, and between which depths the cut ones lie in each: of each triangle by the box of its
// corners. One invocation owns one triangle.
//
// Depths of samples are kept between those of the corners (`flat.wgsl`), so none is beyond what is found here. A triangle that is to be
// clipped may be anywhere.

#import cutaway::rows::row_of_triangle
#import cutaway::screen::{first_pixel, is_beside, is_clipped, last_pixel, point_of}
#import cutaway::sweep::{NO_LANE, corners_of, drawn_parts, number_of, sweep}
#import cutaway::touched::{TILE_PX, tile_at}
#import cutaway::touching::{touch_box, touched}

@group(2) @binding(3) var<storage, read> screen: array<vec4<i32>>;

// Of depths as they are kept.
fn widen(tile: u32, nearest: u32, farthest: u32) {
    if nearest > atomicLoad(&touched.tiles[tile].nearest) {
        atomicMax(&touched.tiles[tile].nearest, nearest);
    }
    if farthest > atomicLoad(&touched.tiles[tile].farthest) {
        atomicMax(&touched.tiles[tile].farthest, farthest);
    }
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let triangle = number_of(id);
    if triangle >= sweep.triangle_count {
        return;
    }
    let part = row_of_triangle(triangle);
    let is_cut = drawn_parts.parts[part].place != NO_LANE;
    let corners = corners_of(triangle, part);
    let vertices = array<vec4<i32>, 3>(screen[corners.x], screen[corners.y], screen[corners.z]);
    if is_beside(vertices) {
        return;
    }
    if is_clipped(vertices) {
        atomicStore(&touched.anywhere, 1u);
        if is_cut {
            atomicStore(&touched.nearest, bitcast<u32>(1.0));
            atomicStore(&touched.farthest, ~0u);
        }
        return;
    }
    let a = point_of(vertices[0]);
    let b = point_of(vertices[1]);
    let c = point_of(vertices[2]);
    let first = first_pixel(min(a.steps, min(b.steps, c.steps)));
    let last = last_pixel(max(a.steps, max(b.steps, c.steps)));
    if any(first > last) {
        return;
    }
    touch_box(first, last);
    if !is_cut {
        return;
    }
    let nearest = bitcast<u32>(max(max(a.z, max(b.z, c.z)), 0.0));
    let farthest = ~bitcast<u32>(max(min(a.z, min(b.z, c.z)), 0.0));
    let first_tile = vec2<u32>(first) / TILE_PX;
    let last_tile = vec2<u32>(last) / TILE_PX;
    for (var y = first_tile.y; y <= last_tile.y; y++) {
        for (var x = first_tile.x; x <= last_tile.x; x++) {
            widen(tile_at(vec2<u32>(x, y)), nearest, farthest);
        }
    }
}
