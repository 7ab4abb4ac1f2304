// The inside test `winding`: parts that are open are judged by their generalised winding number, other parts as by `mask`.
//
// Closing triangles make an open part a closed mesh, whose fragments are counted like those of a part that is filled by the nonzero rule. The
// winding number of the part itself is the count at a crossing less that of its closing triangles, which is their solid angle over 4 pi. It
// is summed over a tree of balls in depth-first order: a ball that is far away for its size counts by its dipole and quadrupole, and adds the
// bound of its error; a leaf counts triangle by triangle. Derivation and bounds: `src/scene/winding`.
//
// A pixel is in doubt where a number that decides is as near to a half as its error, where a crossing lies in a closing triangle, and where a
// count may have overflowed. Cost per crossing at which an open part begins to be kept: some ten nodes, more among many closing triangles.
// Bound as @group(1) @binding(6).

#define_import_path cutaway::inside

#import cutaway::crossings::{depth_at, listed, head_of}
#import cutaway::cuts::{is_removed, parts}
#import cutaway::frame::{centre_of, frame, ray_through}
#import cutaway::lanes::{Lanes, MOST_LANES, WINDING}
#import cutaway::parity::{is_odd_at, is_odd_in_all, is_zero, word_at}
#import cutaway::winding::{count_at, may_exceed, sum_and_number}

// Trees of nodes of four vectors: centre and radius; area vector and bound of the error; diagonal of the moment, and the address of the next
// node that is not below this one; doubled other elements of the moment, and for a leaf the address and number of its triangles, of three
// vectors each. Addresses count vectors from the start of a tree.
@group(1) @binding(6) var<storage, read> closings: array<vec4<u32>>;

const NO_TREE: u32 = 0xffffffffu;
const COUNT_BITS: u32 = 3u;
// Most nodes that one query visits; a number that would need more is in doubt.
const MOST_NODES: u32 = 4096u;
const MOST_LEAF: u32 = 7u;
// A ball is opened where the bound of its error, as a share of 4 pi, is greater.
const TOLERANCE: f32 = 2e-4;
// Bound of the error of sums in f32.
const ROUNDING: f32 = 1e-4;
const FOUR_PI: f32 = 12.566370614;
// A crossing nearer to a closing triangle than this part of a pixel may be on either side of its fragment: rasterisers snap vertices.
const SNAPPED_PX: f32 = 0.0625;
const NEAR_TRIANGLE: f32 = 4e-6;

// True once a number that decided something about this pixel was in doubt.
var<private> is_unsure: bool = false;

struct Sum {
    angle: f32,
    error: f32,
}

fn floats(at: u32) -> vec4<f32> {
    return bitcast<vec4<f32>>(closings[at]);
}

// Solid angle of a triangle, positive from inside (van Oosterom & Strackee 1983). `near` is the distance within which its sign is in doubt.
fn solid_angle(first: u32, point: vec3<f32>, near: f32) -> f32 {
    let a = floats(first).xyz - point;
    let b = floats(first + 1u).xyz - point;
    let c = floats(first + 2u).xyz - point;
    let la = length(a);
    let lb = length(b);
    let lc = length(c);
    let volume = dot(a, cross(b, c));
    let reach = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
    if reach < 0.0 && abs(volume) < near * length(cross(b - a, c - a)) {
        is_unsure = true;
    }
    return 2.0 * atan2(volume, reach);
}

// Solid angle of the triangles of a tree.
fn solid_angle_of(tree: u32, point: vec3<f32>, near: f32) -> Sum {
    let end = tree + closings[tree + 2u].w;
    var sum = Sum(0.0, ROUNDING);
    var at = tree;
    for (var n = 0u; n < MOST_NODES && at < end; n++) {
        let ball = floats(at);
        let flux = floats(at + 1u);
        let diagonal = closings[at + 2u];
        let next = tree + diagonal.w;
        let away = ball.xyz - point;
        let distance = length(away);
        let gap = distance - ball.w;
        let error = flux.w / (gap * gap * gap * gap);
        let others = closings[at + 3u];
        if gap > 0.0 && error <= TOLERANCE {
            let on = bitcast<vec3<f32>>(diagonal.xyz);
            let off = bitcast<vec3<f32>>(others.xyz);
            let along = away / distance;
            let moment = dot(on, along * along) + dot(off, along.xxy * along.yzz);
            let quadrupole = (on.x + on.y + on.z - 3.0 * moment) / distance;
            sum.angle += (dot(flux.xyz, along) + quadrupole) / (distance * distance);
            sum.error += error;
            at = next;
        } else if others.w != 0u {
            let first = tree + (others.w >> COUNT_BITS);
            let count = others.w & MOST_LEAF;
            for (var i = 0u; i < min(count, MOST_LEAF); i++) {
                sum.angle += solid_angle(first + 3u * i, point, near);
            }
            at = next;
        } else {
            at += 4u;
        }
    }
    is_unsure |= at < end;
    return sum;
}

