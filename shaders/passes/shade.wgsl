// Makes a picture from layers, in the same way for every strategy and for the exact reference. One invocation owns one pixel.
// The open module `overlap` determines how shared caps of several solids look.

#import cutaway::background::background
#import cutaway::cuts::place_of_part
#import cutaway::frame::{frame, pixel_index}
#import cutaway::layers::{BACKGROUND, WORDS_PER_PIXEL, kind_of, part_of}
#import cutaway::lit::color_of

@group(1) @binding(0) var<storage, read> layers: array<u32>;
@group(1) @binding(2) var<storage, read_write> picture: array<u32>;

@compute @workgroup_size(16, 16)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= frame.size_px) {
        return;
    }
    let pixel = pixel_index(id.xy);
    let at = pixel * WORDS_PER_PIXEL;
    let word = layers[at];
    if kind_of(word) == BACKGROUND {
        picture[pixel] = background(id.y);
        return;
    }
    picture[pixel] = color_of(id.xy, word, layers[at + 1u], place_of_part(part_of(word)));
}
