// Heights between texels exactly as defined: bilinear interpolation of four texels in f32.

#define_import_path cutaway::height_filter

#import cutaway::relief::height_at

// Height of the map at texel coordinates.
fn filtered_height(surface: u32, texel: vec2<f32>) -> f32 {
    return height_at(surface, texel);
}
