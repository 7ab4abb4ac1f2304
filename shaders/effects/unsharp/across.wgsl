// Blurs depth along rows. One invocation owns a pixel. The background counts with the greatest depth: if it were left out, the far rim of
// every slanted face would be darkened.

#import cutaway::depth_blur::{MOST_BLUR_PX, depth_share, first_weight, next_weight, unsharp}
#import cutaway::frame::{frame, pixel_index}
#import cutaway::layers::WORDS_PER_PIXEL

@group(1) @binding(0) var<storage, read> layers: array<u32>;
@group(1) @binding(1) var<storage, read_write> blurred: array<f32>;

fn share_at(at: vec2<u32>) -> f32 {
    let first = pixel_index(at) * WORDS_PER_PIXEL;
    return depth_share(layers[first], bitcast<f32>(layers[first + 2u]));
}

@compute @workgroup_size(16, 16)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= frame.size_px) {
        return;
    }
    let width = i32(frame.size_px.x);
    var weight = first_weight();
    var sum = share_at(id.xy);
    var weights = 1.0;
    for (var off = 1; off <= min(unsharp.reach_px, MOST_BLUR_PX); off++) {
        weight = next_weight(weight);
        for (var side = -1; side <= 1; side += 2) {
            let x = i32(id.x) + side * off;
            if x >= 0 && x < width {
                sum += weight.x * share_at(vec2<u32>(u32(x), id.y));
                weights += weight.x;
            }
        }
    }
    blurred[pixel_index(id.xy)] = sum / weights;
}
