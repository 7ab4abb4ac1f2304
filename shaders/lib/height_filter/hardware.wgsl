// Heights between texels from the GPU's sampler: one fetch. Bound as @group(0) @binding(10) and (11).
//
// A sampler resolves the position within a cell with few bits, 8 on nearly all devices: along an axis the height is off by up to 1/512 of
// its change in a cell, and it changes in steps. All maps are layers of one texture and have the same size, so the layer follows from the
// map's offset among the heights. The sampler sets one address mode for all maps.

#define_import_path cutaway::height_filter

#import cutaway::cuts::cut_table

@group(0) @binding(10) var relief_maps: texture_2d_array<f32>;
@group(0) @binding(11) var relief_sampler: sampler;

// Height of the map at texel coordinates.
fn filtered_height(surface: u32, texel: vec2<f32>) -> f32 {
    let size = cut_table.surfaces[surface].map_size;
    let layer = cut_table.surfaces[surface].first_texel / (size.x * size.y);
    return textureSampleLevel(relief_maps, relief_sampler, (texel + 0.5) / vec2<f32>(size), layer, 0.0).x;
}
