// Draws the nearest layer of a sprite: depth only.

#import cutaway::vds::sprite_position

@vertex
fn vertex(@location(0) position: vec3<f32>) -> @builtin(position) @invariant vec4<f32> {
    return sprite_position(position);
}

@fragment
fn fragment() {
}
