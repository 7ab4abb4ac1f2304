// Converts the drawn words and depth into layers. One invocation owns one pixel.

#import cutaway::frame::{frame, depth_from_buffer, pixel_index}
#import cutaway::layers::WORDS_PER_PIXEL

@group(1) @binding(0) var surface_words: texture_2d<u32>;
@group(1) @binding(1) var surface_depth: texture_depth_2d;
@group(1) @binding(2) var<storage, read_write> layers: array<u32>;

@compute @workgroup_size(16, 16)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= frame.size_px) {
        return;
    }
    let drawn = textureLoad(surface_words, id.xy, 0).xy;
    let at = pixel_index(id.xy) * WORDS_PER_PIXEL;
    layers[at] = drawn.x;
    layers[at + 1u] = drawn.y;
    layers[at + 2u] = bitcast<u32>(depth_from_buffer(textureLoad(surface_depth, id.xy, 0)));
}
