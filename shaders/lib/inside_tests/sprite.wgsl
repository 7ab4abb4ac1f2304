// The box of one part as seen along a fixed axis, for drawing and sampling images of the part's volume (Trapp & Döllner 2013, section 5).
//
// Rows map a point of scene space to (s, t, depth), all in 0..1 over the part's box. Depth is linear, nearest first.

#define_import_path cutaway::sprite

#import cutaway::viewport::on_viewport

struct Sprite {
    s_row: vec4<f32>,
    t_row: vec4<f32>,
    depth_row: vec4<f32>,
    resolution: u32,
    layers: u32,
    // Index of this part's layer count in the need buffer, or of its lists among those of all parts.
    slot: u32,
    padding: u32,
}

// Result of testing a point against a volume image.
struct Probe {
    is_inside: bool,
    // True if the image overflowed, so that the answer may be wrong.
    in_doubt: bool,
}

fn sprite_from_scene(sprite: Sprite, point: vec3<f32>) -> vec3<f32> {
    let p = vec4<f32>(point, 1.0);
    return vec3<f32>(dot(sprite.s_row, p), dot(sprite.t_row, p), dot(sprite.depth_row, p));
}

// Clip-space position that draws a point into the sprite.
fn sprite_position(sprite: Sprite, point: vec3<f32>) -> vec4<f32> {
    let at = sprite_from_scene(sprite, point);
    let clip = vec4<f32>(2.0 * at.x - 1.0, 1.0 - 2.0 * at.y, at.z, 1.0);
    return on_viewport(clip, vec2<u32>(sprite.resolution));
}

// True if a point lies outside the image, and so outside the part.
fn is_beside(at: vec3<f32>) -> bool {
    return any(at.xy < vec2<f32>(0.0)) || any(at.xy >= vec2<f32>(1.0));
}

// The texel that contains a point in sprite coordinates.
fn texel_of(sprite: Sprite, at: vec3<f32>) -> vec2<u32> {
    return vec2<u32>(at.xy * f32(sprite.resolution));
}
