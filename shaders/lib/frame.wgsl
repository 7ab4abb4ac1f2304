// The frame: the mapping from scene space to pixels and depth-buffer values. Bound as @group(0) @binding(0).
//
// Depth is the distance from the eye along the viewing direction. The buffer is reversed: near is 1, farther is less; in
// perspective z = near / depth. "Behind" is therefore `z <`, and is written `is_behind` everywhere.

#define_import_path cutaway::frame

struct Frame {
    clip_from_scene: mat4x4<f32>,
    // The ray through (x, y) in pixels starts at ray_origin[0] + x ray_origin[1] + y ray_origin[2]; its direction likewise.
    ray_origin: array<vec4<f32>, 3>,
    ray_direction: array<vec4<f32>, 3>,
    // The scene-space step of one pixel to the right and one down, at depth 1 in perspective.
    ray_step: array<vec4<f32>, 2>,
    forward: vec4<f32>,
    // Box around the cut solids, slightly larger than they are: nothing outside it affects a cap.
    box_min: vec4<f32>,
    box_max: vec4<f32>,
    size_px: vec2<u32>,
    near: f32,
    far: f32,
    orthographic: u32,
    near_cap: u32,
    // First row of this band in the whole picture, and number of rows of the picture, for values that depend on the position in it.
    band: vec2<u32>,
}

@group(0) @binding(0) var<uniform> frame: Frame;

struct Ray {
    origin: vec3<f32>,
    direction: vec3<f32>,
}

// Centre of a pixel.
fn centre_of(pixel: vec2<u32>) -> vec2<f32> {
    return vec2<f32>(pixel) + 0.5;
}

// The ray through a point of the picture, parametrised by depth.
fn ray_through(at_px: vec2<f32>) -> Ray {
    let o = frame.ray_origin[0] + at_px.x * frame.ray_origin[1] + at_px.y * frame.ray_origin[2];
    let d = frame.ray_direction[0] + at_px.x * frame.ray_direction[1] + at_px.y * frame.ray_direction[2];
    return Ray(o.xyz, d.xyz);
}

fn buffer_from_depth(depth: f32) -> f32 {
    if frame.orthographic != 0u {
        return (frame.far - depth) / (frame.far - frame.near);
    }
    return frame.near / depth;
}

fn depth_from_buffer(z: f32) -> f32 {
    if frame.orthographic != 0u {
        return frame.far - z * (frame.far - frame.near);
    }
    return frame.near / z;
}

// True if a fragment at `z` lies strictly behind a crossing at `crossing`. No other code compares depths, except for the next function.
fn is_behind(z: f32, crossing: f32) -> bool {
    return z < crossing;
}

// `is_behind` for four crossings.
fn are_behind(z: f32, crossings: vec4<f32>) -> vec4<bool> {
    return vec4<f32>(z) < crossings;
}

// Index of a pixel in per-pixel buffers.
fn pixel_index(pixel: vec2<u32>) -> u32 {
    return pixel.y * frame.size_px.x + pixel.x;
}

fn pixel_count() -> u32 {
    return frame.size_px.x * frame.size_px.y;
}

// Depths at which a ray enters and leaves the box around the cut solids; empty when x >= y.
fn box_interval(ray: Ray) -> vec2<f32> {
    // A component of zero gives infinities of the right sign, or NaN for a ray inside a face of the box, but the box's margin keeps its
    // faces away from every solid.
    let inverse = 1.0 / ray.direction;
    let a = (frame.box_min.xyz - ray.origin) * inverse;
    let b = (frame.box_max.xyz - ray.origin) * inverse;
    let low = min(a, b);
    let high = max(a, b);
    let enter = max(max(low.x, low.y), max(low.z, frame.near));
    let leave = min(high.x, min(high.y, high.z));
    return vec2<f32>(enter, leave);
}
