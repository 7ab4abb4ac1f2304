// The nearest kept surfaces, as drawn by the hardware rasteriser. Bound as @group(1) @binding(0) and (1).

#define_import_path cutaway::drawn

#import cutaway::decision::Drawn

@group(1) @binding(0) var surface_words: texture_2d<u32>;
@group(1) @binding(1) var surface_depth: texture_depth_2d;

fn drawn(at: vec2<u32>) -> Drawn {
    let words = textureLoad(surface_words, at, 0).xy;
    return Drawn(words.x, words.y, textureLoad(surface_depth, at, 0));
}
