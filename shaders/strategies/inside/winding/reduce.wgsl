// Decides by winding numbers which crossings are inside an open part, in the squares whose numbers are not settled (`expand`). The lane of
// such a part counts fragments, those of its closing triangles among them; each byte becomes 1 where the part begins to be kept at the crossing
// and is inside it, otherwise 0, as if the part were filled by the nonzero rule and had no closing triangles.
//
// Most numbers are found from the expansion of their square. Where its error leaves a doubt, or there is none, the tree is traversed for a
// crossing alone.
//
// A pixel is marked, by a number of fragments that no byte can count, where a number that decides is as near to a half as its error, and
// where a crossing lies in a closing triangle. An invocation owns a pixel. Cost per crossing at which an open part begins to be kept: the
// closing triangles nearby; in doubt, some hundred nodes and triangles.

#import cutaway::closings::{Closing, FOUR_PI, NO_CLOSING, ROUNDING, Winding, closing_of, solid_angle, winding_of}
#import cutaway::crossings::{cappable, depth_at, head_of, surface_at}
#import cutaway::cuts::{is_removed, parts}
#import cutaway::frame::{centre_of, frame, pixel_count, pixel_index, ray_through}
#import cutaway::lanes::{MOST_CROSSINGS, MOST_LANES}
#import cutaway::local_winding::{MOST_OF_RUN, MOST_RUNS, MOST_SQUARES, NO_EXPANSION, RUN_BITS, SQUARES_OF_TILE, SQUARE_PX, VECTORS_OF_LIST, VECTORS_OF_POLYNOMIAL, corner_of, doubt_at, expansion_at}
#import cutaway::settled::{UNSETTLED, is_filled, settled_at}
#import cutaway::share::pixel_at
#import cutaway::winding::{count_at, may_exceed, sum_and_number}

@group(1) @binding(4) var<storage, read_write> mask: array<u32>;
@group(1) @binding(6) var<storage, read> expansions: array<vec4<u32>>;

override lane_count: u32 = 1u;
override near_inside: bool = false;
// Distance to which rasterisers snap vertices, in pixels.
override snapped_px: f32 = 0.0625;

// Bounds of the error of a ball for a crossing alone, as shares of 4 pi: first, and where that or an expansion leaves a doubt.
const COARSE: f32 = 0.003;
const FINE: f32 = 0.0002;
const MOST_QUERIES: u32 = 2u;
// A number of fragments for which a count may have overflowed.
const OVERFLOWING_COUNT: u32 = 255u;

struct Answer {
    is_inside: bool,
    is_unsure: bool,
}

// Number of a part's closing triangles around a point near the centre of an expansion.
fn number_near(address: u32, runs: u32, point: vec3<f32>, near: f32) -> Winding {
    let first = bitcast<vec4<f32>>(expansions[address]);
    let second = bitcast<vec4<f32>>(expansions[address + 1u]);
    let diagonal = bitcast<vec2<f32>>(expansions[address + 2u].xy);
    let x = point - bitcast<vec3<f32>>(expansions[address + 3u].xyz);
    let squares = x * x;
    let bent = dot(diagonal, squares.xy - squares.z) + dot(second.xyz, x.xxy * x.yzz);
    var angle = first.w + dot(first.xyz, x) + 0.5 * bent;
    var is_unsure = false;
    for (var i = 0u; i < min(runs, MOST_RUNS); i++) {
        let run = expansions[address + VECTORS_OF_POLYNOMIAL + i / 4u][i % 4u];
        for (var j = 0u; j < (run & MOST_OF_RUN); j++) {
            let of_triangle = solid_angle((run >> RUN_BITS) + 3u * j, point, near);
            angle += of_triangle.x;
            is_unsure |= of_triangle.y > 0.0;
        }
    }
    return Winding(angle / FOUR_PI, second.w + ROUNDING, is_unsure);
}

// Whether a part holds a point, whose count sums the fragments behind it.
fn answer_of(place: u32, count: i32, closing: Winding) -> Answer {
    let number = f32(count) - closing.number;
    let whole = round(number);
    let off = abs(number - whole);
    let is_inside = is_filled(parts[place].is_nonzero != 0u, i32(whole), 0);
    // The number on the other side of the nearest half, which matters if the error reaches no other half. A comparison with NaN is false,
    // which is a doubt.
    let other = i32(whole) + select(-1, 1, number > whole);
    let is_either = 0.5 + off > closing.error && is_inside == is_filled(parts[place].is_nonzero != 0u, other, 0);
    let is_clear = 0.5 - off > closing.error || is_either;
    return Answer(is_inside, closing.is_unsure || !is_clear);
}

