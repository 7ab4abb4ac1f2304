// Turns layers into a picture: the same pass for every strategy and for the exact reference. One invocation owns one pixel.
//
// A key light over the viewer's left shoulder, a cool fill from the right and a sky that fades to the ground; caps in their
// own colour and a little flatter, so that the cut reads as one sheet. Colours are mixed in linear light.
// The open module `overlap` says how caps that several solids share differ.

#import cutaway::cuts::parts
#import cutaway::frame::{frame, centre_of, pixel_index, ray_through}
#import cutaway::layers::{BACKGROUND, CAP, WORDS_PER_PIXEL, kind_of, part_of, unpack_normal}
#import cutaway::overlap::cap_base

@group(1) @binding(0) var<storage, read> layers: array<u32>;
// Rank of each part of the scene.
@group(1) @binding(1) var<storage, read> rank_of_part: array<u32>;
@group(1) @binding(2) var<storage, read_write> picture: array<u32>;

fn linear_from_srgb(c: vec3<f32>) -> vec3<f32> {
    return select(pow((c + 0.055) / 1.055, vec3<f32>(2.4)), c / 12.92, c <= vec3<f32>(0.04045));
}

fn srgb_from_linear(c: vec3<f32>) -> vec3<f32> {
    let x = clamp(c, vec3<f32>(0.0), vec3<f32>(1.0));
    return select(1.055 * pow(x, vec3<f32>(1.0 / 2.4)) - 0.055, 12.92 * x, x <= vec3<f32>(0.0031308));
}

fn lit(base: vec3<f32>, normal: vec3<f32>, gaze: vec3<f32>, is_cap: bool) -> vec3<f32> {
    let right = normalize(frame.ray_step[0].xyz);
    let up = -normalize(frame.ray_step[1].xyz);
    let key = normalize(-gaze + 0.55 * up - 0.65 * right);
    let fill = normalize(-gaze - 0.10 * up + 0.90 * right);
    let sky = 0.5 + 0.5 * dot(normal, up);
    let ambient = mix(vec3<f32>(0.13, 0.12, 0.12), vec3<f32>(0.30, 0.32, 0.36), sky);
    let diffuse = 0.80 * max(dot(normal, key), 0.0) * vec3<f32>(1.0, 0.97, 0.92) + 0.20 * max(dot(normal, fill), 0.0) * vec3<f32>(0.75, 0.85, 1.0);
    let gloss = select(0.22, 0.04, is_cap) * pow(max(dot(normal, normalize(key - gaze)), 0.0), 48.0);
    return base * (ambient + diffuse) + gloss;
}

@compute @workgroup_size(16, 16)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= frame.size_px) {
        return;
    }
    let pixel = pixel_index(id.xy);
    let at = pixel * WORDS_PER_PIXEL;
    let word = layers[at];
    let kind = kind_of(word);
    var color = mix(vec3<f32>(0.93, 0.94, 0.95), vec3<f32>(0.72, 0.75, 0.79), f32(id.y) / f32(frame.size_px.y));
    if kind != BACKGROUND {
        let part = parts[rank_of_part[part_of(word)]];
        let is_cap = kind == CAP;
        let own = linear_from_srgb(select(part.color.rgb, part.cap_color.rgb, is_cap));
        let base = cap_base(own, word, id.xy);
        let gaze = normalize(ray_through(centre_of(id.xy)).direction);
        color = srgb_from_linear(lit(base, unpack_normal(layers[at + 1u]), gaze, is_cap));
    }
    picture[pixel] = pack4x8unorm(vec4<f32>(color, 1.0));
}
