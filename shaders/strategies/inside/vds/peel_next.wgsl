// Draws the sprite layer behind the given one (Everitt 2001): fragments at or in front of it are dropped. Fragments of equal depth, such as
// doubled faces, are thus lost: the parity is then wrong. This error of the method is deliberately left visible.

#import cutaway::sprite::sprite_position
#import cutaway::vds::sprite

@group(1) @binding(1) var previous: texture_depth_2d;

@vertex
fn vertex(@location(0) position: vec3<f32>) -> @builtin(position) @invariant vec4<f32> {
    return sprite_position(sprite, position);
}

@fragment
fn fragment(@builtin(position) at: vec4<f32>) {
    if at.z <= textureLoad(previous, vec2<u32>(at.xy), 0) {
        discard;
    }
}
