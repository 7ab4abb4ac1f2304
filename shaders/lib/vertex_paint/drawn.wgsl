// Vertex paints that `vertex_paint.wgsl` drew: a colour and the part. Bound as @group(1) @binding(6).
//
// A pixel at an edge that the draw of vertex paints did not cover has the colour of a neighbouring pixel of the same part.

#define_import_path cutaway::vertex_paint

#import cutaway::layers::{SURFACE, kind_of, part_of}

@group(1) @binding(6) var vertex_paint_colors: texture_2d<u32>;

fn vertex_paint_at(at: vec2<u32>, word: u32) -> u32 {
    let own = textureLoad(vertex_paint_colors, at, 0).x;
    if own != 0u || kind_of(word) != SURFACE {
        return own;
    }
    var steps = array(vec2<i32>(1, 0), vec2<i32>(-1, 0), vec2<i32>(0, 1), vec2<i32>(0, -1));
    let size = vec2<i32>(textureDimensions(vertex_paint_colors));
    for (var i = 0; i < 4; i++) {
        let beside = clamp(vec2<i32>(at) + steps[i], vec2<i32>(0), size - 1);
        let color = textureLoad(vertex_paint_colors, beside, 0);
        if color.x != 0u && color.y == part_of(word) {
            return color.x;
        }
    }
    return 0u;
}
