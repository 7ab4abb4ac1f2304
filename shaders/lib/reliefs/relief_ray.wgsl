// A ray's walk over the cells of an offset map: where it may cross the relief, and the crossings in one cell.
//
// Along the ray the bilinear height of a cell is quadratic in the depth. Whether a cell holds a crossing is decided by signs: the sign at a
// cell's entry is carried over from the previous cell, so the number of crossings has the parity that the two ends of the ray imply. Roots
// only locate crossings: citardauq form, clamped to the cell. The open module `relief_crossing` determines which cells the ray passes, and
// which can be skipped.

#define_import_path cutaway::relief_ray

#import cutaway::asked::Interval
#import cutaway::crossing_list::{List, add}
#import cutaway::cuts::cut_table
#import cutaway::frame::buffer_from_depth
#import cutaway::quadratic::roots_in
#import cutaway::rays::{ray_table, along_ray}
#import cutaway::relief::{Map, cell_between, corners_beside, height_in, map_of}
#import cutaway::slab::slab_beside

// A ray's way through the slab of a relief. Depths count from `start`, and values along the ray are x + depth * y.
struct Way {
    surface: u32,
    start: f32,
    // Depth at which the way ends; the way is empty if this depth is 0 or less.
    end: f32,
    // Requested interval. It does not affect results: those at a depth equal the results for the whole way, bit for bit.
    first: f32,
    last: f32,
    // True if the way begins and ends on a border of the slab, where the side is known without the map.
    from_slab: bool,
    to_slab: bool,
    // True if the ray rises over the plane, false if it falls or stays level.
    rises: bool,
    texel_x: vec2<f32>,
    texel_y: vec2<f32>,
    over_plane: vec2<f32>,
    // Height of a texel of value 1.
    relief_scale: f32,
    map: Map,
}

// State that a ray carries from cell to cell.
struct Carried {
    // Depth at which the next cell is entered.
    entry: f32,
    kept: bool,
    begun: bool,
}

// Direction in which a ray walks the cells.
struct Heading {
    up: vec2<bool>,
    // Step to the next cell along each axis.
    step: vec2<i32>,
    // Offset of the border ahead: that of cell i is border i + 1 when walking up, i when walking down.
    ahead: vec2<i32>,
}

fn heading_of(way: Way) -> Heading {
    let up = vec2<bool>(way.texel_x.y > 0.0, way.texel_y.y > 0.0);
    return Heading(up, select(vec2<i32>(-1), vec2<i32>(1), up), select(vec2<i32>(0), vec2<i32>(1), up));
}

// The first cell of the requested interval, and the depth at which the ray enters it.
struct Begin {
    cell: vec2<i32>,
    entry: f32,
}

fn begin_of(way: Way) -> Begin {
    let x = way.texel_x;
    let y = way.texel_y;
    let cell = vec2<i32>(vec2<f32>(floor(x.x + way.first * x.y), floor(y.x + way.first * y.y)));
    if way.first <= 0.0 {
        return Begin(cell, 0.0);
    }
    // The border behind: i when walking up, i + 1 when walking down.
    let behind = cell + select(vec2<i32>(1), vec2<i32>(0), vec2<bool>(x.y > 0.0, y.y > 0.0));
    let entries = vec2<f32>(depth_at_border(behind.x, x), depth_at_border(behind.y, y));
    let met = select(vec2<f32>(0.0), entries, vec2<bool>(abs(x.y) > 0.0, abs(y.y) > 0.0));
    return Begin(cell, max(0.0, max(met.x, met.y)));
}

// Depth at which a linear value reaches a cell border with an integer number; infinite if it never does.
fn depth_at_border(border: i32, value: vec2<f32>) -> f32 {
    return select((f32(border) - value.x) / value.y, 3.4e38, value.y == 0.0);
}

// The way of a pixel's ray inside an interval of depths, for the requested part. If it is empty, the ray is on one side throughout that
// part, which is recorded.
fn way_through(list: ptr<function, List>, surface: u32, at_px: vec2<f32>, asked: Interval) -> Way {
    let interval = asked.all;
    let height = along_ray(ray_table.surfaces[surface].height, at_px);
    let sides = slab_beside(surface, height.x);
    let removed_below = sides.x;
    let kept_above = sides.y;
    var walk = interval;
    let is_parallel = !(abs(height.y) > 0.0);
    if !is_parallel {
        let a = (kept_above - height.x) / height.y;
        let b = (removed_below - height.x) / height.y;
        walk = vec2<f32>(max(interval.x, min(a, b)), min(interval.y, max(a, b)));
    }
    let texel_x = along_ray(ray_table.surfaces[surface].texel_x, at_px);
    let texel_y = along_ray(ray_table.surfaces[surface].texel_y, at_px);
    var way = Way(
        surface,
        walk.x,
        walk.y - walk.x,
        max(0.0, asked.part.x - walk.x),
        min(walk.y, asked.part.y) - walk.x,
        walk.x > interval.x && asked.part.x <= walk.x,
        interval.y > walk.y,
        height.y > 0.0,
        vec2<f32>(texel_x.x + walk.x * texel_x.y, texel_x.y),
        vec2<f32>(texel_y.x + walk.x * texel_y.y, texel_y.y),
        vec2<f32>(height.x + walk.x * height.y, height.y),
        cut_table.surfaces[surface].scale.z,
        map_of(surface),
    );
    let is_beside = walk.x >= asked.part.y || walk.y <= asked.part.x;
    if walk.x >= walk.y || is_beside || (is_parallel && (height.x >= kept_above || height.x <= removed_below)) {
        way.end = 0.0;
        let at_start = height.x + asked.part.x * height.y;
        if at_start < 0.5 * (kept_above + removed_below) {
            (*list).sides |= 1u << surface;
        }
    }
    return way;
}

