// Colours that `cap_materials.wgsl` stored in the picture replace those of parts.

#define_import_path cutaway::cap_materials

#import cutaway::color::linear_from_srgb
#import cutaway::picture::picture

fn dressed(base: vec3<f32>, pixel: u32) -> vec3<f32> {
    let word = unpack4x8unorm(picture[pixel]);
    return mix(base, linear_from_srgb(word.rgb), word.a);
}
