// Covers the samples of queued triangles: those too large for one invocation, and those that cross the near plane or the
// guard band. A workgroup owns every 64th of the queue, and of it every eighth row of tiles; an invocation owns one column of
// a tile of 64 x 64 samples.

#import cutaway::clipping::clipped
#import cutaway::frame::{frame, pixel_index}
#import cutaway::mesh::clip_position
#import cutaway::sample::take_sample
#import cutaway::screen::{first_pixel, last_pixel, snapped}
#import cutaway::sweep::{corners_of, part_of_triangle}
#import cutaway::tiles::{edge_value, is_inside, may_be_inside, tile_edge}
#import cutaway::wide::{wide_cross, wide_float, wide_is_negative}

override lane_bits: u32 = 32u;
override mask_words: u32 = 1u;

@group(2) @binding(3) var<storage, read> screen: array<vec4<i32>>;
@group(2) @binding(4) var<storage, read> queue: array<u32>;
@group(2) @binding(5) var<storage, read> vertices: array<vec4<u32>>;

struct Where {
    triangle: u32,
    place: u32,
    // Which rows of tiles, and which column of a tile.
    rows: i32,
    column: i32,
}

fn cover(a: vec3<i32>, second: vec3<i32>, third: vec3<i32>, at: Where) {
    let first = first_pixel(min(a.xy, min(second.xy, third.xy)));
    let last = last_pixel(max(a.xy, max(second.xy, third.xy)));
    let whole = wide_cross(second.xy - a.xy, third.xy - a.xy);
    if any(first > last) || (whole.x | whole.y) == 0u {
        return;
    }
    let turned = wide_is_negative(whole);
    let b = select(second, third, turned);
    let c = select(third, second, turned);
    let z = bitcast<f32>(a.z);
    let rise = vec2<f32>(bitcast<f32>(b.z) - z, bitcast<f32>(c.z) - z) / abs(wide_float(whole));
    let last_tile = last >> vec2<u32>(6u);
    let first_tile = first >> vec2<u32>(6u);
    let first_row = first_tile.y + ((at.rows - first_tile.y) & 7);
    for (var tile_y = first_row; tile_y <= last_tile.y; tile_y += 8) {
        for (var tile_x = first_tile.x; tile_x <= last_tile.x; tile_x++) {
            let from_px = max(64 * vec2<i32>(tile_x, tile_y), first);
            let span = min(64 * vec2<i32>(tile_x, tile_y) + 63, last) - from_px;
            let sample = 256 * from_px + 128;
            let bc = tile_edge(b.xy, c.xy, sample);
            let ca = tile_edge(c.xy, a.xy, sample);
            let ab = tile_edge(a.xy, b.xy, sample);
            if at.column > span.x || !may_be_inside(bc, span) || !may_be_inside(ca, span) || !may_be_inside(ab, span) {
                continue;
            }
            for (var y = 0; y <= span.y; y++) {
                let step = vec2<i32>(at.column, y);
                if is_inside(bc, step) && is_inside(ca, step) && is_inside(ab, step) {
                    let weights = vec2<f32>(edge_value(ca, step), edge_value(ab, step));
                    let pixel = pixel_index(vec2<u32>(from_px + step));
                    take_sample(pixel, z + dot(weights, rise), at.triangle, at.place, lane_bits, mask_words);
                }
            }
        }
    }
}

fn clip_of(vertex: u32) -> vec4<f32> {
    return clip_position(bitcast<vec3<f32>>(vertices[vertex].xyz));
}

@compute @workgroup_size(64)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) column: u32) {
    let count = queue[0];
    for (var i = group.x; i < count; i += 64u) {
        let triangle = queue[i + 1u];
        let place = part_of_triangle(triangle);
        let corners = corners_of(triangle, place);
        let a = screen[corners.x];
        let b = screen[corners.y];
        let c = screen[corners.z];
        let at = Where(triangle, place, i32(group.y), i32(column));
        if (a.w | b.w | c.w) == 0 {
            cover(a.xyz, b.xyz, c.xyz, at);
            continue;
        }
        let beyond = vec3<u32>(vec3<i32>(a.w, b.w, c.w));
        var polygon = clipped(clip_of(corners.x), clip_of(corners.y), clip_of(corners.z), beyond);
        var points: array<vec3<i32>, 8>;
        for (var k = 0u; k < min(polygon.count, 8u); k++) {
            switch polygon.source[k] {
                case 0u: { points[k] = a.xyz; }
                case 1u: { points[k] = b.xyz; }
                case 2u: { points[k] = c.xyz; }
                default: { points[k] = snapped(polygon.at[k]); }
            }
        }
        for (var k = 2u; k < min(polygon.count, 8u); k++) {
            cover(points[0], points[k - 1u], points[k], at);
        }
    }
}
