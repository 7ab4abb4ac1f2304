// Covers the samples of a triangle of any size, tile by tile. A workgroup takes every eighth row of tiles, an invocation one
// row of samples of each tile.

#define_import_path cutaway::cover

#import cutaway::flat::{depth_at, flat_through}
#import cutaway::sample::take
#import cutaway::screen::{Point, first_pixel, last_pixel}
#import cutaway::sweep::{Sample, drawn_parts}
#import cutaway::tiles::{edge_value, reaches, row_inside, tile_edge}
#import cutaway::touch::touch
#import cutaway::wide::{wide_cross, wide_float, wide_is_negative}

struct Where {
    triangle: u32,
    // Row of the part in the table of drawn parts.
    row: u32,
    // Which rows of tiles, and which line of samples of a tile.
    tiles: i32,
    line: i32,
    // Of the mask.
    lane_bits: u32,
}

fn cover(a: Point, second: Point, third: Point, at: Where) {
    let first = first_pixel(min(a.steps, min(second.steps, third.steps)));
    let last = last_pixel(max(a.steps, max(second.steps, third.steps)));
    let last_tile = last >> vec2<u32>(6u);
    let first_tile = first >> vec2<u32>(6u);
    let first_row = first_tile.y + ((at.tiles - first_tile.y) & 7);
    if any(first > last) || first_row > last_tile.y {
        return;
    }
    let whole = wide_cross(second.steps - a.steps, third.steps - a.steps);
    if (whole.x | whole.y) == 0u {
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
    for (var tile_y = first_row; tile_y <= last_tile.y; tile_y += 8) {
        for (var tile_x = first_tile.x; tile_x <= last_tile.x; tile_x++) {
            let from_px = max(64 * vec2<i32>(tile_x, tile_y), first);
            let span = min(64 * vec2<i32>(tile_x, tile_y) + 63, last) - from_px;
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
                touch(from_px + vec2<i32>(row.x, at.line), from_px + vec2<i32>(row.y, at.line));
            }
            for (var x = row.x; x <= row.y; x++) {
                let step = vec2<i32>(x, at.line);
                let weights = vec2<f32>(edge_value(ca, step), edge_value(ab, step));
                _ = take(Sample(vec2<u32>(from_px + step), depth_at(plane, weights), at.triangle, at.row, part, turned, at.lane_bits));
            }
        }
    }
}
