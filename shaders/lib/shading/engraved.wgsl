// The tone that engraving turns into lines; caps are unlit.

#define_import_path cutaway::shading

#import cutaway::light::key_light

fn shaded(base: vec3<f32>, normal: vec3<f32>, gaze: vec3<f32>, is_cap: bool) -> vec3<f32> {
    if is_cap {
        return base;
    }
    let towards = max(dot(normal, key_light(gaze)), 0.0);
    return vec3<f32>(clamp(0.15 + 0.9 * pow(towards, 0.8), 0.0, 1.0));
}
