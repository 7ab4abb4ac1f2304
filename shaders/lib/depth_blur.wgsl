// A Gaussian along rows or columns of the picture, of depth. Bound as @group(2) @binding(0).

#define_import_path cutaway::depth_blur

#import cutaway::frame::frame
#import cutaway::layers::{BACKGROUND, kind_of}

struct Unsharp {
    // The length that is 1.
    diagonal: f32,
    // Standard deviation in pixels, and how many samples are taken to each side.
    sigma_px: f32,
    reach_px: i32,
    // How much darker it is where depth is greater than around by 1.
    strength: f32,
}

@group(2) @binding(0) var<uniform> unsharp: Unsharp;

// Weight of a sample at a distance in pixels.
fn weight_at(off: i32) -> f32 {
    let x = f32(off) / unsharp.sigma_px;
    return exp(-0.5 * x * x);
}

// Depth over the diagonal of the scene, which is around the origin of scene space: 0 before it, 1 behind it.
fn depth_share(word: u32, depth: f32) -> f32 {
    let middle = -dot(frame.ray_origin[0].xyz, frame.forward.xyz);
    let share = clamp((depth - middle) / unsharp.diagonal + 0.5, 0.0, 1.0);
    return select(share, 1.0, kind_of(word) == BACKGROUND);
}