// Whether a part holds a point of a pixel's ray: `count` sums the fragments behind it, those of closing triangles among them.
fn holds(place: u32, count: i32, pixel: u32, depth: f32) -> bool {
    let at = vec2<u32>(pixel % frame.size_px.x, pixel / frame.size_px.x);
    let ray = ray_through(centre_of(at));
    let point = ray.origin + depth * ray.direction;
    let step = length(frame.ray_step[0].xyz) * select(depth, 1.0, frame.orthographic != 0u);
    let sum = solid_angle_of(parts[place].tree, point, NEAR_TRIANGLE + SNAPPED_PX * step);
    let number = f32(count) - sum.angle / FOUR_PI;
    let whole = round(number);
    is_unsure |= 0.5 - abs(number - whole) <= sum.error;
    let counted = i32(whole);
    return select((counted & 1) != 0, counted != 0, parts[place].is_nonzero != 0u);
}

// Whether a pixel has no fragments and no crossings: then nothing is inside anything.
fn is_blank(pixel: u32) -> bool {
    let at = vec2<u32>(pixel % frame.size_px.x, pixel / frame.size_px.x);
    return is_zero(pixel) && listed(head_of(at).x) == 0u;
}

fn is_inside(place: u32, pixel: u32, crossing: u32) -> bool {
    let part = parts[place];
    if part.lane_shift != WINDING {
        return is_odd_at(place, pixel, crossing);
    }
    let count = count_at(word_at(part.lane_word + 1u + crossing / 4u, pixel), crossing % 4u);
    if part.tree == NO_TREE {
        return count != 0;
    }
    let at = vec2<u32>(pixel % frame.size_px.x, pixel / frame.size_px.x);
    return holds(place, count, pixel, depth_at(crossing, at));
}

// Whether the ray of a pixel starts inside a part. Where it cannot, all fragments of a part must cancel.
fn starts_inside(lanes: Lanes, place: u32, pixel: u32) -> bool {
    let part = parts[place];
    if part.lane_shift != WINDING {
        return is_odd_in_all(lanes, place, pixel);
    }
    let sum = sum_and_number(word_at(part.lane_word, pixel)).x;
    if part.tree == NO_TREE || !lanes.near_inside {
        return sum != 0;
    }
    return holds(place, sum, pixel, frame.near);
}

// The first part-table index, from `place` on, of a part that a crossing of a pixel is inside, or the number of parts. Open parts that do not
// begin to be kept at the crossing, between the given sides, are passed over.
fn next_inside(lanes: Lanes, place: u32, pixel: u32, crossing: u32, sides: u32, after: u32) -> u32 {
    for (var p = place; p < min(lanes.count, MOST_LANES); p++) {
        let cuts = parts[p].cuts;
        let begins = is_removed(sides, cuts) && !is_removed(after, cuts);
        if begins && is_inside(p, pixel, crossing) {
            return p;
        }
    }
    return lanes.count;
}

// The first part-table index, from `place` on, of a part in which the pixel's ray starts, or the number of parts.
fn next_starting(lanes: Lanes, place: u32, pixel: u32) -> u32 {
    for (var p = place; p < min(lanes.count, MOST_LANES); p++) {
        if starts_inside(lanes, p, pixel) {
            return p;
        }
    }
    return lanes.count;
}

// Whether the answers for a pixel may be wrong.
fn in_doubt(lanes: Lanes, pixel: u32) -> bool {
    for (var place = 0u; place < min(lanes.count, MOST_LANES); place++) {
        let part = parts[place];
        if part.lane_shift == WINDING && may_exceed(sum_and_number(word_at(part.lane_word, pixel))) {
            return true;
        }
    }
    return is_unsure;
}
