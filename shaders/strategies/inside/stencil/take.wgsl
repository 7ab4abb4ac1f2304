// Copies the stencil results into the words of the mask. One invocation owns one pixel.

#import cutaway::frame::{frame, pixel_count, pixel_index}

@group(1) @binding(0) var stencil: texture_2d<u32>;
@group(1) @binding(1) var<storage, read_write> mask: array<u32>;

// The stencil holds one winding number instead of bits.
override winds: bool = false;
// Number of stencil bits used, and the bit of the pixel's mask that each becomes: 32 word + bit.
override used: u32 = 0u;
override to_0: u32 = 0u;
override to_1: u32 = 0u;
override to_2: u32 = 0u;
override to_3: u32 = 0u;
override to_4: u32 = 0u;
override to_5: u32 = 0u;
override to_6: u32 = 0u;
override to_7: u32 = 0u;

@compute @workgroup_size(16, 16)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= frame.size_px) {
        return;
    }
    let pixel = pixel_index(id.xy);
    let found = textureLoad(stencil, id.xy, 0).x;
    let bits = select(found, min(found, 1u), winds);
    var targets = array<u32, 8>(to_0, to_1, to_2, to_3, to_4, to_5, to_6, to_7);
    for (var i = 0u; i < min(used, 8u); i++) {
        let at = targets[i] / 32u * pixel_count() + pixel;
        mask[at] |= ((bits >> i) & 1u) << (targets[i] % 32u);
    }
}
