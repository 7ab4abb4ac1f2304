// Input of a pyramid's lowest level: the texels of the map.

#define_import_path cutaway::pyramid_base

#import cutaway::pyramid::pyramid_table
#import cutaway::relief::heights

// Texel index along an axis; the index after the last one wraps or clamps.
fn texel_at(i: u32, size: u32, repeats: bool) -> u32 {
    if i < size {
        return i;
    }
    return select(size - 1u, 0u, repeats);
}

// Least and greatest height of a level-1 node, from up to 3 x 3 texels.
fn range_at(which: u32, level: u32, node: vec2<u32>) -> vec2<f32> {
    let size = pyramid_table.pyramids[which].map_size;
    let repeats = pyramid_table.pyramids[which].repeats != 0u;
    let first = pyramid_table.pyramids[which].first_texel;
    var range = vec2<f32>(3.4e38, -3.4e38);
    for (var j = 0u; j < 3u; j++) {
        let row = first + texel_at(min(2u * node.y + j, size.y), size.y, repeats) * size.x;
        for (var i = 0u; i < 3u; i++) {
            let height = heights[row + texel_at(min(2u * node.x + i, size.x), size.x, repeats)];
            range = vec2<f32>(min(range.x, height), max(range.y, height));
        }
    }
    return range;
}
