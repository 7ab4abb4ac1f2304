// Soft lighting without highlights; caps look like sheets of paper that are partly lit.

#define_import_path cutaway::shading

#import cutaway::light::{diffuse_light, key_light}
#import cutaway::style::style

fn shaded(base: vec3<f32>, normal: vec3<f32>, gaze: vec3<f32>, is_cap: bool) -> vec3<f32> {
    if is_cap {
        let even = 0.84 + 0.16 * clamp(-dot(normal, gaze), 0.0, 1.0);
        let relief = clamp(0.55 + 0.62 * dot(normal, key_light(gaze)), 0.0, 1.15);
        return base * mix(1.0, mix(even, relief, style.cap_relief), style.cap_light);
    }
    return base * (0.20 + 0.86 * diffuse_light(normal, gaze));
}
