// Covers the samples of queued triangles that cross the near plane or the guard band. Workgroups and invocations own what they
// do of large ones; the first invocation of a workgroup clips for all of them.

#import cutaway::clipping::clipped
#import cutaway::cover::{Where, cover}
#import cutaway::rows::row_of_triangle
#import cutaway::screen::{Point, borders_of, clip_of_kept, on_screen, point_of, snapped}
#import cutaway::sweep::{corners_of, sweep}

override lane_bits: u32 = 32u;

@group(2) @binding(3) var<storage, read> screen: array<vec4<i32>>;
@group(2) @binding(4) var<storage, read> queue: array<u32>;

// What is left of the triangle: a polygon.
var<workgroup> points: array<Point, 8>;
var<workgroup> point_count: u32;

fn clip(a: vec4<i32>, b: vec4<i32>, c: vec4<i32>) {
    let beyond = vec3<u32>(borders_of(a), borders_of(b), borders_of(c));
    var polygon = clipped(clip_of_kept(a), clip_of_kept(b), clip_of_kept(c), beyond);
    for (var k = 0u; k < min(polygon.count, 8u); k++) {
        switch polygon.source[k] {
            case 0u: { points[k] = point_of(a); }
            case 1u: { points[k] = point_of(b); }
            case 2u: { points[k] = point_of(c); }
            default: { points[k] = snapped(on_screen(polygon.at[k])); }
        }
    }
    point_count = min(polygon.count, 8u);
}

@compute @workgroup_size(64)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) line: u32) {
    let count = queue[1];
    for (var i = group.x; i < count; i += 16u) {
        let triangle = queue[sweep.triangle_count + 2u - i];
        let part = row_of_triangle(triangle);
        let corners = corners_of(triangle, part);
        if line == 0u {
            clip(screen[corners.x], screen[corners.y], screen[corners.z]);
        }
        workgroupBarrier();
        let at = Where(triangle, part, i32(group.y), i32(line), lane_bits);
        for (var k = 2u; k < point_count; k++) {
            cover(points[0], points[k - 1u], points[k], at);
        }
        workgroupBarrier();
    }
}
