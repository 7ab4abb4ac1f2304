// Expands the number of an open part's closing triangles in each square of pixels, around the crossings at which the part begins to be kept.
//
// Within a sphere around these crossings the number of triangles at a distance is a polynomial (`expansion`). Others are listed, and summed
// for each point. Where bounds of the derivatives show that the number stays between the same two halves, one whole number is stored for the
// square instead, which leaves nothing to be done per pixel: in most squares, as numbers are near a half only beside the mesh and its holes.
//
// An invocation owns a square. Cost: for a square with a crossing to be decided, some hundred nodes; among too many triangles no expansion.

#import cutaway::closings::{Closing, NO_CLOSING, closing_of}
#import cutaway::crossings::{cappable, depth_at, head_of, surface_at}
#import cutaway::cuts::{is_removed, parts}
#import cutaway::expansion::{Sphere, expansion}
#import cutaway::frame::frame
#import cutaway::lanes::{MOST_CROSSINGS, MOST_LANES}
#import cutaway::local_sum::{run_count, runs, sum_in}
#import cutaway::local_winding::{MOST_RUNS, MOST_SQUARES, NO_EXPANSION, SQUARES_OF_TILE, SQUARE_PX, VECTORS_OF_LIST, VECTORS_OF_POLYNOMIAL, corner_of, doubt_at, expansion_at, sphere_around}
#import cutaway::settled::{NOTHING, UNSETTLED, settled_at}
#import cutaway::share::{pixel_at, turns}

@group(1) @binding(4) var<storage, read_write> mask: array<u32>;
@group(1) @binding(6) var<storage, read_write> expansions: array<vec4<u32>>;

override lane_count: u32 = 1u;
override near_inside: bool = false;
// Distance to which rasterisers snap vertices, in pixels.
override snapped_px: f32 = 0.0625;

// Invocations whose square is not settled.
var<workgroup> square_count: atomic<u32>;
var<workgroup> squares: array<u32, MOST_SQUARES>;

// Expands a tree's number in a sphere, and returns the word of a settled number. If there is none, stores the expansion.
fn expand(closing: Closing, sphere: Sphere, address: u32) -> u32 {
    if any(sphere.centre + sphere.radius < closing.least) || any(sphere.centre - sphere.radius > closing.greatest) {
        return bitcast<u32>(NOTHING);
    }
    let sum = sum_in(closing.tree, sphere);
    let whole = round(sum.number);
    let is_within = all(sphere.centre - sphere.radius > closing.least) && all(sphere.centre + sphere.radius < closing.greatest);
    if abs(sum.number - whole) + sum.swing < 0.5 && is_within {
        return bitcast<u32>(i32(whole));
    }
    let count = select(NO_EXPANSION, run_count, sum.is_listed);
    expansions[address] = bitcast<vec4<u32>>(vec4<f32>(expansion.gradient, expansion.constant));
    expansions[address + 1u] = bitcast<vec4<u32>>(vec4<f32>(expansion.others, expansion.error));
    expansions[address + 2u] = vec4<u32>(bitcast<vec2<u32>>(expansion.diagonal), count, 0u);
    expansions[address + 3u] = vec4<u32>(bitcast<vec3<u32>>(sphere.centre), 0u);
    for (var i = 0u; i < min(run_count, MOST_RUNS); i += 4u) {
        expansions[address + VECTORS_OF_POLYNOMIAL + i / 4u] = vec4<u32>(runs[i], runs[i + 1u], runs[i + 2u], runs[i + 3u]);
    }
    return UNSETTLED;
}

// A sphere around the points of a square between two depths, and around what is as near to them as rasterisers snap.
fn sphere_of(first: vec2<u32>, depths: vec2<f32>) -> Sphere {
    let sphere = sphere_around(first, SQUARE_PX, depths.x, depths.y);
    return Sphere(sphere.centre, sphere.radius + doubt_at(depths.y, snapped_px));
}

// The least and greatest depth of the crossings in a square at which a part begins to be kept; the first is greater if there is none.
fn depths_in(first: vec2<u32>, cuts: u32) -> vec2<f32> {
    var depths = vec2<f32>(1.0, -1.0) * 3e38;
    for (var pixel = 0u; pixel < SQUARE_PX * SQUARE_PX; pixel++) {
        let at = first + vec2<u32>(pixel % SQUARE_PX, pixel / SQUARE_PX);
        if any(at >= frame.size_px) {
            continue;
        }
        let head = head_of(at);
        var sides = head.sides;
        let cappable = cappable(at);
        let crossings = min(cappable.y, MOST_CROSSINGS);
        for (var i = 0u; i < crossings; i++) {
            let after = sides ^ (1u << surface_at(head, i, at));
            if i >= cappable.x && is_removed(sides, cuts) && !is_removed(after, cuts) {
                let depth = depth_at(head, i, at);
                depths = vec2<f32>(min(depths.x, depth), max(depths.y, depth));
            }
            sides = after;
        }
    }
    return depths;
}

// Finds the numbers of all open parts in a square, and returns true if one is not settled.
fn expand_square(first: vec2<u32>, groups: u32) -> bool {
    var is_unsettled = false;
    for (var place = 0u; place < min(lane_count, MOST_LANES); place++) {
        let part = parts[place];
        if part.closing == NO_CLOSING {
            continue;
        }
        let closing = closing_of(part.closing);
        // A mesh that lies in a plane encloses nothing. Nothing starts inside a part unless the near plane meets it: any total is in doubt.
        var around = bitcast<u32>(NOTHING);
        var near = select(0u, bitcast<u32>(NOTHING), near_inside);
        if !closing.is_flat {
            let depths = depths_in(first, part.cuts);
            if depths.x <= depths.y {
                let address = expansion_at(groups, part.closing, first, near_inside, false);
                around = expand(closing, sphere_of(first, depths), address);
            }
            if near_inside {
                let address = expansion_at(groups, part.closing, first, near_inside, true);
                near = expand(closing, sphere_of(first, vec2<f32>(frame.near)), address);
            }
        }
        let length = arrayLength(&mask);
        mask[settled_at(length, part.closing, first, false)] = around;
        mask[settled_at(length, part.closing, first, true)] = near;
        is_unsettled |= around == UNSETTLED || near == UNSETTLED;
    }
    return is_unsettled;
}

// A workgroup has at most 16 tiles.
@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) invocation: u32,
) {
    let turn = invocation / SQUARES_OF_TILE;
    if turn < turns(group, groups) {
        let first = pixel_at(turn, group, groups, vec3<u32>(corner_of(invocation), 0u));
        if all(first < frame.size_px) && expand_square(first, groups.x) {
            squares[atomicAdd(&square_count, 1u)] = invocation;
        }
    }
    workgroupBarrier();
    let list = group.x * VECTORS_OF_LIST;
    if invocation == 0u {
        expansions[list] = vec4<u32>(atomicLoad(&square_count), 0u, 0u, 0u);
    }
    if invocation < MOST_SQUARES / 4u {
        let i = 4u * invocation;
        expansions[list + 1u + invocation] = vec4<u32>(squares[i], squares[i + 1u], squares[i + 2u], squares[i + 3u]);
    }
}
