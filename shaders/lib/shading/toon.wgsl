// Three tones with sharp edges and a highlight (Lake, Marshall, Harris, Blackstein 2000); caps have two.

#define_import_path cutaway::shading

#import cutaway::light::{key_light, mirrored}

// Blend between two tones at an edge: smooth over 0.02 of a cosine.
fn step_at(edge: f32, value: f32) -> f32 {
    return clamp((value - edge) / 0.02 + 0.5, 0.0, 1.0);
}

fn shaded(base: vec3<f32>, normal: vec3<f32>, gaze: vec3<f32>, is_cap: bool) -> vec3<f32> {
    let towards = dot(normal, key_light(gaze));
    if is_cap {
        return base * (0.88 + 0.12 * step_at(0.35, towards));
    }
    let tone = 0.42 + 0.30 * step_at(0.15, towards) + 0.30 * step_at(0.55, towards);
    let highlight = 0.6 * clamp((mirrored(normal, gaze) - 0.965) / 0.006 + 0.5, 0.0, 1.0);
    return mix(base * tone, vec3<f32>(1.0), highlight);
}
