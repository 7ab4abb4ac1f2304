// Covers the samples of one piece of a triangle (`pieces.wgsl`): every n-th of the tiles that the triangle meets in a row of tiles. An
// invocation owns one line of samples.
//
// Work per invocation: at most 256 tiles are tested, and at most `piece_px` + 192 samples are covered.

#define_import_path cutaway::cover

#import cutaway::flat::{depth_at, flat_through}
#import cutaway::piece::{MOST_TILES, Piece, tiles_of}
#import cutaway::sample::take
#import cutaway::screen::{Point, first_pixel, last_pixel}
#import cutaway::sweep::{NO_LANE, Sample, drawn_parts}
#import cutaway::tiles::{edge_value, reaches, row_inside, tile_edge}
#import cutaway::touch::touch
#import cutaway::wide::{wide_cross, wide_float, wide_is_negative}

struct Where {
    piece: Piece,
    // Row of the part in the table of drawn parts.
    row: u32,
    // Line of samples in the tile.
    line: i32,
    // Lane bits of the mask.
    lane_bits: u32,
}

fn cover(a: Point, second: Point, third: Point, at: Where) {
    let first = first_pixel(min(a.steps, min(second.steps, third.steps)));
    let last = last_pixel(max(a.steps, max(second.steps, third.steps)));
    let whole = wide_cross(second.steps - a.steps, third.steps - a.steps);
    let tiles = tiles_of(at.piece, a.steps, second.steps, third.steps, first, last);
    if tiles.count == 0 || (whole.x | whole.y) == 0u {
        return;
    }
    let part = drawn_parts.parts[at.row];
    let turned = wide_is_negative(whole);
    var b = second;
    var c = third;
    if turned {
        b = third;
        c = second;
    }
    let plane = flat_through(a, b, c, abs(wide_float(whole)));
    for (var turn = 0; turn < min(tiles.count, MOST_TILES); turn++) {
        let tile = vec2<i32>(tiles.first + turn * at.piece.columns, at.piece.tile_row);
        let from_px = max(64 * tile, first);
        let span = min(64 * tile + 63, last) - from_px;
        let sample = 256 * from_px + 128;
        let bc = tile_edge(b.steps, c.steps, sample);
        let ca = tile_edge(c.steps, a.steps, sample);
        let ab = tile_edge(a.steps, b.steps, sample);
        if !(reaches(bc, span) && reaches(ca, span) && reaches(ab, span)) {
            continue;
        }
        var row = vec2<i32>(0, select(span.x, -1, at.line > span.y));
        row = row_inside(bc, at.line, row);
        row = row_inside(ca, at.line, row);
        row = row_inside(ab, at.line, row);
        if row.x <= row.y {
            let z = vec3<f32>(a.z, b.z, c.z);
            touch(from_px + vec2<i32>(row.x, at.line), from_px + vec2<i32>(row.y, at.line), z, part.place != NO_LANE);
        }
        for (var n = 0; n < min(row.y - row.x + 1, 64); n++) {
            let step = vec2<i32>(row.x + n, at.line);
            let weights = vec2<f32>(edge_value(ca, step), edge_value(ab, step));
            _ = take(Sample(vec2<u32>(from_px + step), depth_at(plane, weights), at.piece.triangle, at.row, part, turned, at.lane_bits));
        }
    }
}
