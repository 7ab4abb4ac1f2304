// Covers the samples of small triangles, and queues the others. One invocation owns one triangle.
//
// A box that holds no sample ends the invocation before anything is multiplied: of a fine mesh that is most of them. A side of
// at most 2^14 steps keeps edge functions below 2^30 in magnitude.

#import cutaway::frame::pixel_index
#import cutaway::sample::{Sample, take}
#import cutaway::screen::{edge_bias, first_pixel, last_pixel}
#import cutaway::span::narrowed
#import cutaway::sweep::{corners_of, number_of, row_of_triangle, sweep}

override lane_bits: u32 = 32u;
// Longest side of the box of a small triangle, in pixels; at most 64.
override small_px: i32 = 64;

@group(2) @binding(3) var<storage, read> screen: array<vec4<i32>>;
@group(2) @binding(4) var<storage, read_write> queue: array<atomic<u32>>;

// Large triangles fill the queue from its begin, those to be clipped from its end: together they are no more than all.
fn enqueue(triangle: u32, is_clipped: bool) {
    if sweep.again != 0u {
        // The first sweep filled the queue.
        return;
    }
    if is_clipped {
        let taken = atomicAdd(&queue[1], 1u);
        atomicStore(&queue[sweep.triangle_count + 1u - taken], triangle);
    } else {
        let taken = atomicAdd(&queue[0], 1u);
        atomicStore(&queue[2u + taken], triangle);
    }
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let triangle = number_of(id);
    if triangle >= sweep.triangle_count {
        return;
    }
    let part = row_of_triangle(triangle);
    let corners = corners_of(triangle, part);
    let a = screen[corners.x];
    var b = screen[corners.y];
    var c = screen[corners.z];
    if (a.w | b.w | c.w) != 0 {
        // Beyond one border as a whole, or to be clipped.
        if (a.w & b.w & c.w) == 0 {
            enqueue(triangle, true);
        }
        return;
    }
    let low = min(a.xy, min(b.xy, c.xy));
    let high = max(a.xy, max(b.xy, c.xy));
    let first = first_pixel(low);
    let last = last_pixel(high);
    if any(first > last) {
        return;
    }
    if any(high - low > vec2<i32>(small_px * 256)) {
        enqueue(triangle, false);
        return;
    }
    var area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if area == 0 {
        return;
    }
    let front = area < 0;
    if front {
        area = -area;
        let kept = b;
        b = c;
        c = kept;
    }
    let sample = first * 256 + 128;
    let bc = c.xy - b.xy;
    let ca = a.xy - c.xy;
    let ab = b.xy - a.xy;
    let bias = vec3<i32>(edge_bias(bc), edge_bias(ca), edge_bias(ab));
    var row = bias + vec3<i32>(
        bc.x * (sample.y - b.y) - bc.y * (sample.x - b.x),
        ca.x * (sample.y - c.y) - ca.y * (sample.x - c.x),
        ab.x * (sample.y - a.y) - ab.y * (sample.x - a.x),
    );
    let right = -256 * vec3<i32>(bc.y, ca.y, ab.y);
    let down = 256 * vec3<i32>(bc.x, ca.x, ab.x);
    let z = bitcast<f32>(a.z);
    let rise = vec2<f32>(bitcast<f32>(b.z) - z, bitcast<f32>(c.z) - z) / f32(area);
    for (var y = first.y; y <= last.y; y++) {
        var span = narrowed(vec2<i32>(0, last.x - first.x), row.x, right.x);
        span = narrowed(span, row.y, right.y);
        span = narrowed(span, row.z, right.z);
        for (var x = span.x; x <= span.y; x++) {
            let weights = vec2<f32>(row.yz + x * right.yz - bias.yz);
            let pixel = pixel_index(vec2<u32>(vec2<i32>(first.x + x, y)));
            take(Sample(pixel, z + dot(weights, rise), triangle, part, front, lane_bits));
        }
        row += down;
    }
}
