// Finds the touched tiles of queued triangles. A workgroup owns one piece of one of them (`pieces.wgsl`): four tiles of 64 x 64 samples at
// a time; an invocation owns a sixteenth of one, which is one touched tile. Clipped triangles count for all tiles (`tiles.wgsl`).

#import cutaway::piece::{MOST_TILES, piece_of, tiles_of}
#import cutaway::rows::row_of_triangle
#import cutaway::screen::{first_pixel, last_pixel, point_of}
#import cutaway::sweep::{NO_LANE, corners_of, drawn_parts}
#import cutaway::tiles::{reaches, tile_edge}
#import cutaway::touched::{TILE_PX, tile_at}
#import cutaway::touching::{reach_of, touch_tile, widen}
#import cutaway::wide::{wide_cross, wide_is_negative}

@group(2) @binding(3) var<storage, read> screen: array<vec4<i32>>;

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) invocation: u32,
) {
    let piece = piece_of(group, groups);
    if piece.is_clipped {
        return;
    }
    let part = row_of_triangle(piece.triangle);
    let corners = corners_of(piece.triangle, part);
    let a = point_of(screen[corners.x]);
    var b = point_of(screen[corners.y]);
    var c = point_of(screen[corners.z]);
    let first = first_pixel(min(a.steps, min(b.steps, c.steps)));
    let last = last_pixel(max(a.steps, max(b.steps, c.steps)));
    let tiles = tiles_of(piece, a.steps, b.steps, c.steps, first, last);
    let reach = reach_of(vec3<f32>(a.z, b.z, c.z));
    let is_cut = drawn_parts.parts[part].place != NO_LANE;
    if wide_is_negative(wide_cross(b.steps - a.steps, c.steps - a.steps)) {
        let kept = b;
        b = c;
        c = kept;
    }
    let side = i32(TILE_PX);
    let own = vec2<i32>(i32(invocation & 3u), i32((invocation >> 2u) & 3u));
    for (var turn = 0; turn < min((tiles.count + 3) / 4, MOST_TILES); turn++) {
        let number = 4 * turn + i32(invocation >> 4u);
        let tile = 4 * vec2<i32>(tiles.first + number * piece.columns, piece.tile_row) + own;
        let from_px = max(side * tile, first);
        let span = min(side * tile + side - 1, last) - from_px;
        if number >= tiles.count || any(span < vec2<i32>(0)) {
            continue;
        }
        let sample = 256 * from_px + 128;
        let bc = tile_edge(b.steps, c.steps, sample);
        let ca = tile_edge(c.steps, a.steps, sample);
        let ab = tile_edge(a.steps, b.steps, sample);
        if reaches(bc, span) && reaches(ca, span) && reaches(ab, span) {
            let touched_tile = tile_at(vec2<u32>(tile));
            touch_tile(touched_tile);
            if is_cut {
                widen(touched_tile, reach.x, reach.y);
            }
        }
    }
}
