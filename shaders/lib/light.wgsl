// Light and colour: a key light over the viewer's left shoulder and a cool fill from the right; caps in their own colour and a
// little flatter, so that the cut reads as one sheet. Colours are mixed in linear light.
// The open module `overlap` says how caps that several solids share differ.

#define_import_path cutaway::light

#import cutaway::cuts::parts
#import cutaway::frame::{frame, centre_of, ray_through}
#import cutaway::layers::{CAP, kind_of, unpack_normal}
#import cutaway::overlap::cap_base

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

// Colour of a pixel with a surface or a cap: the first two words of its layer, and the place of its part in the table.
fn color_of(at: vec2<u32>, word: u32, normal: u32, place: u32) -> u32 {
    let is_cap = kind_of(word) == CAP;
    let own = linear_from_srgb(select(parts[place].color.rgb, parts[place].cap_color.rgb, is_cap));
    let base = cap_base(own, word, at);
    let gaze = normalize(ray_through(centre_of(at)).direction);
    let color = srgb_from_linear(lit(base, unpack_normal(normal), gaze, is_cap));
    return pack4x8unorm(vec4<f32>(color, 1.0));
}
