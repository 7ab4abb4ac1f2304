// From cool to warm: surfaces keep their own colour and turn blue in shade and yellow in light (Gooch, Gooch, Shirley, Cohen 1998), with a
// highlight. Caps are nearly flat.

#define_import_path cutaway::shading

#import cutaway::light::{key_light, mirrored}
#import cutaway::style::style

fn shaded(base: vec3<f32>, normal: vec3<f32>, gaze: vec3<f32>, is_cap: bool) -> vec3<f32> {
    let towards = dot(normal, key_light(gaze));
    if is_cap {
        return base * (0.80 + 0.20 * clamp(towards, 0.0, 1.0));
    }
    let cool = vec3<f32>(0.0, 0.0, style.gooch.x) + style.gooch.z * base;
    let warm = vec3<f32>(style.gooch.y, style.gooch.y, 0.0) + style.gooch.w * base;
    return mix(cool, warm, 0.5 + 0.5 * towards) + 0.35 * pow(mirrored(normal, gaze), 40.0);
}
