// Finds which picture tiles the parts touch, and the depth range of the cut parts in each, from the box of each triangle's corners. One
// invocation owns one small triangle; the others are queued, and their tiles found piece by piece (`large_tiles.wgsl`).
//
// Depths of samples are clamped to those of the corners (`flat.wgsl`), so none is outside the range found here. A triangle that needs
// clipping is assumed to touch every tile, at any depth.

#import cutaway::enqueue::{enqueue, enqueue_clipped, is_large}
#import cutaway::rows::row_of_triangle
#import cutaway::screen::{first_pixel, is_beside, is_clipped, last_pixel, point_of}
#import cutaway::sweep::{NO_LANE, corners_of, drawn_parts, number_of, sweep}
#import cutaway::touching::{touch_box_at_depths, touched}

@group(2) @binding(3) var<storage, read> screen: array<vec4<i32>>;

// As in `small.wgsl`.
override small_px: i32 = 64;
override piece_px: f32 = 512.0;

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
        enqueue_clipped(triangle);
        if is_cut {
            atomicStore(&touched.nearest, bitcast<u32>(1.0));
            atomicStore(&touched.farthest, ~0u);
        }
        return;
    }
    let a = point_of(vertices[0]);
    let b = point_of(vertices[1]);
    let c = point_of(vertices[2]);
    let low = min(a.steps, min(b.steps, c.steps));
    let high = max(a.steps, max(b.steps, c.steps));
    let first = first_pixel(low);
    let last = last_pixel(high);
    if any(first > last) {
        return;
    }
    if is_large(low, high, small_px) {
        enqueue(triangle, a, b, c, low, high, piece_px);
        return;
    }
    touch_box_at_depths(first, last, vec3<f32>(a.z, b.z, c.z), is_cut);
}
