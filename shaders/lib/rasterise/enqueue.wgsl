// Fills a screen's queue. Used by the pass that processes the screen's triangles first. Bound as @group(2) @binding(4).

#define_import_path cutaway::enqueue

#import cutaway::pieces::{Pieces, piece_count, pieces_of}
#import cutaway::queue::{CLIPPED, first_piece_at, packed, queued_at}
#import cutaway::screen::{Point, cross2}
#import cutaway::sweep::sweep

@group(2) @binding(4) var<storage, read_write> queue: array<atomic<u32>>;

// True if a triangle is too large for one invocation, judged by its box in steps.
fn is_large(low: vec2<i32>, high: vec2<i32>, small_px: i32) -> bool {
    return any(high - low > vec2<i32>(small_px * 256));
}

fn put(triangle: u32, pieces: Pieces) {
    let place = atomicAdd(&queue[0], 1u);
    let at = queued_at(place);
    atomicStore(&queue[at], triangle);
    atomicStore(&queue[at + 1u], packed(pieces));
    atomicStore(&queue[first_piece_at(place, sweep.triangle_count)], piece_count(pieces));
}

// Queues a triangle with these corners and this box.
fn enqueue(triangle: u32, a: Point, b: Point, c: Point, low: vec2<i32>, high: vec2<i32>, piece_px: f32) {
    let height_px = max(f32(high.y - low.y) / 256.0, 1.0);
    let width_px = abs(cross2(b.at - a.at, c.at - a.at)) / height_px;
    put(triangle, pieces_of(low, high, width_px, piece_px));
}

// Queues a clipped triangle: its pieces are found by the clipping pass.
fn enqueue_clipped(triangle: u32) {
    put(triangle | CLIPPED, Pieces(0, 0, 0));
}
