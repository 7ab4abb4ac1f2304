// Pixels are coloured as soon as their layers are complete, by lit shading. Bound as @group(1) @binding(1) and (2).

#define_import_path cutaway::coloring

#import cutaway::cuts::place_of_part
#import cutaway::layers::part_of
#import cutaway::lit::color_of

@group(1) @binding(2) var<storage, read_write> picture: array<u32>;

fn color_pixel(pixel: u32, at: vec2<u32>, word: u32, normal: u32) {
    picture[pixel] = color_of(at, word, normal, place_of_part(part_of(word)));
}
