// Averages the horizon result over 4 x 4 samples, the size of the search pattern, using only samples in about the same plane. One
// invocation owns a pixel at a time.

#import cutaway::frame::{frame, pixel_index}
#import cutaway::layers::{BACKGROUND, kind_of, unpack_direction, unpack_normal}
#import cutaway::share::{pixel_at, turns}
#import cutaway::shown::{first_word_of, is_in_frame, pixel_width, shown_point}

@group(1) @binding(0) var<storage, read> layers: array<u32>;
@group(1) @binding(1) var<storage, read> sky: array<f32>;
@group(1) @binding(2) var<storage, read_write> visibility: array<f32>;

// Greatest distance of another sample from the tangent plane, in pixel widths.
const LEVEL_PX: f32 = 4.0;
// Least cosine of the angle between the normals of two samples.
const ALIKE: f32 = 0.7;

fn smooth_out(xy: vec2<u32>) {
    let first = first_word_of(xy);
    let pixel = pixel_index(xy);
    if kind_of(layers[first]) == BACKGROUND {
        visibility[pixel] = 1.0;
        return;
    }
    let depth = bitcast<f32>(layers[first + 2u]);
    let point = shown_point(xy, layers[first], depth).xyz;
    let normal = unpack_normal(layers[first + 1u]);
    let level = LEVEL_PX * pixel_width(depth);
    var sum = sky[pixel];
    var count = 1.0;
    for (var y = -2; y < 2; y++) {
        for (var x = -2; x < 2; x++) {
            let near = vec2<i32>(xy) + vec2<i32>(x, y);
            if !is_in_frame(near) || (x == 0 && y == 0) {
                continue;
            }
            let other = first_word_of(vec2<u32>(near));
            let facing = unpack_direction(layers[other + 1u]);
            let along = dot(normal, facing);
            if along <= 0.0 || along * along < ALIKE * ALIKE * dot(facing, facing) {
                continue;
            }
            let shown = shown_point(vec2<u32>(near), layers[other], bitcast<f32>(layers[other + 2u]));
            let is_level = abs(dot(normal, shown.xyz - point)) <= level;
            if shown.w < 0.5 || !is_level {
                continue;
            }
            sum += sky[pixel_index(vec2<u32>(near))];
            count += 1.0;
        }
    }
    visibility[pixel] = sum / count;
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
            smooth_out(xy);
        }
    }
}
