// Depth, blurred along rows. One invocation owns a pixel. The background is as far as anything: left out, it would darken the far rim of
// every slanted face.

#import cutaway::depth_blur::{depth_share, unsharp, weight_at}
#import cutaway::frame::{frame, pixel_index}
#import cutaway::layers::WORDS_PER_PIXEL

@group(1) @binding(0) var<storage, read> layers: array<u32>;
@group(1) @binding(1) var<storage, read_write> blurred: array<f32>;

@compute @workgroup_size(16, 16)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= frame.size_px) {
        return;
    }
    var sum = 0.0;
    var weights = 0.0;
    let x = i32(id.x);
    for (var off = max(-unsharp.reach_px, -x); off <= min(unsharp.reach_px, i32(frame.size_px.x) - 1 - x); off++) {
        let weight = weight_at(off);
        let first = pixel_index(vec2<u32>(u32(x + off), id.y)) * WORDS_PER_PIXEL;
        sum += weight * depth_share(layers[first], bitcast<f32>(layers[first + 2u]));
        weights += weight;
    }
    blurred[pixel_index(id.xy)] = sum / weights;
}
