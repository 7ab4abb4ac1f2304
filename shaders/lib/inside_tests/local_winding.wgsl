// Numbers of closing triangles (`closings`) at points that lie close together: in a square of pixels, from a polynomial and a list of nearby
// triangles, which `strategies/inside/winding/expand` makes and `strategies/inside/winding/reduce` evaluates. Here is what both share: which
// points, and where their expansion is stored.

#define_import_path cutaway::local_winding

#import cutaway::expansion::Sphere
#import cutaway::frame::{centre_of, frame, ray_through}

// A crossing nearer to a closing triangle than this may be on either side of its fragment, for rounding: in scene units, and as a share of
// the depth.
const ROUNDED_AWAY: f32 = 4e-6;
const ROUNDED_DEPTH: f32 = 2.4e-7;
// Side of a square in pixels, and squares of a tile.
const SQUARE_PX: u32 = 8u;
const SQUARES_OF_TILE: u32 = 4u;
// An expansion: four vectors for the polynomial and its centre, with the number of runs of listed triangles, then the runs, four to a vector:
// the address of the first triangle, and their number in the lowest bits.
const MOST_RUNS: u32 = 48u;
const RUN_BITS: u32 = 6u;
const MOST_OF_RUN: u32 = 63u;
const VECTORS_OF_POLYNOMIAL: u32 = 4u;
const VECTORS_OF_EXPANSION: u32 = 16u;
// In place of a number of runs: there are too many.
const NO_EXPANSION: u32 = 0xffffffffu;
// Before the expansions, the squares of each workgroup of `expand` in which some part has no settled number: their number, then the
// invocations that found them, four to a vector.
const MOST_SQUARES: u32 = 64u;
const VECTORS_OF_LIST: u32 = 17u;

// Number of squares in the picture, in rows of `squares_of_row`.
fn square_count() -> u32 {
    return squares_of_row() * ((frame.size_px.y + SQUARE_PX - 1u) / SQUARE_PX);
}

fn squares_of_row() -> u32 {
    return (frame.size_px.x + SQUARE_PX - 1u) / SQUARE_PX;
}

// Number of the square of a pixel.
fn square_of(at: vec2<u32>) -> u32 {
    return at.y / SQUARE_PX * squares_of_row() + at.x / SQUARE_PX;
}

// First pixel of the square of an invocation of `expand`, in the tile of its turn.
fn corner_of(invocation: u32) -> vec2<u32> {
    return SQUARE_PX * vec2<u32>(invocation % 2u, invocation / 2u % 2u);
}

// Address of an expansion in the square of a pixel, behind the lists of `groups` workgroups: around its crossings, or where `near_inside`
// requires it, at the near plane.
fn expansion_at(groups: u32, closing: u32, at: vec2<u32>, near_inside: bool, is_near: bool) -> u32 {
    let plane = select(closing, 2u * closing + select(0u, 1u, is_near), near_inside);
    return groups * VECTORS_OF_LIST + (plane * square_count() + square_of(at)) * VECTORS_OF_EXPANSION;
}

// A sphere around the points of a square of pixels between two depths.
fn sphere_around(first: vec2<u32>, side_px: u32, nearest: f32, farthest: f32) -> Sphere {
    var corners: array<vec3<f32>, 8>;
    var sum = vec3<f32>(0.0);
    for (var i = 0u; i < 8u; i++) {
        let corner = vec2<u32>(i & 1u, (i >> 1u) & 1u) * (side_px - 1u);
        let ray = ray_through(centre_of(first + corner));
        corners[i] = ray.origin + select(nearest, farthest, i >= 4u) * ray.direction;
        sum += corners[i];
    }
    let centre = sum / 8.0;
    var radius = 0.0;
    for (var i = 0u; i < 8u; i++) {
        radius = max(radius, distance(centre, corners[i]));
    }
    return Sphere(centre, 1.0001 * radius);
}

// Distance from a triangle within which a point at a depth may be on either side, if rasterisers snap vertices to `snapped_px`.
fn doubt_at(depth: f32, snapped_px: f32) -> f32 {
    let step = length(frame.ray_step[0].xyz) * select(depth, 1.0, frame.orthographic != 0u);
    return ROUNDED_AWAY + ROUNDED_DEPTH * depth + snapped_px * step;
}
