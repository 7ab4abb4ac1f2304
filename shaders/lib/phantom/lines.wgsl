// Phantom lines: a long dash and two dots (ISO 128-2, 05.1: 24, 3, half, 3, half, 3 widths; dots are as long as a line is wide here).
//
// Dashes follow the scene axis along which a line extends farthest, so that they stay in place while the camera moves; where a different
// axis takes over they jump. Bound as @group(1) @binding(3).

#define_import_path cutaway::phantom

#import cutaway::borders::{MOST_REACH_PX, MOST_TILES_AROUND, NO_BORDER, below_of, right_of, tiles_around, word_of_tile}
#import cutaway::frame::{frame, pixel_index}
#import cutaway::ghost::{ghost_layers, is_gone}
#import cutaway::ghost_look::ghost
#import cutaway::pulses::pulse_cover
#import cutaway::shown::{first_word_of, is_in_frame, shown_point}

@group(1) @binding(3) var<storage, read> ghost_borders: array<u32>;

// Period in line widths.
const PERIOD: f32 = 34.0;
// Radius in pixels in which borders determine a line's direction.
const SCATTER_PX: i32 = 4;

// True if the word of a pixel contains a border towards the next pixel, to the right or below.
fn has_border(word: u32, step: vec2<i32>) -> bool {
    return select(below_of(word), right_of(word), step.x == 1) != NO_BORDER;
}

// True if a tile within a distance of a pixel contains a border of the uncut solids.
fn has_border_near(at: vec2<i32>, reach_px: i32) -> bool {
    let tiles = tiles_around(vec2<u32>(at), reach_px, frame.size_px);
    var found = 0u;
    let across = min(tiles.zw - tiles.xy + 1u, vec2<u32>(MOST_TILES_AROUND));
    for (var v = 0u; v < across.y; v++) {
        for (var u = 0u; u < across.x; u++) {
            let tile = tiles.xy + vec2<u32>(u, v);
            found |= ghost_borders[word_of_tile(tile)];
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

// A stretch of a line, fitted to the picture positions of its borders and the scene positions of the points next to them.
struct Stretch {
    middle_px: vec2<f32>,
    // Unit vector along the stretch.
    along: vec2<f32>,
    middle: vec3<f32>,
    // Change of the scene position along the stretch, per pixel.
    slope: vec3<f32>,
}

// The point of the removed surface next to a border.
fn gone_point(at: vec2<i32>, step: vec2<i32>) -> vec3<f32> {
    let gone = vec2<u32>(select(at + step, at, is_gone(at)));
    let first = first_word_of(gone);
    return shown_point(gone, ghost_layers[first], bitcast<f32>(ghost_layers[first + 2u])).xyz;
}

// The stretch of a line around a border: the direction in which borders scatter most, and the linear regression of their points along this
// direction, because the depths of single points jump where a surface curves away.
fn stretch_at(near: vec2<i32>) -> Stretch {
    var px = vec2<f32>(0.0);
    var px_squares = vec3<f32>(0.0);
    var place = vec3<f32>(0.0);
    var with_x = vec3<f32>(0.0);
    var with_y = vec3<f32>(0.0);
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
                let point = gone_point(at, step);
                px += middle;
                px_squares += vec3<f32>(middle.x * middle.x, middle.y * middle.y, middle.x * middle.y);
                place += point;
                with_x += middle.x * point;
                with_y += middle.y * point;
                count += 1.0;
            }
        }
    }
    let share = 1.0 / max(count, 1.0);
    px *= share;
    place *= share;
    let spread = px_squares * share - vec3<f32>(px.x * px.x, px.y * px.y, px.x * px.y);
    let angle = 0.5 * atan2(2.0 * spread.z, spread.x - spread.y);
    let along = vec2<f32>(cos(angle), sin(angle));
    let length_px = along.x * along.x * spread.x + along.y * along.y * spread.y + 2.0 * along.x * along.y * spread.z;
    let slope = (along.x * (with_x * share - px.x * place) + along.y * (with_y * share - px.y * place)) / max(length_px, 1e-3);
    return Stretch(px, along, place, slope);
}

// Fraction of a line drawn at a pixel near a border.
fn dash_cover(at: vec2<i32>, border: vec2<i32>) -> f32 {
    let stretch = stretch_at(border);
    let size = abs(stretch.slope);
    let is_x = size.x >= size.y && size.x >= size.z;
    let is_y = !is_x && size.y >= size.z;
    let axis = select(select(vec3<f32>(0.0, 0.0, 1.0), vec3<f32>(0.0, 1.0, 0.0), is_y), vec3<f32>(1.0, 0.0, 0.0), is_x);
    let off = dot(vec2<f32>(at - border) - stretch.middle_px, stretch.along);
    let per_px = dot(stretch.slope, axis) * ghost.widths_per_unit / PERIOD;
    let place = dot(stretch.middle, axis) * ghost.widths_per_unit / PERIOD + per_px * off;
    let footprint = abs(per_px);
    let dot_width = max(1.0 / PERIOD, footprint);
    return pulse_cover(place - 12.0 / PERIOD, 24.0 / PERIOD, vec2<f32>(footprint, 0.0)) +
        pulse_cover(place - 27.5 / PERIOD, dot_width, vec2<f32>(footprint, 0.0)) +
        pulse_cover(place - 31.0 / PERIOD, dot_width, vec2<f32>(footprint, 0.0));
}

// The fraction of a pixel covered by phantom lines.
fn phantom_cover(at: vec2<i32>) -> f32 {
    let reach = min(i32(ceil(ghost.half_px)) + 1, MOST_REACH_PX);
    if !has_border_near(at, reach + 1) {
        return 0.0;
    }
    var nearest = ghost.half_px + 1.0;
    var border = at;
    var is_near = false;
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
                // A border is a segment of length 1, perpendicular to its step.
                let distance = length(max(off - 0.5 * vec2<f32>(vec2<i32>(1) - step), vec2<f32>(0.0)));
                if distance >= nearest || !has_border(word, step) {
                    continue;
                }
                nearest = distance;
                border = near;
                is_near = true;
            }
        }
    }
    // A border lies between two pixels: a line thinner than one pixel covers part of both.
    let cover = clamp(0.5 + ghost.half_px - nearest, 0.0, 1.0);
    if cover <= 0.0 || !is_near {
        return 0.0;
    }
    return cover * min(dash_cover(at, border), 1.0);
}