// Whether a part holds the point of a pixel's ray at a depth, in the square of an expansion.
fn holds(place: u32, closing: Closing, count: i32, at: vec2<u32>, depth: f32, address: u32) -> Answer {
    let ray = ray_through(centre_of(at));
    let point = ray.origin + depth * ray.direction;
    if any(point < closing.least) || any(point > closing.greatest) {
        return Answer(false, false);
    }
    let near = doubt_at(depth, snapped_px);
    let runs = expansions[address + 2u].z;
    let is_expanded = runs != NO_EXPANSION;
    var number = Winding(0.0, 1.0, false);
    if is_expanded {
        number = number_near(address, runs, point, near);
    }
    var answer = answer_of(place, count, number);
    // A finer number does not help where a triangle is too near.
    for (var n = select(0u, 1u, is_expanded); n < MOST_QUERIES && answer.is_unsure && !number.is_unsure; n++) {
        number = winding_of(closing.tree, point, near, select(FINE, COARSE, n == 0u));
        answer = answer_of(place, count, number);
    }
    return answer;
}

// Decides the crossings of a pixel at which a part begins to be kept, or whether it starts inside, where its square has no settled number.
fn reduce(place: u32, at: vec2<u32>, groups: u32) {
    let part = parts[place];
    let closing = closing_of(part.closing);
    let length = arrayLength(&mask);
    let first = part.lane_word * pixel_count() + pixel_index(at);
    var sum = sum_and_number(mask[first]);
    var is_unsure = false;
    if mask[settled_at(length, part.closing, at, false)] == UNSETTLED {
        let expansion = expansion_at(groups, part.closing, at, near_inside, false);
        let head = head_of(at);
        var sides = head.sides;
        var counts = 0u;
        var inside = 0u;
        let cappable = cappable(at);
        let crossings = min(cappable.y, MOST_CROSSINGS);
        for (var i = 0u; i < crossings; i++) {
            let word = first + (i / 4u + 1u) * pixel_count();
            if i % 4u == 0u {
                counts = mask[word];
                inside = 0u;
            }
            let after = sides ^ (1u << surface_at(head, i, at));
            if i >= cappable.x && is_removed(sides, part.cuts) && !is_removed(after, part.cuts) {
                let answer = holds(place, closing, count_at(counts, i % 4u), at, depth_at(head, i, at), expansion);
                inside |= select(0u, 1u, answer.is_inside) << (8u * (i % 4u));
                is_unsure |= answer.is_unsure;
            }
            if i % 4u == 3u || i + 1u == crossings {
                mask[word] = inside;
            }
            sides = after;
        }
        is_unsure |= may_exceed(sum);
    }
    if mask[settled_at(length, part.closing, at, true)] == UNSETTLED {
        let expansion = expansion_at(groups, part.closing, at, near_inside, true);
        let answer = holds(place, closing, sum.x, at, frame.near, expansion);
        is_unsure |= answer.is_unsure || may_exceed(sum);
        sum.x = select(0, 1, answer.is_inside);
    }
    let number = select(bitcast<u32>(sum.y), OVERFLOWING_COUNT, is_unsure);
    mask[first] = bitcast<u32>(sum.x) + (number << 16u);
}

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) invocation: u32,
) {
    let list = group.x * VECTORS_OF_LIST;
    let count = min(expansions[list].x, MOST_SQUARES);
    let pixel = invocation;
    for (var i = 0u; i < count; i++) {
        let square = expansions[list + 1u + i / 4u][i % 4u];
        let corner = corner_of(square) + vec2<u32>(pixel % SQUARE_PX, pixel / SQUARE_PX);
        let at = pixel_at(square / SQUARES_OF_TILE, group, groups, vec3<u32>(corner, 0u));
        if all(at < frame.size_px) {
            for (var place = 0u; place < min(lane_count, MOST_LANES); place++) {
                if parts[place].closing != NO_CLOSING {
                    reduce(place, at, groups.x);
                }
            }
        }
    }
}
