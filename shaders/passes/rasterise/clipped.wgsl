// Finds the pieces of queued triangles that cross the near plane or the guard band, from the box of the clipped polygon. One invocation
// owns one queued triangle.
//
// The polygon is recomputed where its pieces are covered, by another pipeline, whose rounding may differ: the box has one pixel of margin.

#import cutaway::outline::outline_of
#import cutaway::pieces::{piece_count, pieces_of}
#import cutaway::queue::{CLIPPED, first_piece_at, packed, queued_at}
#import cutaway::rows::row_of_triangle
#import cutaway::sweep::{corners_of, number_of, sweep}

// Maximum number of samples in a line of one piece, plus up to three tiles.
override piece_px: f32 = 512.0;

@group(2) @binding(3) var<storage, read> screen: array<vec4<i32>>;
@group(2) @binding(4) var<storage, read_write> queue: array<u32>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let place = number_of(id);
    if place >= min(queue[0], sweep.triangle_count) {
        return;
    }
    let entry = queue[queued_at(place)];
    if (entry & CLIPPED) == 0u {
        return;
    }
    let triangle = entry & ~CLIPPED;
    let corners = corners_of(triangle, row_of_triangle(triangle));
    var outline = outline_of(array<vec4<i32>, 3>(screen[corners.x], screen[corners.y], screen[corners.z]));
    var low = outline.points[0].steps;
    var high = low;
    for (var k = 1u; k < min(outline.count, 8u); k++) {
        low = min(low, outline.points[k].steps);
        high = max(high, outline.points[k].steps);
    }
    var pieces = pieces_of(low - 256, high + 256, f32(high.x - low.x) / 256.0, piece_px);
    if outline.count < 3u {
        pieces.rows = 0;
    }
    queue[queued_at(place) + 1u] = packed(pieces);
    queue[first_piece_at(place, sweep.triangle_count)] = piece_count(pieces);
}
