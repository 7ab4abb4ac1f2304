// The nearest kept surfaces as the compute rasteriser left them in the layers, with values of the depth buffer for depths.

#define_import_path cutaway::drawn

#import cutaway::decision::{Drawn, layers}
#import cutaway::frame::pixel_index
#import cutaway::layers::WORDS_PER_PIXEL

fn drawn(at: vec2<u32>) -> Drawn {
    let first = pixel_index(at) * WORDS_PER_PIXEL;
    return Drawn(layers[first], layers[first + 1u], bitcast<f32>(layers[first + 2u]));
}
