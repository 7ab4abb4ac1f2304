// Gaussian blur of depth along rows or columns of the picture. Bound as @group(2) @binding(0).

#define_import_path cutaway::depth_blur

#import cutaway::frame::frame
#import cutaway::layers::{BACKGROUND, kind_of}

// Greatest reach of a blur: half of the largest picture.
const MOST_BLUR_PX: i32 = 4096;

struct Unsharp {
    // Unit of length: a distance of this many scene units counts as 1.
    diagonal: f32,
    // Standard deviation in pixels, and number of samples to each side.
    sigma_px: f32,
    reach_px: i32,
    // Darkening where the depth exceeds that of the surroundings by 1.
    strength: f32,
}

@group(2) @binding(0) var<uniform> unsharp: Unsharp;

// Incremental Gaussian weights (Turkowski, GPU Gems 3, 40), each computed from the previous by two products. Components: the weight at
// distance 0, the factor to the next weight, and the factor to the next factor.
fn first_weight() -> vec3<f32> {
    let step = exp(-0.5 / (unsharp.sigma_px * unsharp.sigma_px));
    return vec3<f32>(1.0, step, step * step);
}

fn next_weight(weight: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(weight.x * weight.y, weight.y * weight.z, weight.z);
}

// Depth divided by the scene's diagonal, centred on the origin of scene space: 0 in front of the scene, 1 behind it.
fn depth_share(word: u32, depth: f32) -> f32 {
    let middle = -dot(frame.ray_origin[0].xyz, frame.forward.xyz);
    let share = clamp((depth - middle) / unsharp.diagonal + 0.5, 0.0, 1.0);
    return select(share, 1.0, kind_of(word) == BACKGROUND);
}
