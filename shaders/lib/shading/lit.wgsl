// Colours under the lights, with highlights.

#define_import_path cutaway::shading

#import cutaway::lit::lit

fn shaded(base: vec3<f32>, normal: vec3<f32>, gaze: vec3<f32>, is_cap: bool) -> vec3<f32> {
    return lit(base, normal, gaze, is_cap);
}
