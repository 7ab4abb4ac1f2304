// Draws the nearest layer of a sprite: depth only.

#import cutaway::sprite::sprite_position
#import cutaway::vds::sprite

@vertex
fn vertex(@location(0) position: vec3<f32>) -> @builtin(position) @invariant vec4<f32> {
    return sprite_position(sprite, position);
}

@fragment
fn fragment() {
}
