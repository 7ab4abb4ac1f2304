// Input of a pyramid's higher levels: up to four nodes of the level below.

#define_import_path cutaway::pyramid_base

#import cutaway::pyramid::{first_of, nodes_of, pyramid_table}
#import cutaway::pyramid_built::built

// Least and greatest height of a node of a level above the first.
fn range_at(which: u32, level: u32, node: vec2<u32>) -> vec2<f32> {
    let size = pyramid_table.pyramids[which].map_size;
    let width = nodes_of(size.x, level - 1u);
    let last = vec2<u32>(width, nodes_of(size.y, level - 1u)) - 1u;
    let first = first_of(which, level - 1u);
    var range = vec2<f32>(3.4e38, -3.4e38);
    for (var j = 0u; j < 2u; j++) {
        let row = first + min(2u * node.y + j, last.y) * width;
        for (var i = 0u; i < 2u; i++) {
            let below = built[row + min(2u * node.x + i, last.x)];
            range = vec2<f32>(min(range.x, below.x), max(range.y, below.y));
        }
    }
    return range;
}
