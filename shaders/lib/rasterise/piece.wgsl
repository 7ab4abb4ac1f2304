// The piece of a queued triangle that a workgroup owns, and the tiles of the piece. Bound as @group(2) @binding(4).

#define_import_path cutaway::piece

#import cutaway::queue::{CLIPPED, columns_of, first_piece_at, first_row_of, queued_at}
#import cutaway::sweep::sweep

@group(2) @binding(4) var<storage, read> queue: array<u32>;

struct Piece {
    triangle: u32,
    is_clipped: bool,
    // Row of tiles of 64 x 64 samples, and the piece's tiles in it: those that leave the remainder `column` when divided by `columns`.
    tile_row: i32,
    column: i32,
    columns: i32,
}

// Upper bound on the tiles in a row of the guard band.
const MOST_TILES: i32 = 256;

// Queue index of the triangle that a piece belongs to: the last one whose first piece is at or before it.
fn owner_of(piece: u32, count: u32) -> u32 {
    var place = 0u;
    for (var step = 0u; step < 24u; step++) {
        let ahead = place + (1u << (23u - step));
        if ahead < count && queue[first_piece_at(ahead, sweep.triangle_count)] <= piece {
            place = ahead;
        }
    }
    return place;
}

// The piece that a workgroup owns. The last workgroups may be beyond all pieces: then the row is beyond that of the last triangle.
fn piece_of(group: vec3<u32>, groups: vec3<u32>) -> Piece {
    let piece = group.y * groups.x + group.x;
    let place = owner_of(piece, min(queue[0], sweep.triangle_count));
    let entry = queue[queued_at(place)];
    let shape = queue[queued_at(place) + 1u];
    let own = piece - queue[first_piece_at(place, sweep.triangle_count)];
    let columns = max(columns_of(shape), 1u);
    let row = i32(first_row_of(shape) + own / columns);
    return Piece(entry & ~CLIPPED, (entry & CLIPPED) != 0u, row, i32(own % columns), i32(columns));
}

// Tiles of a piece: the first, and the number of further tiles, `columns` apart.
struct Tiles {
    first: i32,
    count: i32,
}

// Least and greatest x, in steps, of an edge between two values of y; empty if the edge does not reach them.
fn extent_between(from_point: vec2<i32>, to_point: vec2<i32>, heights: vec2<i32>) -> vec2<f32> {
    let rises = to_point.y >= from_point.y;
    let p = select(to_point, from_point, rises);
    let q = select(from_point, to_point, rises);
    if q.y < heights.x || p.y > heights.y {
        return vec2<f32>(1e30, -1e30);
    }
    let slope = f32(q.x - p.x) / f32(max(q.y - p.y, 1));
    let cut = vec2<f32>(clamp(heights, vec2<i32>(p.y), vec2<i32>(q.y)) - p.y) * slope + f32(p.x);
    let ends = vec2<f32>(vec2<i32>(min(p.x, q.x), max(p.x, q.x)));
    // A level edge spans both of its ends.
    return select(clamp(vec2<f32>(min(cut.x, cut.y), max(cut.x, cut.y)), ends.xx, ends.yy), ends, p.y == q.y);
}

// The tiles of a piece that a triangle meets, with one pixel of margin for rounding. `first` and `last` are the pixels of its box.
fn tiles_of(piece: Piece, a: vec2<i32>, b: vec2<i32>, c: vec2<i32>, first: vec2<i32>, last: vec2<i32>) -> Tiles {
    if any(first > last) || (first.y >> 6u) > piece.tile_row || piece.tile_row > (last.y >> 6u) {
        return Tiles(0, 0);
    }
    let heights = vec2<i32>(piece.tile_row, piece.tile_row + 1) * (64 * 256);
    let ab = extent_between(a, b, heights);
    let bc = extent_between(b, c, heights);
    let ca = extent_between(c, a, heights);
    let extent = vec2<f32>(min(ab.x, min(bc.x, ca.x)) - 256.0, max(ab.y, max(bc.y, ca.y)) + 256.0);
    let met = vec2<i32>(clamp(floor(extent / 16384.0), vec2<f32>(-1.0), vec2<f32>(f32(MOST_TILES))));
    let first_met = max(met.x, first.x >> 6u);
    let count = min(met.y, last.x >> 6u) - first_met + 1;
    // Advances to the first tile with the piece's remainder.
    let skipped = (piece.column + piece.columns - first_met % piece.columns) % piece.columns;
    return Tiles(first_met + skipped, clamp((count - skipped + piece.columns - 1) / piece.columns, 0, MOST_TILES));
}
