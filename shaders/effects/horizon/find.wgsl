// Computes the fraction of sky visible from the point of each pixel, weighted by the cosine of the angle to its normal (ground-truth
// ambient occlusion, Jimenez, Wu, Pesce and Jarabo 2016). One invocation owns a pixel at a time.
//
// Planes through the line of sight slice the picture. In each slice, the highest sample on either side is a horizon; between the horizons
// the integral has a closed form. Samples beyond the radius are ignored, and nearer ones get more weight. Slices are rotated and
// samples offset by a 4 x 4 pattern, which the next pass averages out.
//
// Cannot: account for geometry that is hidden or outside the picture; background hides nothing.

#import cutaway::frame::{frame, pixel_index}
#import cutaway::layers::{BACKGROUND, kind_of, unpack_normal}
#import cutaway::share::{pixel_at, turns}
#import cutaway::shown::{first_word_of, is_in_frame, pixel_width, shown_point}

struct Horizon {
    // Greatest distance of a sample in scene units.
    radius: f32,
    // Greatest distance of a sample in pixels.
    reach_px: f32,
    slices: u32,
    // Samples on each side of a slice.
    steps: u32,
}

@group(1) @binding(0) var<storage, read> layers: array<u32>;
@group(1) @binding(1) var<storage, read_write> sky: array<f32>;
@group(2) @binding(0) var<uniform> horizon: Horizon;

const PI: f32 = 3.1415927;
const HALF_PI: f32 = 1.5707964;

// The point whose slices are integrated.
struct Centre {
    at: vec2<u32>,
    point: vec3<f32>,
    to_eye: vec3<f32>,
    reach_px: f32,
}

// Value of an ordered 4 x 4 pattern at a pixel, 0 to 1.
fn ordered(x: u32, y: u32) -> f32 {
    let pattern = array<u32, 16>(0u, 8u, 2u, 10u, 12u, 4u, 14u, 6u, 3u, 11u, 1u, 9u, 15u, 7u, 13u, 5u);
    return f32(pattern[(x & 3u) + 4u * (y & 3u)]) / 16.0;
}

// Limits of `style.occlusion.steps` and `style.occlusion.slices`.
const MOST_STEPS: u32 = 64u;
const MOST_SLICES: u32 = 32u;

// Cosine between the line of sight and the horizon in a picture direction, at least `least`.
fn horizon_along(centre: Centre, along: vec2<f32>, least: f32, moved: f32) -> f32 {
    var highest = least;
    for (var i = 0u; i < min(horizon.steps, MOST_STEPS); i++) {
        let share = (f32(i) + moved) / f32(horizon.steps);
        let off = max(share * share * centre.reach_px, 1.0);
        let near = vec2<i32>(round(vec2<f32>(centre.at) + off * along));
        if !is_in_frame(near) {
            continue;
        }
        let first = first_word_of(vec2<u32>(near));
        let shown = shown_point(vec2<u32>(near), layers[first], bitcast<f32>(layers[first + 2u]));
        let way = shown.xyz - centre.point;
        let square = dot(way, way);
        let weight = 1.0 - square / (horizon.radius * horizon.radius);
        if shown.w < 0.5 || square < 1e-18 || weight <= 0.0 {
            continue;
        }
        let height = dot(way, centre.to_eye) * inverseSqrt(square);
        highest = max(highest, mix(least, height, weight));
    }
    return highest;
}

// Twice the integral of the cosine over a slice, from the line of sight to a horizon, where the normal is tilted by `lean`.
fn arc(angle: f32, lean: f32) -> f32 {
    return 0.25 * (-cos(2.0 * angle - lean) + cos(lean) + 2.0 * angle * sin(lean));
}

fn find(xy: vec2<u32>) {
    let first = first_word_of(xy);
    let pixel = pixel_index(xy);
    let depth = bitcast<f32>(layers[first + 2u]);
    let reach_px = min(horizon.radius / pixel_width(depth), horizon.reach_px);
    if kind_of(layers[first]) == BACKGROUND || reach_px < 1.0 {
        sky[pixel] = 1.0;
        return;
    }
    let point = shown_point(xy, layers[first], depth).xyz;
    let eye = shown_point(xy, layers[first], 0.0).xyz;
    let centre = Centre(xy, point, normalize(eye - point), reach_px);
    let normal = unpack_normal(layers[first + 1u]);
    let right = normalize(frame.ray_step[0].xyz);
    let down = normalize(frame.ray_step[1].xyz);
    let row = xy.y + frame.band.x;
    let turn = ordered(xy.x, row);
    let moved = ordered(xy.x + 2u, 3u * row + 1u);
    var sum = 0.0;
    for (var i = 0u; i < min(horizon.slices, MOST_SLICES); i++) {
        let angle = PI * (f32(i) + turn) / f32(horizon.slices);
        let along = vec2<f32>(cos(angle), sin(angle));
        let towards = along.x * right + along.y * down;
        let tangent = normalize(towards - dot(towards, centre.to_eye) * centre.to_eye);
        let within = vec2<f32>(dot(normal, centre.to_eye), dot(normal, tangent));
        let lean = atan2(within.y, within.x);
        let ahead = horizon_along(centre, along, cos(min(lean + HALF_PI, PI)), moved);
        let behind = horizon_along(centre, -along, cos(max(lean - HALF_PI, -PI)), moved);
        let before = lean + min(acos(clamp(ahead, -1.0, 1.0)) - lean, HALF_PI);
        let after = lean + max(-acos(clamp(behind, -1.0, 1.0)) - lean, -HALF_PI);
        sum += length(within) * (arc(before, lean) + arc(after, lean));
    }
    sky[pixel] = clamp(sum / f32(horizon.slices), 0.0, 1.0);
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
        if all(xy < frame.size_px) {
            find(xy);
        }
    }
}
