// Edge functions of a triangle of any size, exact over a tile of 64 x 64 samples.
//
// An edge function at a sample takes 48 bits, but samples are 256 steps apart: with e0 at the tile's first sample,
// e0 + 256 n >= 0 is floor(e0 / 256) + n >= 0. So the 64 bits are needed once per edge and tile; from there 32 suffice.

#define_import_path cutaway::tiles

#import cutaway::screen::edge_bias
#import cutaway::span::narrowed
#import cutaway::wide::{FARTHEST, wide_cross, wide_float, wide_floor}

struct TileEdge {
    // Direction of the edge, in steps.
    direction: vec2<i32>,
    // floor(e0 / 256), and the remainder of e0.
    floor: i32,
    rest: u32,
    // floor((e0 + bias) / 256): only its sign is used.
    biased: i32,
    // e0, rounded.
    rounded: f32,
}

fn tile_edge(from_point: vec2<i32>, to_point: vec2<i32>, sample: vec2<i32>) -> TileEdge {
    let direction = to_point - from_point;
    let value = wide_cross(direction, sample - from_point);
    let floor = wide_floor(value);
    let rest = value.x & 0xffu;
    let biased = floor + select(0, edge_bias(direction), rest == 0u);
    return TileEdge(direction, floor, rest, biased, wide_float(value));
}

// Growth of the edge function, in 256ths, after `step` samples.
fn growth(edge: TileEdge, step: vec2<i32>) -> i32 {
    return edge.direction.x * step.y - edge.direction.y * step.x;
}

// True if some sample of the tile, up to `span` samples from the first one, is inside.
fn reaches(edge: TileEdge, span: vec2<i32>) -> bool {
    return edge.biased + max(edge.direction.x * span.y, 0) + max(-edge.direction.y * span.x, 0) >= 0;
}

// The samples of a row from span.x to span.y that are inside.
fn row_inside(edge: TileEdge, row: i32, span: vec2<i32>) -> vec2<i32> {
    return narrowed(span, edge.biased + edge.direction.x * row, -edge.direction.y);
}

// The edge function, rounded once if 32 bits can hold it.
fn edge_value(edge: TileEdge, step: vec2<i32>) -> f32 {
    let grown = growth(edge, step);
    if abs(edge.floor) < FARTHEST {
        return f32(edge.floor + grown) * 256.0 + f32(edge.rest);
    }
    return edge.rounded + 256.0 * f32(grown);
}
