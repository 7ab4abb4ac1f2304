// Counts the fragments of each texel of a sprite: the largest count is the depth complexity at the sprite's resolution, and the number of
// layers that it needs.

#import cutaway::sprite::sprite_position
#import cutaway::vds::sprite

@group(1) @binding(1) var<storage, read_write> counts: array<atomic<u32>>;
@group(1) @binding(2) var<storage, read_write> need: array<atomic<u32>>;

@vertex
fn vertex(@location(0) position: vec3<f32>) -> @builtin(position) @invariant vec4<f32> {
    return sprite_position(sprite, position);
}

@fragment
fn fragment(@builtin(position) at: vec4<f32>) {
    let texel = u32(at.y) * sprite.resolution + u32(at.x);
    let count = atomicAdd(&counts[texel], 1u) + 1u;
    if count > atomicLoad(&need[sprite.slot]) {
        atomicMax(&need[sprite.slot], count);
    }
}
