// Reliefs: heights of offset maps, bilinear between texel centres, from four texels. Bound as @group(0) @binding(3).
//
// All offset maps lie one after the other in one buffer. Texel coordinates have their centres at integers, so the cell
// (i, j) lies between the centres i, i + 1 and j, j + 1; cells are counted by integers and wrap by integers.

#define_import_path cutaway::relief

#import cutaway::cuts::{cut_table, NO_RELIEF}

@group(0) @binding(3) var<storage, read> heights: array<f32>;

const REPEAT: u32 = 0u;
const MIRROR: u32 = 1u;

// Remainder in 0..n of an address within 2^24. The quotient in f32 is off by at most one, which the last lines correct; an integer
// remainder takes half the time of a walk over a relief if the device has no vector instruction for it.
fn remainder(address: i32, n: i32) -> i32 {
    let m = address - i32(floor(f32(address) / f32(n))) * n;
    return select(select(m, m - n, m >= n), m + n, m < 0);
}

fn wrapped(address: i32, size: u32, wrap: u32) -> u32 {
    let n = i32(size);
    if wrap == REPEAT {
        return u32(remainder(address, n));
    }
    if wrap == MIRROR {
        let p = remainder(address, 2 * n);
        return u32(select(p, 2 * n - 1 - p, p >= n));
    }
    return u32(clamp(address, 0, n - 1));
}

// The bilinear form of a cell: h + x * along.x + y * along.y + x y twist, x and y in 0..1.
struct Cell {
    base: f32,
    along: vec2<f32>,
    twist: f32,
}

// Offset, size and wrapping of a clip-surface's map: loaded once, because a loop that writes would reload it in every iteration.
struct Map {
    first: u32,
    size: vec2<u32>,
    wrap: u32,
}

fn map_of(surface: u32) -> Map {
    return Map(
        cut_table.surfaces[surface].first_texel,
        cut_table.surfaces[surface].map_size,
        cut_table.surfaces[surface].wrap,
    );
}

// Offset of a row of the map.
fn row_of(map: Map, y: i32) -> u32 {
    return map.first + wrapped(y, map.size.y, map.wrap) * map.size.x;
}

// The heights at the corners of a cell: (0, 0), (1, 0), (0, 1), (1, 1).
fn corners_of(map: Map, cell: vec2<i32>) -> vec4<f32> {
    let x0 = wrapped(cell.x, map.size.x, map.wrap);
    let x1 = wrapped(cell.x + 1, map.size.x, map.wrap);
    let y0 = row_of(map, cell.y);
    let y1 = row_of(map, cell.y + 1);
    return vec4<f32>(heights[y0 + x0], heights[y0 + x1], heights[y1 + x0], heights[y1 + x1]);
}

// A cell's corners from those of its neighbour: two are shared. `by_x` is the axis of the step, `up` its direction.
fn corners_beside(map: Map, corners: vec4<f32>, cell: vec2<i32>, by_x: bool, up: bool) -> vec4<f32> {
    let side = cell + select(0, 1, up);
    let first = select(vec2<i32>(cell.x, side.y), vec2<i32>(side.x, cell.y), by_x);
    let second = first + select(vec2<i32>(1, 0), vec2<i32>(0, 1), by_x);
    let at_first = heights[row_of(map, first.y) + wrapped(first.x, map.size.x, map.wrap)];
    let at_second = heights[row_of(map, second.y) + wrapped(second.x, map.size.x, map.wrap)];
    // A step in x keeps a column, a step in y a row.
    let kept = select(select(corners.xy, corners.zw, up), select(corners.xz, corners.yw, up), by_x);
    let low = select(vec2<f32>(at_first, at_second), kept, up);
    let high = select(kept, vec2<f32>(at_first, at_second), up);
    return select(vec4<f32>(low, high), vec4<f32>(low.x, high.x, low.y, high.y), by_x);
}

fn cell_between(corners: vec4<f32>) -> Cell {
    let along = corners.yz - corners.x;
    return Cell(corners.x, along, (corners.w - corners.y) - along.y);
}

fn cell_of(map: Map, cell: vec2<i32>) -> Cell {
    return cell_between(corners_of(map, cell));
}

fn cell_at(surface: u32, cell: vec2<i32>) -> Cell {
    return cell_of(map_of(surface), cell);
}

fn height_in(cell: Cell, at: vec2<f32>) -> f32 {
    return cell.base + cell.along.x * at.x + cell.along.y * at.y + cell.twist * at.x * at.y;
}

// Height of the map at texel coordinates.
fn height_at(surface: u32, texel: vec2<f32>) -> f32 {
    let corner = floor(texel);
    return height_in(cell_at(surface, vec2<i32>(corner)), texel - corner);
}

// Unit normal of the clip-surface at a point on it, toward the removed side: the outside of a cap.
fn cap_normal(surface: u32, point: vec3<f32>) -> vec3<f32> {
    let normal = cut_table.surfaces[surface].normal.xyz;
    if cut_table.surfaces[surface].first_texel == NO_RELIEF {
        return -normal;
    }
    let p = vec4<f32>(point, 1.0);
    let texel = vec2<f32>(dot(cut_table.surfaces[surface].texel_x_row, p), dot(cut_table.surfaces[surface].texel_y_row, p));
    let corner = floor(texel);
    let cell = cell_at(surface, vec2<i32>(corner));
    let at = texel - corner;
    let scale = cut_table.surfaces[surface].scale;
    let slope = vec2<f32>(cell.along.x + cell.twist * at.y, cell.along.y + cell.twist * at.x) * scale.xy * scale.z;
    return -normalize(normal + slope.x * cut_table.surfaces[surface].u_hat.xyz + slope.y * cut_table.surfaces[surface].v_hat.xyz);
}
