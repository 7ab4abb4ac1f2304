// Blurs depth along columns, and computes light from the difference between blurred and original depth: less where the surroundings are
// nearer (Luft, Colditz and Deussen 2006; Trapp and Döllner 2013, 4.5). One invocation owns a pixel.

#import cutaway::depth_blur::{MOST_BLUR_PX, depth_share, first_weight, next_weight, unsharp}
#import cutaway::frame::{frame, pixel_index}
#import cutaway::layers::{BACKGROUND, WORDS_PER_PIXEL, kind_of}

@group(1) @binding(0) var<storage, read> layers: array<u32>;
@group(1) @binding(1) var<storage, read> blurred: array<f32>;
@group(1) @binding(2) var<storage, read_write> visibility: array<f32>;

@compute @workgroup_size(16, 16)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= frame.size_px) {
        return;
    }
    let pixel = pixel_index(id.xy);
    let first = pixel * WORDS_PER_PIXEL;
    if kind_of(layers[first]) == BACKGROUND {
        visibility[pixel] = 1.0;
        return;
    }
    let rows = i32(frame.size_px.y);
    var weight = first_weight();
    var sum = blurred[pixel];
    var weights = 1.0;
    for (var off = 1; off <= min(unsharp.reach_px, MOST_BLUR_PX); off++) {
        weight = next_weight(weight);
        for (var side = -1; side <= 1; side += 2) {
            let y = i32(id.y) + side * off;
            if y >= 0 && y < rows {
                sum += weight.x * blurred[pixel_index(vec2<u32>(id.x, u32(y)))];
                weights += weight.x;
            }
        }
    }
    let depth = depth_share(layers[first], bitcast<f32>(layers[first + 2u]));
    visibility[pixel] = clamp(1.0 + unsharp.strength * min(sum / weights - depth, 0.0), 0.0, 1.0);
}
