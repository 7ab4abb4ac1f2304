// Makes a picture in a given style from layers. One invocation owns one pixel at a time. Features of a style fill open modules: `dress`,
// `shading`, `occlusion`, `cap_pattern`, `surface_pattern`, `strokes`, `backdrop`, and `overlap` for caps that several solids share.

#import cutaway::backdrop::backdrop
#import cutaway::base::own_color
#import cutaway::cap_pattern::patterned
#import cutaway::color::srgb_from_linear
#import cutaway::cuts::place_of_part
#import cutaway::cap_materials::dressed
#import cutaway::frame::{centre_of, frame, pixel_index, ray_through}
#import cutaway::layers::{BACKGROUND, CAP, WORDS_PER_PIXEL, kind_of, part_of, unpack_normal}
#import cutaway::occlusion::occluded
#import cutaway::overlap::cap_base
#import cutaway::picture::picture
#import cutaway::shading::shaded
#import cutaway::share::{pixel_at, turns}
#import cutaway::strokes::stroked
#import cutaway::surface_pattern::engraved

@group(1) @binding(0) var<storage, read> layers: array<u32>;

// The colour in linear light, and the fraction of the pixel that it covers.
fn color_at(at: vec2<u32>, pixel: u32) -> vec4<f32> {
    let first = pixel * WORDS_PER_PIXEL;
    let word = layers[first];
    if kind_of(word) == BACKGROUND {
        return backdrop(at.y);
    }
    let place = place_of_part(part_of(word));
    let base = cap_base(dressed(own_color(word, place), pixel), word, at);
    let gaze = normalize(ray_through(centre_of(at)).direction);
    let normal = unpack_normal(layers[first + 1u]);
    let depth = bitcast<f32>(layers[first + 2u]);
    let is_cap = kind_of(word) == CAP;
    let color = occluded(shaded(base, normal, gaze, is_cap), pixel, is_cap);
    if is_cap {
        return vec4<f32>(patterned(color, at, word, depth, normal, place), 1.0);
    }
    return vec4<f32>(engraved(color, base, at, depth, normal), 1.0);
}

fn illustrate(xy: vec2<u32>) {
    let pixel = pixel_index(xy);
    let color = stroked(color_at(xy, pixel), xy);
    picture[pixel] = pack4x8unorm(vec4<f32>(srgb_from_linear(color.rgb), color.a));
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
            illustrate(xy);
        }
    }
}
