// Combines the occlusion of caps by their own relief with the occlusion found in the picture. One invocation owns a pixel at a time.
//
// The sky map has the same texels as the height map, and is sampled in the same way.

#import cutaway::cuts::{MAX_SURFACES, NO_RELIEF, cut_table}
#import cutaway::frame::{centre_of, frame, pixel_index, ray_through}
#import cutaway::layers::{CAP, WORDS_PER_PIXEL, clip_surface_of, kind_of}
#import cutaway::relief::height_at
#import cutaway::share::{pixel_at, turns}
#import cutaway::sky_before::sky_before

struct ReliefSky {
    cap: f32,
    relief: f32,
    padding_a: u32,
    padding_b: u32,
}

@group(1) @binding(0) var<storage, read> layers: array<u32>;
@group(1) @binding(1) var<storage, read_write> visibility: array<f32>;
@group(1) @binding(2) var<uniform> relief_sky: ReliefSky;

// Fraction of the light at a point of a cap that the relief does not block.
fn light_of(number: u32, point: vec4<f32>) -> f32 {
    for (var slot = 0u; slot < min(cut_table.surface_count, MAX_SURFACES); slot++) {
        if cut_table.surfaces[slot].surface != number || cut_table.surfaces[slot].first_texel == NO_RELIEF {
            continue;
        }
        let texel = vec2<f32>(dot(cut_table.surfaces[slot].texel_x_row, point), dot(cut_table.surfaces[slot].texel_y_row, point));
        return 1.0 - relief_sky.relief * (1.0 - height_at(slot, texel));
    }
    return 1.0;
}

fn light_relief(xy: vec2<u32>) {
    let pixel = pixel_index(xy);
    let first = pixel * WORDS_PER_PIXEL;
    var light = sky_before(pixel);
    if kind_of(layers[first]) == CAP {
        let ray = ray_through(centre_of(xy));
        let point = vec4<f32>(ray.origin + bitcast<f32>(layers[first + 2u]) * ray.direction, 1.0);
        light = (1.0 - relief_sky.cap * (1.0 - light)) * light_of(clip_surface_of(layers[first]), point);
    }
    visibility[pixel] = light;
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
            light_relief(xy);
        }
    }
}
