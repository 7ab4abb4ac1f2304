// A matte material, caps like surfaces.

#define_import_path cutaway::shading

#import cutaway::light::diffuse_light

fn shaded(base: vec3<f32>, normal: vec3<f32>, gaze: vec3<f32>, is_cap: bool) -> vec3<f32> {
    return base * (0.25 + 0.80 * diffuse_light(normal, gaze));
}
