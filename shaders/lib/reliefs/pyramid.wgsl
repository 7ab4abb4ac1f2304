// Pyramids over offset maps: the least and the greatest height of each block of cells, read along a ray.
//
// Cell (i, j) of a map spans the texel centres i, i + 1 and j, j + 1, for i from 0 to one less than the width: the last cell spans the last
// texel and the one after it, which is the first texel if the map repeats, else the last again. Node k of level l covers along each axis
// the cells from k 2^l up to (k + 1) 2^l, or to the end of the map. It need not be square, sizes need not be powers of two, and all levels
// begin at the same border.
//
// The cells that a ray passes are those of the infinite plane; a node follows from any of its cells, in integers, and so does the border at
// which the ray leaves the node:
//
// - *repeat*: the plane is copies of the map side by side; a node never reaches beyond its copy;
// - *mirror*: every other copy is turned round, with the cell at its far end between the first texel and itself, which belongs to
//   node 0; the cell between the last texel and itself belongs to the copy that is not turned;
// - *clamp*: beyond the map heights do not change along that axis; nodes go on in their own width, and have the heights of
//   the first or last node of the map.
//
// Bound as @group(0) @binding(8) and (9).

#define_import_path cutaway::pyramid

#import cutaway::relief::{Map, MIRROR, REPEAT, remainder}

// The lowest stored level: cells of its blocks near the ray are visited one by one.
const LOWEST: u32 = 2u;

// The pyramid of the map of a clip-surface.
struct Pyramid {
    first_texel: u32,
    // The highest level, stored from LOWEST on; 0 if the clip-surface is a plane.
    levels: u32,
    map_size: vec2<u32>,
    // 1 if the map repeats.
    repeats: u32,
    // 1 in the first of the rows that share a pyramid.
    is_own: u32,
    padding: vec2<u32>,
    // First node of level 4 i + j + 1 in [i][j].
    first_node: array<vec4<u32>, 4>,
}

struct PyramidTable {
    // Indexed by clip-surface.
    pyramids: array<Pyramid, 32>,
}

@group(0) @binding(8) var<uniform> pyramid_table: PyramidTable;
// Least and greatest height.
@group(0) @binding(9) var<storage, read> nodes: array<vec2<f32>>;

// A node along one axis.
struct Along {
    // Number of the node.
    node: u32,
    // The border at which the ray leaves the node.
    border: i32,
    // True if this is also a border of the parent node.
    closes: bool,
}

// Number of nodes side by side in a level.
fn nodes_of(cells: u32, level: u32) -> u32 {
    return (cells + (1u << level) - 1u) >> level;
}

// The node of a cell along one axis of the map, for a ray that goes up or down that axis.
fn along(cell: i32, level: u32, size: u32, wrap: u32, up: bool) -> Along {
    let n = i32(size);
    let width = 1i << level;
    var place = cell;
    if wrap == REPEAT {
        place = remainder(cell, n);
    } else if wrap == MIRROR {
        place = remainder(cell, 2 * n);
    } else {
        let node = clamp(cell, 0, n - 1) >> level;
        let number = cell >> level;
        return Along(u32(node), (number + select(0, 1, up)) << level, ((number & 1) != 0) == up);
    }
    let base = cell - place;
    if place < n {
        let node = place >> level;
        let low = node << level;
        let high = min(low + width, n);
        let border = base + select(low, high, up);
        return Along(u32(node), border, select((node & 1) == 0, (node & 1) != 0 || high == n, up));
    }
    // Mirrored: up is towards the first cell of the map, and beyond it.
    let node = max(2 * n - 2 - place, 0) >> level;
    let low = select(node << level, -1, node == 0);
    let high = min((node << level) + width, n - 1);
    var border = base + 2 * n - 1 - select(high, low, up);
    if level == 0u {
        border = cell + select(0, 1, up);
    }
    return Along(u32(node), border, select((node & 1) != 0 || high == n - 1, (node & 1) == 0, up));
}

// First node of a level.
fn first_of(surface: u32, level: u32) -> u32 {
    return pyramid_table.pyramids[surface].first_node[(level - 1u) / 4u][(level - 1u) % 4u];
}

// Least and greatest height of a node of the pyramid of a clip-surface.
fn range_of(surface: u32, map: Map, level: u32, node: vec2<u32>) -> vec2<f32> {
    return nodes[first_of(surface, level) + node.y * nodes_of(map.size.x, level) + node.x];
}

fn levels_of(surface: u32) -> u32 {
    return pyramid_table.pyramids[surface].levels;
}
