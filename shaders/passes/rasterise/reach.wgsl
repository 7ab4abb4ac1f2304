// Finds between which depths the cut parts lie in each tile of the picture: of each triangle by the box of its corners. One invocation
// owns one triangle.
//
// Depths of samples are kept between those of the corners (`flat.wgsl`), so none is beyond what is found here. A triangle that is to be
// clipped may be anywhere.

#import cutaway::reach::{TILE_PX, tile_at}
#import cutaway::screen::{first_pixel, is_beside, is_clipped, last_pixel, point_of}
#import cutaway::sweep::{NO_LANE, corners_of, drawn_parts, number_of, row_of_triangle, sweep}

@group(1) @binding(4) var<storage, read_write> reach: array<atomic<u32>>;
@group(2) @binding(3) var<storage, read> screen: array<vec4<i32>>;

// The depths of a triangle, as they are kept.
fn widen(tile: u32, depths: vec2<u32>) {
    if depths.x > atomicLoad(&reach[2u * tile]) {
        atomicMax(&reach[2u * tile], depths.x);
    }
    if depths.y > atomicLoad(&reach[2u * tile + 1u]) {
        atomicMax(&reach[2u * tile + 1u], depths.y);
    }
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let triangle = number_of(id);
    if triangle >= sweep.triangle_count {
        return;
    }
    let part = row_of_triangle(triangle);
    if drawn_parts.parts[part].place == NO_LANE {
        return;
    }
    let corners = corners_of(triangle, part);
    let vertices = array<vec4<i32>, 3>(screen[corners.x], screen[corners.y], screen[corners.z]);
    if is_beside(vertices) {
        return;
    }
    if is_clipped(vertices) {
        widen(0u, vec2<u32>(bitcast<u32>(1.0), ~0u));
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
    let greatest = max(max(a.z, max(b.z, c.z)), 0.0);
    let least = max(min(a.z, min(b.z, c.z)), 0.0);
    let depths = vec2<u32>(bitcast<u32>(greatest), ~bitcast<u32>(least));
    let first_tile = vec2<u32>(first) / TILE_PX;
    let last_tile = vec2<u32>(last) / TILE_PX;
    for (var y = first_tile.y; y <= last_tile.y; y++) {
        for (var x = first_tile.x; x <= last_tile.x; x++) {
            widen(tile_at(vec2<u32>(x, y)), depths);
        }
    }
}
