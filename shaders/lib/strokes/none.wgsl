// No strokes.

#define_import_path cutaway::strokes

fn stroked(color: vec4<f32>, at: vec2<u32>) -> vec4<f32> {
    return color;
}
