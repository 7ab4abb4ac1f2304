// Draws the layer of a sprite behind the one given (Everitt 2001): what lies at or before it is dropped. Fragments of equal
// depth, such as doubled faces, are thus lost: the parity then errs, which is the method's own fault and is left to show.

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
