// Computes the position of each border's stroke in the pixel. An invocation processes one pixel at a time: its right and lower borders.
//
// Borders lie between samples, so a slanting edge is a staircase of borders that moves by whole pixels while the edge moves smoothly. The
// edge is reconstructed as the straight line between the middles of the steps at both ends of a run (Reshetov 2009, "Morphological
// antialiasing", section 2.2, there for colours). At an end where the staircase continues, the stroke of a run of collinear
// borders bends to the middle of the step there. The bend extends over half the run, or RAMP / 2 if that is less. The stroke of a border
// that is itself a step ends at the border's middle. At corners, where the staircase does not continue, strokes do not bend.

#import cutaway::borders::{below_of, right_of, word_of_tile}
#import cutaway::frame::{frame, pixel_index}
#import cutaway::share::{pixel_at, turns}
#import cutaway::shown::is_in_frame
#import cutaway::stroke_place::{Place, placed}
#import cutaway::style::style
#import cutaway::touched::TILE_PX

@group(1) @binding(0) var<storage, read> borders: array<u32>;
@group(1) @binding(1) var<storage, read_write> strokes: array<u32>;

// The longest run that is bent over its whole length; `RAMP_PX` in `src/effects/borders.rs`.
const RAMP: i32 = 16;

// True if a stroke is drawn between a sample and the next one in a direction, (1, 0) or (0, 1).
fn is_drawn(at: vec2<i32>, step: vec2<i32>) -> bool {
    if !is_in_frame(at) {
        return false;
    }
    let word = borders[pixel_index(vec2<u32>(at))];
    let class_of = select(below_of(word), right_of(word), step.x == 1);
    return class_of != 0u && style.stroke_halves[(class_of - 1u) / 4u][(class_of - 1u) % 4u] > 0.0;
}

// Continuation of the staircase at one end of a run.
struct End {
    // Number of borders of the run before the end.
    distance: i32,
    // Side to which the next run is offset: -1, 1, or 0 at corners and where no step is near.
    side: i32,
    // True if the border is itself a step between two perpendicular runs.
    is_step: bool,
}

// The end, in direction `sign`, of the run that contains the border between a sample and the next one across.
fn end_of(at: vec2<i32>, across: vec2<i32>, sign: i32) -> End {
    let along = across.yx;
    var last = at;
    for (var distance = 0; distance < RAMP; distance++) {
        if is_drawn(last + sign * along, across) {
            last += sign * along;
            continue;
        }
        // At the corner where the run ends, a perpendicular border may lie on either side, or on neither.
        let beside = last + select(vec2<i32>(0), -along, sign < 0);
        let before = is_drawn(beside, along);
        let behind = is_drawn(beside + across, along);
        let goes_on = vec2<bool>(
            before && is_drawn(last + sign * along - across, across),
            behind && is_drawn(last + sign * along + across, across),
        );
        let side = select(0, 1, goes_on.y) - select(0, 1, goes_on.x);
        return End(distance, side, before != behind);
    }
    return End(RAMP, 0, false);
}

// The side on which a perpendicular border meets the end of a run.
fn turns_to(at: vec2<i32>, across: vec2<i32>, sign: i32) -> i32 {
    let beside = at + select(vec2<i32>(0), -across.yx, sign < 0);
    return select(-1, 1, is_drawn(beside + across, across.yx));
}

// The position of the stroke on a border.
fn place_of(at: vec2<i32>, across: vec2<i32>) -> u32 {
    let start = end_of(at, across, -1);
    let end = end_of(at, across, 1);
    let length = f32(min(start.distance + 1 + end.distance, RAMP));
    let from_start = vec2<f32>(f32(start.distance), f32(start.distance + 1));
    let from_end = vec2<f32>(f32(end.distance + 1), f32(end.distance));
    let ramps = max(vec2<f32>(0.0), 0.5 - from_start / length) * f32(start.side) +
        max(vec2<f32>(0.0), 0.5 - from_end / length) * f32(end.side);
    // A step turns to opposite sides at its two ends.
    let is_step = start.is_step && end.is_step && start.distance + end.distance == 0 &&
        turns_to(at, across, -1) != turns_to(at, across, 1);
    let shortened = vec2<bool>(is_step && start.side == 0, is_step && end.side == 0);
    return placed(Place(ramps, shortened));
}

fn place(xy: vec2<u32>) {
    let at = vec2<i32>(xy);
    var word = borders[pixel_index(xy)];
    if is_drawn(at, vec2<i32>(1, 0)) {
        word |= place_of(at, vec2<i32>(1, 0)) << 8u;
    }
    if is_drawn(at, vec2<i32>(0, 1)) {
        word |= place_of(at, vec2<i32>(0, 1)) << 20u;
    }
    strokes[pixel_index(xy)] = word;
}

@compute @workgroup_size(16, 16)
fn main(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_id) local: vec3<u32>,
) {
    let end = turns(group, groups);
    for (var turn = 0u; turn < end; turn++) {
        let xy = pixel_at(turn, group, groups, local);
        if all(local == vec3<u32>(0u)) {
            let word = word_of_tile(xy / TILE_PX);
            strokes[word] = borders[word];
        }
        if all(xy < frame.size_px) {
            place(xy);
        }
    }
}
