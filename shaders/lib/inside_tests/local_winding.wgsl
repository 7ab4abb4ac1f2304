// Numbers of closing triangles (`closings`) at points that lie close together: in a square of pixels, from a polynomial and a list of nearby
// triangles, which `strategies/inside/winding/expand` makes and `strategies/inside/winding/reduce` evaluates. Here is what both share: which
// points, and where their expansion is stored.

#define_import_path cutaway::local_winding

#import cutaway::frame::frame

// A crossing nearer to a closing triangle than this may be on either side of its fragment, for rounding: in scene units, and as a share of
// the depth.
const ROUNDED_AWAY: f32 = 4e-6;
const ROUNDED_DEPTH: f32 = 2.4e-7;
// Side of a square in pixels.
const SQUARE_PX: u32 = 8u;
// An expansion: four vectors for the polynomial and its centre, with the number of runs of listed triangles, then the runs, four to a vector:
// the address of the first triangle, and their number in the lowest bits.
const MOST_RUNS: u32 = 48u;
const RUN_BITS: u32 = 6u;
const MOST_OF_RUN: u32 = 63u;
const VECTORS_OF_POLYNOMIAL: u32 = 4u;
const VECTORS_OF_EXPANSION: u32 = 16u;
// In place of a number of runs: there are too many.
const NO_EXPANSION: u32 = 0xffffffffu;

// Address of an expansion in the square of a pixel, for one of `closing_count` open parts: around its crossings, or the near plane.
fn expansion_at(closing: u32, closing_count: u32, at: vec2<u32>, is_near: bool) -> u32 {
    let squares = (frame.size_px + SQUARE_PX - 1u) / SQUARE_PX;
    let square = at.y / SQUARE_PX * squares.x + at.x / SQUARE_PX;
    let first = select(0u, squares.x * squares.y, is_near);
    return ((first + square) * closing_count + closing) * VECTORS_OF_EXPANSION;
}

// Distance from a triangle within which a point at a depth may be on either side, if rasterisers snap vertices to `snapped_px`.
fn doubt_at(depth: f32, snapped_px: f32) -> f32 {
    let step = length(frame.ray_step[0].xyz) * select(depth, 1.0, frame.orthographic != 0u);
    return ROUNDED_AWAY + ROUNDED_DEPTH * depth + snapped_px * step;
}
