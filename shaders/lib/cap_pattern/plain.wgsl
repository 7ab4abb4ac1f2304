// Caps are plain.

#define_import_path cutaway::cap_pattern

fn patterned(color: vec3<f32>, at: vec2<u32>, word: u32, depth: f32, normal: vec3<f32>, place: u32) -> vec3<f32> {
    return color;
}
