// The volumetric depth sprite of one part: a layered depth image along a fixed axis, and the parity test on it
// (Trapp & Döllner 2013, section 5). Bound as @group(1) @binding(0).
//
// Rows take a point of scene space to (s, t, depth), all in 0..1 over the part's box. Depth is linear; nearest layer first.

#define_import_path cutaway::vds

struct Sprite {
    s_row: vec4<f32>,
    t_row: vec4<f32>,
    depth_row: vec4<f32>,
    resolution: u32,
    layers: u32,
    // Where this part's layer count goes in the need buffer.
    slot: u32,
    padding: u32,
}

@group(1) @binding(0) var<uniform> sprite: Sprite;

fn sprite_from_scene(point: vec3<f32>) -> vec3<f32> {
    let p = vec4<f32>(point, 1.0);
    return vec3<f32>(dot(sprite.s_row, p), dot(sprite.t_row, p), dot(sprite.depth_row, p));
}

// Clip position that draws a point into the sprite.
fn sprite_position(point: vec3<f32>) -> vec4<f32> {
    let at = sprite_from_scene(point);
    return vec4<f32>(2.0 * at.x - 1.0, 1.0 - 2.0 * at.y, at.z, 1.0);
}
