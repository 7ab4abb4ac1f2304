// Pixels are coloured by later passes, some of which read neighbouring pixels.

#define_import_path cutaway::coloring

fn color_pixel(pixel: u32, at: vec2<u32>, word: u32, normal: u32) {
}
