// No light: colours as they are.

#define_import_path cutaway::shading

fn shaded(base: vec3<f32>, normal: vec3<f32>, gaze: vec3<f32>, is_cap: bool) -> vec3<f32> {
    return base;
}
