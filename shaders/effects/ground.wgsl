// Darkens the background where the ray of a pixel meets the ground from above. One invocation owns a pixel.

#import cutaway::frame::{centre_of, frame, pixel_index, ray_through}
#import cutaway::layers::{BACKGROUND, WORDS_PER_PIXEL, kind_of}
#import cutaway::over::laid_over

struct Ground {
    x_row: vec4<f32>,
    y_row: vec4<f32>,
    up: vec4<f32>,
    side: u32,
    strength: f32,
    padding_a: u32,
    padding_b: u32,
}

@group(1) @binding(0) var<storage, read> layers: array<u32>;
@group(1) @binding(1) var<storage, read_write> picture: array<u32>;
@group(1) @binding(2) var<storage, read> ground_darkness: array<f32>;
@group(1) @binding(3) var<uniform> ground: Ground;

fn texel(at: vec2<i32>) -> f32 {
    if any(at < vec2<i32>(0)) || any(at >= vec2<i32>(i32(ground.side))) {
        return 0.0;
    }
    return ground_darkness[u32(at.y) * ground.side + u32(at.x)];
}

// The fraction of light that does not reach a point of the ground map; `at` is in texels.
fn darkness_at(at: vec2<f32>) -> f32 {
    let corner = floor(at - 0.5);
    let part = at - 0.5 - corner;
    let first = vec2<i32>(corner);
    let above = mix(texel(first), texel(first + vec2<i32>(1, 0)), part.x);
    let below = mix(texel(first + vec2<i32>(0, 1)), texel(first + vec2<i32>(1, 1)), part.x);
    return mix(above, below, part.y);
}

@compute @workgroup_size(16, 16)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= frame.size_px) {
        return;
    }
    let pixel = pixel_index(id.xy);
    if kind_of(layers[pixel * WORDS_PER_PIXEL]) != BACKGROUND {
        return;
    }
    let ray = ray_through(centre_of(id.xy));
    let falls = -dot(ground.up.xyz, ray.direction);
    let height = dot(ground.up, vec4<f32>(ray.origin, 1.0));
    if falls <= 1e-6 || height <= 0.0 {
        return;
    }
    let point = vec4<f32>(ray.origin + ray.direction * (height / falls), 1.0);
    let at = vec2<f32>(dot(ground.x_row, point), dot(ground.y_row, point));
    if any(at < vec2<f32>(-1.0)) || any(at > vec2<f32>(f32(ground.side) + 1.0)) {
        return;
    }
    let dark = ground.strength * darkness_at(at);
    if dark > 0.0 {
        picture[pixel] = laid_over(picture[pixel], vec3<f32>(0.0), dark);
    }
}
