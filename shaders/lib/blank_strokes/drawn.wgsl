// Clears borders and strokes. Bound as @group(1) @binding(0) and (1).

#define_import_path cutaway::blank_strokes

#import cutaway::borders::word_of_tile
#import cutaway::frame::pixel_index
#import cutaway::touched::TILE_PX

@group(1) @binding(0) var<storage, read_write> borders: array<u32>;
@group(1) @binding(1) var<storage, read_write> strokes: array<u32>;

fn blank_strokes(at: vec2<u32>) {
    let pixel = pixel_index(at);
    borders[pixel] = 0u;
    strokes[pixel] = 0u;
    let word = word_of_tile(at / TILE_PX);
    borders[word] = 0u;
    strokes[word] = 0u;
}
