// Covers the samples of queued triangles that are too large for one invocation. A workgroup owns every 16th of the queue, and
// of it every eighth row of tiles; an invocation owns one row of samples of a tile.

#import cutaway::cover::{Where, cover}
#import cutaway::rows::row_of_triangle
#import cutaway::screen::point_of
#import cutaway::sweep::{corners_of, sweep}

override lane_bits: u32 = 32u;

@group(2) @binding(3) var<storage, read> screen: array<vec4<i32>>;
@group(2) @binding(4) var<storage, read> queue: array<u32>;

@compute @workgroup_size(64)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) line: u32) {
    let count = min(queue[0], sweep.triangle_count);
    for (var i = group.x; i < count; i += 16u) {
        let triangle = queue[3u + i];
        let part = row_of_triangle(triangle);
        let corners = corners_of(triangle, part);
        let at = Where(triangle, part, i32(group.y), i32(line), lane_bits);
        cover(point_of(screen[corners.x]), point_of(screen[corners.y]), point_of(screen[corners.z]), at);
    }
}
