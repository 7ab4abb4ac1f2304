// Covers the samples of small triangles, and queues the others. One invocation owns one triangle.
//
// If a box holds no sample the invocation ends before any multiplication: in a fine mesh this is the case for most triangles. A side of at
// most 2^14 steps keeps edge functions below 2^30 in magnitude. The first sweep lists the triangles with a sample that needs another visit,
// and a later one visits only those.

#import cutaway::enqueue::{enqueue, enqueue_clipped, is_large, queue}
#import cutaway::flat::{depth_at, flat_through}
#import cutaway::queue::again_at
#import cutaway::rows::row_of_triangle
#import cutaway::sample::take
#import cutaway::screen::{edge_bias, first_pixel, is_beside, is_clipped, last_pixel, point_of}
#import cutaway::span::narrowed
#import cutaway::sweep::{NO_LANE, Sample, corners_of, drawn_parts, number_of, sweep}
#import cutaway::touch::touch

override lane_bits: u32 = 32u;
// Longest side of the box of a small triangle, in pixels.
override small_px: i32 = 64;
const MOST_SMALL_PX: i32 = 65;
// Maximum number of samples in a line of one piece of a queued triangle, plus up to three tiles.
override piece_px: f32 = 512.0;
// True if no earlier pass has filled the queue.
override fills_queue: bool = true;

@group(2) @binding(3) var<storage, read> screen: array<vec4<i32>>;
fn come_again(triangle: u32) {
    if sweep.again == 0u {
        let place = atomicAdd(&queue[1], 1u);
        atomicStore(&queue[again_at(place, sweep.triangle_count)], triangle);
    }
}

fn visit(triangle: u32) {
    let row_of_part = row_of_triangle(triangle);
    let part = drawn_parts.parts[row_of_part];
    let corners = corners_of(triangle, row_of_part);
    let vertices = array<vec4<i32>, 3>(screen[corners.x], screen[corners.y], screen[corners.z]);
    // A clipped triangle has no points: results computed from them are ignored.
    let is_clipped = is_clipped(vertices);
    let a = point_of(vertices[0]);
    var b = point_of(vertices[1]);
    var c = point_of(vertices[2]);
    let low = min(a.steps, min(b.steps, c.steps));
    let high = max(a.steps, max(b.steps, c.steps));
    let first = first_pixel(low);
    let last = last_pixel(high);
    if is_beside(vertices) || (any(first > last) && !is_clipped) {
        return;
    }
    if is_clipped || is_large(low, high, small_px) {
        if fills_queue && sweep.again == 0u {
            if is_clipped {
                enqueue_clipped(triangle);
            } else {
                enqueue(triangle, a, b, c, low, high, piece_px);
            }
        }
        return;
    }
    var area = (b.steps.x - a.steps.x) * (c.steps.y - a.steps.y) - (b.steps.y - a.steps.y) * (c.steps.x - a.steps.x);
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
    let bc = c.steps - b.steps;
    let ca = a.steps - c.steps;
    let ab = b.steps - a.steps;
    let bias = vec3<i32>(edge_bias(bc), edge_bias(ca), edge_bias(ab));
    touch(first, last, vec3<f32>(a.z, b.z, c.z), part.place != NO_LANE);
    var row = bias + vec3<i32>(
        bc.x * (sample.y - b.steps.y) - bc.y * (sample.x - b.steps.x),
        ca.x * (sample.y - c.steps.y) - ca.y * (sample.x - c.steps.x),
        ab.x * (sample.y - a.steps.y) - ab.y * (sample.x - a.steps.x),
    );
    let right = -256 * vec3<i32>(bc.y, ca.y, ab.y);
    let down = 256 * vec3<i32>(bc.x, ca.x, ab.x);
    let plane = flat_through(a, b, c, f32(area));
    var is_wanted = false;
    for (var line = 0; line < min(last.y - first.y + 1, MOST_SMALL_PX); line++) {
        var span = narrowed(vec2<i32>(0, last.x - first.x), row.x, right.x);
        span = narrowed(span, row.y, right.y);
        span = narrowed(span, row.z, right.z);
        for (var n = 0; n < min(span.y - span.x + 1, MOST_SMALL_PX); n++) {
            let x = span.x + n;
            let weights = vec2<f32>(row.yz + x * right.yz - bias.yz);
            let at = vec2<u32>(first + vec2<i32>(x, line));
            is_wanted |= take(Sample(at, depth_at(plane, weights), triangle, row_of_part, part, front, lane_bits));
        }
        row += down;
    }
    if is_wanted {
        come_again(triangle);
    }
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let number = number_of(id);
    if number >= sweep.triangle_count {
        return;
    }
    var triangle = number;
    if sweep.again != 0u {
        if number >= atomicLoad(&queue[1]) {
            return;
        }
        triangle = atomicLoad(&queue[again_at(number, sweep.triangle_count)]);
    }
    visit(triangle);
}
