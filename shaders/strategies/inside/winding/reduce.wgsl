// Decides by winding numbers which crossings are inside an open part. The lane of such a part counts fragments, those of its closing
// triangles among them; each byte becomes 1 where the part begins to be kept at the crossing and is inside it, otherwise 0, as if the part
// were filled by the nonzero rule.
//
// A pixel is marked, by a number of fragments that no byte can count, where a number that decides is as near to a half as its error, and
// where a crossing lies in a closing triangle. An invocation owns a pixel. Cost per crossing at which an open part begins to be kept:
// nothing in cells with one number, otherwise some hundred nodes and triangles, more among many.

#import cutaway::closings::{NO_GRID, VARIES, cell_at, grid_of, winding_of}
#import cutaway::crossings::{cappable, depth_at, head_of, surface_at}
#import cutaway::cuts::{is_removed, parts}
#import cutaway::frame::{centre_of, frame, pixel_count, pixel_index, ray_through}
#import cutaway::lanes::{MOST_CROSSINGS, MOST_LANES}
#import cutaway::share::{pixel_at, turns}
#import cutaway::winding::{count_at, may_exceed, sum_and_number}

@group(1) @binding(4) var<storage, read_write> mask: array<u32>;
@group(1) @binding(6) var<storage, read> closing_cells: array<i32>;

override lane_count: u32 = 1u;
override near_inside: bool = false;

// A crossing nearer to a closing triangle than this may be on either side of its fragment, in pixels: rasterisers snap vertices.
override snapped_px: f32 = 0.0625;
// The same in scene units, for rounding, and as a share of the depth.
const ROUNDED_AWAY: f32 = 4e-6;
const ROUNDED_DEPTH: f32 = 2.4e-7;
// The same as a share of a cell: cells are filled for points that far outside of them.
const AROUND_CELL: f32 = 0.04;
// Bounds of the error of a ball, as shares of 4 pi: in the first round, and from one to the next.
const COARSEST: f32 = 0.003;
const FINER: f32 = 0.0666;
const MOST_QUERIES: u32 = 2u;
// A number of fragments for which a count may have overflowed.
const OVERFLOWING_COUNT: u32 = 255u;

struct Answer {
    is_inside: bool,
    is_unsure: bool,
}

// Whether a part's fill rule counts a winding number as inside.
fn is_filled(place: u32, number: i32) -> bool {
    return select((number & 1) != 0, number != 0, parts[place].is_nonzero != 0u);
}

// Whether a part holds the point of a pixel's ray at a depth. `count` sums the fragments behind it. Most points lie in a
// cell with one number, and most others are decided by a coarse number; only where its error leaves a doubt is a finer one found.
fn holds(place: u32, count: i32, at: vec2<u32>, depth: f32) -> Answer {
    let ray = ray_through(centre_of(at));
    let point = ray.origin + depth * ray.direction;
    let step = length(frame.ray_step[0].xyz) * select(depth, 1.0, frame.orthographic != 0u);
    let grid = grid_of(parts[place].grid);
    if grid.counts.x == 0u {
        // A mesh that lies in a plane encloses nothing.
        return Answer(false, false);
    }
    let near = ROUNDED_AWAY + ROUNDED_DEPTH * depth + snapped_px * step;
    let cell = cell_at(grid, point);
    if cell.is_in && near < AROUND_CELL * grid.cell {
        let whole = closing_cells[cell.number];
        if whole != VARIES {
            return Answer(is_filled(place, count - whole), false);
        }
    }
    var answer = Answer(false, true);
    var ball_error = COARSEST;
    for (var round_of = 0u; round_of < MOST_QUERIES && answer.is_unsure; round_of++) {
        let closing = winding_of(grid.tree, point, near, ball_error);
        let number = f32(count) - closing.number;
        let whole = round(number);
        answer.is_inside = is_filled(place, i32(whole));
        // The number on the other side of the nearest half; a comparison with NaN is false, which is a doubt.
        let other = i32(whole) + select(-1, 1, number > whole);
        let is_clear = 0.5 - abs(number - whole) > closing.error || answer.is_inside == is_filled(place, other);
        answer.is_unsure = !is_clear;
        if closing.is_unsure {
            answer.is_unsure = true;
            break;
        }
        ball_error *= FINER;
    }
    return answer;
}

fn reduce(place: u32, at: vec2<u32>) {
    let part = parts[place];
    let first = part.lane_word * pixel_count() + pixel_index(at);
    var sum = sum_and_number(mask[first]);
    var is_unsure = false;
    var sides = head_of(at).y;
    var counts = 0u;
    var inside = 0u;
    let crossings = min(cappable(at), MOST_CROSSINGS);
    for (var i = 0u; i < crossings; i++) {
        let word = first + (i / 4u + 1u) * pixel_count();
        if i % 4u == 0u {
            counts = mask[word];
            inside = 0u;
        }
        let after = sides ^ (1u << surface_at(i, at));
        if is_removed(sides, part.cuts) && !is_removed(after, part.cuts) {
            let answer = holds(place, count_at(counts, i % 4u), at, depth_at(i, at));
            inside |= select(0u, 1u, answer.is_inside) << (8u * (i % 4u));
            is_unsure |= answer.is_unsure;
        }
        if i % 4u == 3u || i + 1u == crossings {
            mask[word] = inside;
        }
        sides = after;
    }
    is_unsure |= may_exceed(sum);
    if near_inside {
        let answer = holds(place, sum.x, at, frame.near);
        sum.x = select(0, 1, answer.is_inside);
        is_unsure |= answer.is_unsure;
    }
    let number = select(bitcast<u32>(sum.y), OVERFLOWING_COUNT, is_unsure);
    mask[first] = bitcast<u32>(sum.x) + (number << 16u);
}

@compute @workgroup_size(16, 16)
fn main(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_id) local: vec3<u32>,
) {
    let end = turns(group, groups);
    for (var turn = 0u; turn < end; turn++) {
        let at = pixel_at(turn, group, groups, local);
        if all(at < frame.size_px) {
            for (var place = 0u; place < min(lane_count, MOST_LANES); place++) {
                if parts[place].grid != NO_GRID {
                    reduce(place, at);
                }
            }
        }
    }
}
