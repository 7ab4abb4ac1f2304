// Corners of a triangle that covers the picture, by vertex index.

#define_import_path cutaway::full_screen

fn corner_of_screen(index: u32) -> vec4<f32> {
    return vec4<f32>(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}
