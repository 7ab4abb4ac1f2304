// Resets the fragment counts of a sprite, and the need derived from them, to zero. One invocation owns one texel.

#import cutaway::vds::sprite

@group(1) @binding(1) var<storage, read_write> counts: array<u32>;
@group(1) @binding(2) var<storage, read_write> need: array<u32>;

@compute @workgroup_size(16, 16)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= vec2<u32>(sprite.resolution)) {
        return;
    }
    counts[id.y * sprite.resolution + id.x] = 0u;
    if id.x == 0u && id.y == 0u {
        need[sprite.slot] = 0u;
    }
}
