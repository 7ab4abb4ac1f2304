// Blends colours over a picture.

#define_import_path cutaway::over

#import cutaway::color::{linear_from_srgb, srgb_from_linear}

// Blends a colour in linear light over a pixel, with a coverage above 0; returns the new word.
fn laid_over(word: u32, color: vec3<f32>, cover: f32) -> u32 {
    let below = unpack4x8unorm(word);
    let alpha = cover + below.a * (1.0 - cover);
    let mixed = color * cover + linear_from_srgb(below.rgb) * below.a * (1.0 - cover);
    return pack4x8unorm(vec4<f32>(srgb_from_linear(mixed / alpha), alpha));
}
