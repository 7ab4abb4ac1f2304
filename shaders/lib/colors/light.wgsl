// Light: a key light over the viewer's left shoulder and a cool fill from the right, under a sky.

#define_import_path cutaway::light

#import cutaway::frame::frame

fn right_of_view() -> vec3<f32> {
    return normalize(frame.ray_step[0].xyz);
}

fn up_of_view() -> vec3<f32> {
    return -normalize(frame.ray_step[1].xyz);
}

// Direction towards the key light.
fn key_light(gaze: vec3<f32>) -> vec3<f32> {
    return normalize(-gaze + 0.55 * up_of_view() - 0.65 * right_of_view());
}

// Light that a matte white surface reflects to the eye.
fn diffuse_light(normal: vec3<f32>, gaze: vec3<f32>) -> vec3<f32> {
    let up = up_of_view();
    let fill = normalize(-gaze - 0.10 * up + 0.90 * right_of_view());
    let sky = 0.5 + 0.5 * dot(normal, up);
    let ambient = mix(vec3<f32>(0.13, 0.12, 0.12), vec3<f32>(0.30, 0.32, 0.36), sky);
    return ambient + 0.80 * max(dot(normal, key_light(gaze)), 0.0) * vec3<f32>(1.0, 0.97, 0.92) + 0.20 * max(dot(normal, fill), 0.0) * vec3<f32>(0.75, 0.85, 1.0);
}

// Cosine of the angle between the normal and the direction that would mirror the key light into the eye.
fn mirrored(normal: vec3<f32>, gaze: vec3<f32>) -> f32 {
    return max(dot(normal, normalize(key_light(gaze) - gaze)), 0.0);
}
