// The plain style: part colours under the lights, with highlights; caps in their own colour with weaker shading, so that the cut looks
// like one sheet. Colours are mixed in linear light.

#define_import_path cutaway::lit

#import cutaway::base::base_of
#import cutaway::color::srgb_from_linear
#import cutaway::frame::{centre_of, ray_through}
#import cutaway::layers::{CAP, kind_of, unpack_normal}
#import cutaway::light::{diffuse_light, mirrored}

fn lit(base: vec3<f32>, normal: vec3<f32>, gaze: vec3<f32>, is_cap: bool) -> vec3<f32> {
    let gloss = select(0.22, 0.04, is_cap) * pow(mirrored(normal, gaze), 48.0);
    return base * diffuse_light(normal, gaze) + gloss;
}

// Colour of a pixel with a surface or a cap, from the first two words of its layer and its part's index in the table.
fn color_of(at: vec2<u32>, word: u32, normal: u32, place: u32) -> u32 {
    let gaze = normalize(ray_through(centre_of(at)).direction);
    let color = lit(base_of(at, word, place), unpack_normal(normal), gaze, kind_of(word) == CAP);
    return pack4x8unorm(vec4<f32>(srgb_from_linear(color), 1.0));
}