// Records the side on which the way begins.
fn begin_way(list: ptr<function, List>, way: Way, carried: ptr<function, Carried>, kept: bool) {
    (*carried).begun = true;
    (*carried).kept = kept;
    if !kept {
        (*list).sides |= 1u << way.surface;
    }
}

// Crossings in a cell: their number, their depths from the start of the way, and whether the ray is on the kept side before them.
struct Found {
    count: u32,
    at: vec2<f32>,
    kept: bool,
}

// Finds the crossings in a cell with these corner heights, from where the ray enters it to `exit`.
fn cross_cell(
    list: ptr<function, List>,
    way: Way,
    carried: ptr<function, Carried>,
    cell: vec2<i32>,
    corners: vec4<f32>,
    exit: f32,
) -> Found {
    let entry = (*carried).entry;
    let length = exit - entry;
    let x = way.texel_x;
    let y = way.texel_y;
    let form = cell_between(corners);
    let at = vec2<f32>(x.x + entry * x.y - f32(cell.x), y.x + entry * y.y - f32(cell.y));
    let slope = form.along + form.twist * at.yx;
    let a = way.relief_scale * form.twist * x.y * y.y;
    let b = way.over_plane.y + way.relief_scale * dot(slope, vec2<f32>(x.y, y.y));
    let c = way.over_plane.x + entry * way.over_plane.y + way.relief_scale * height_in(form, at);
    if !(*carried).begun {
        begin_way(list, way, carried, select(c >= 0.0, way.over_plane.y < 0.0, way.from_slab));
    }
    var kept_at_exit = c + length * (b + a * length) >= 0.0;
    if exit >= way.end && way.to_slab {
        kept_at_exit = way.rises;
    }
    let kept = (*carried).kept;
    let roots = roots_in(a, b, c, length, kept, kept_at_exit);
    (*carried).kept = kept_at_exit;
    (*carried).entry = exit;
    return Found(roots.count, entry + roots.at, kept);
}

// Result of a step of the walk: the crossings in the cell, whether it is the last one needed, and the axis along which it is left.
struct CellStep {
    found: Found,
    is_last: bool,
    by_x: bool,
}

fn no_step() -> CellStep {
    return CellStep(Found(0u, vec2<f32>(0.0), false), false, false);
}

// Finds the crossings in the ray's current cell and steps to the next one, given the corner heights. `add_found` adds them outside the loop
// over cells: most cells have none, and a device may execute a loop's whole body in every iteration, masked.
fn walk_cell(
    list: ptr<function, List>,
    way: Way,
    heading: Heading,
    carried: ptr<function, Carried>,
    cell: ptr<function, vec2<i32>>,
    corners: ptr<function, vec4<f32>>,
) -> CellStep {
    let border_x = depth_at_border((*cell).x + heading.ahead.x, way.texel_x);
    let border_y = depth_at_border((*cell).y + heading.ahead.y, way.texel_y);
    let exit = max((*carried).entry, min(way.end, min(border_x, border_y)));
    let found = cross_cell(list, way, carried, *cell, *corners, exit);
    // Ties step in x first; the cell in between has length zero.
    let by_x = border_x <= border_y;
    *cell += select(vec2<i32>(0, heading.step.y), vec2<i32>(heading.step.x, 0), by_x);
    *corners = corners_beside(way.map, *corners, *cell, by_x, select(heading.up.y, heading.up.x, by_x));
    return CellStep(found, exit >= way.last, by_x);
}

// Adds a cell's crossings to the list; returns true if no others are wanted.
fn add_found(list: ptr<function, List>, way: Way, found: Found) -> bool {
    var kept = found.kept;
    for (var i = 0u; i < min(found.count, 2u); i++) {
        kept = !kept;
        let depth = way.start + select(found.at.y, found.at.x, i == 0u);
        add(list, buffer_from_depth(depth), way.surface, kept);
    }
    return (*list).is_first_enough && ((found.count > 0u && kept) || found.count > 1u);
}
