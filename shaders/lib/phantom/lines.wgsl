// Phantom lines: a long dash and two dots (ISO 128-2, 05.1: 24, 3, half, 3, half, 3 widths; dots are as long as a line is wide here).
//
// The direction of a line is that in which the borders around it scatter most; dashes follow the axis of the scene that runs along it most, so
// that they stay where they are while the camera moves. Where another axis takes over the dashes jump. Bound as @group(1) @binding(3).

#define_import_path cutaway::phantom

#import cutaway::borders::{NO_BORDER, below_of, right_of, tiles_around, word_of_tile}
#import cutaway::frame::{frame, pixel_index}
#import cutaway::ghost::{ghost_layers, is_gone}
#import cutaway::ghost_look::ghost
#import cutaway::pulses::pulse_cover
#import cutaway::visibility::{first_word_of, is_in_frame, pixel_width, shown_point}

@group(1) @binding(3) var<storage, read> ghost_borders: array<u32>;

// Widths of a line in a period.
const PERIOD: f32 = 34.0;
// How far borders tell the direction of a line, in pixels.
const SCATTER_PX: i32 = 4;

// A border: the pixel before it, and the step to the one behind.
struct Border {
    at: vec2<i32>,
    step: vec2<i32>,
}

// Whether the word of a pixel has a border towards the next one, to the right or below.
fn has_border(word: u32, step: vec2<i32>) -> bool {
    return select(below_of(word), right_of(word), step.x == 1) != NO_BORDER;
}

// Whether a tile within a distance of a pixel has a border of the uncut solids.
fn has_border_near(at: vec2<i32>, reach_px: i32) -> bool {
    let tiles = tiles_around(vec2<u32>(at), reach_px, frame.size_px);
    var found = 0u;
    for (var y = tiles.y; y <= tiles.w; y++) {
        for (var x = tiles.x; x <= tiles.z; x++) {
            found |= ghost_borders[word_of_tile(vec2<u32>(x, y), frame.size_px)];
        }
    }
    return found != 0u;
}

fn word_of(at: vec2<i32>) -> u32 {
    if !is_in_frame(at) {
        return 0u;
    }
    return ghost_borders[pixel_index(vec2<u32>(at))];
}

// Unit vector along the borders around one, in pixels.
fn direction_at(near: vec2<i32>) -> vec2<f32> {
    var mean = vec2<f32>(0.0);
    var squares = vec3<f32>(0.0);
    var count = 0.0;
    for (var y = -SCATTER_PX; y <= SCATTER_PX; y++) {
        for (var x = -SCATTER_PX; x <= SCATTER_PX; x++) {
            let at = near + vec2<i32>(x, y);
            let word = word_of(at);
            if word == 0u {
                continue;
            }
            for (var side = 0; side < 2; side++) {
                let step = vec2<i32>(1 - side, side);
                if !has_border(word, step) {
                    continue;
                }
                let middle = vec2<f32>(vec2<i32>(x, y)) + 0.5 * vec2<f32>(step);
                mean += middle;
                squares += vec3<f32>(middle.x * middle.x, middle.y * middle.y, middle.x * middle.y);
                count += 1.0;
            }
        }
    }
    mean /= max(count, 1.0);
    squares = squares / max(count, 1.0) - vec3<f32>(mean.x * mean.x, mean.y * mean.y, mean.x * mean.y);
    let angle = 0.5 * atan2(2.0 * squares.z, squares.x - squares.y);
    return vec2<f32>(cos(angle), sin(angle));
}

// How much of a line is drawn where a border is.
fn dash_cover(border: Border) -> f32 {
    let is_first = is_gone(border.at);
    let at = vec2<u32>(select(border.at + border.step, border.at, is_first));
    let first = first_word_of(at);
    let depth = bitcast<f32>(ghost_layers[first + 2u]);
    let point = shown_point(at, ghost_layers[first], depth).xyz;
    let along = direction_at(border.at);
    let way = along.x * normalize(frame.ray_step[0].xyz) + along.y * normalize(frame.ray_step[1].xyz);
    let size = abs(way);
    let is_x = size.x >= size.y && size.x >= size.z;
    let is_y = !is_x && size.y >= size.z;
    let place = select(select(point.z, point.y, is_y), point.x, is_x) * ghost.periods_per_unit;
    let footprint = max(size.x, max(size.y, size.z)) * pixel_width(depth) * ghost.periods_per_unit;
    let dot_width = max(1.0 / PERIOD, footprint);
    return pulse_cover(place - 12.0 / PERIOD, 24.0 / PERIOD, footprint) +
        pulse_cover(place - 27.5 / PERIOD, dot_width, footprint) +
        pulse_cover(place - 31.0 / PERIOD, dot_width, footprint);
}

// The share of a pixel that lines of what is gone cover.
fn phantom_cover(at: vec2<i32>) -> f32 {
    let reach = i32(ceil(ghost.half_px)) + 1;
    if !has_border_near(at, reach + 1) {
        return 0.0;
    }
    var nearest = ghost.half_px + 1.0;
    var border = Border(at, vec2<i32>(0));
    for (var y = -reach - 1; y <= reach; y++) {
        for (var x = -reach - 1; x <= reach; x++) {
            let near = at + vec2<i32>(x, y);
            let word = word_of(near);
            if word == 0u {
                continue;
            }
            for (var side = 0; side < 2; side++) {
                let step = vec2<i32>(1 - side, side);
                let off = abs(vec2<f32>(vec2<i32>(x, y)) + 0.5 * vec2<f32>(step));
                // A border is a segment of length 1 across its step.
                let distance = length(max(off - 0.5 * vec2<f32>(vec2<i32>(1) - step), vec2<f32>(0.0)));
                if distance >= nearest || !has_border(word, step) {
                    continue;
                }
                nearest = distance;
                border = Border(near, step);
            }
        }
    }
    let cover = clamp(0.5 + ghost.half_px - nearest, 0.0, 1.0) * min(2.0 * ghost.half_px, 1.0);
    if cover <= 0.0 || all(border.step == vec2<i32>(0)) {
        return 0.0;
    }
    return cover * min(dash_cover(border), 1.0);
}
