// Decides one pixel after the compute rasteriser has found the surfaces. Until the pixel is painted, a surface stores the code of its
// triangle instead of its normal, and a cap the word of its crossing. Bound as @group(1) @binding(5).

#define_import_path cutaway::decide_pixel

#import cutaway::decision::{Drawn, decide, write}
#import cutaway::frame::pixel_index
#import cutaway::lanes::Lanes
#import cutaway::layers::{BACKGROUND, SURFACE, UNCOUNTED, UNRELIABLE, layer_word}

// Code of the triangle, and its depth-buffer value as bits.
@group(1) @binding(5) var<storage, read> nearest: array<vec2<u32>>;

fn decide_pixel(xy: vec2<u32>, lanes: Lanes) {
    let pixel = pixel_index(xy);
    let found = nearest[pixel];
    var drawn = Drawn(BACKGROUND, 0u, bitcast<f32>(found.y));
    if found.y != 0u {
        // A depth without a claiming triangle is a fault of the rasteriser.
        drawn.word = select(layer_word(SURFACE, UNCOUNTED, 0u), UNRELIABLE, found.x == 0u);
        drawn.normal = found.x;
    }
    let decision = decide(xy, lanes, drawn);
    write(xy, decision, decision.crossing);
}
