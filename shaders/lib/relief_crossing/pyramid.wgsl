// Finds all crossings of a ray with a relief by its pyramid: nodes that lie wholly above or below the ray are skipped in one step.
//
// The list equals that of the cell walk, bit for bit. Three properties ensure this. A node is skipped only if every cell in it would be on
// the ray's current side, with a margin for the rounding of such a cell; so only a cell ever sets a sign, and where the side is known
// without the map, it is the same. Cells are entered where the walk enters them: at the depth of the last border that was met, which
// depends only on the number of that border. And the cell after a node is found by the walk's own comparisons: along the other axis, the
// borders met are those that come before the node's exit border; a guess from the depth there is corrected by comparing them.
//
// From one node the ray proceeds to the next at the same level, or one level up if the border is also one of the parent, so no node is
// visited twice. A node near the ray is subdivided, and the cells of the smallest nodes are walked. Invocations search for such a node
// together, then walk its cells together, which keeps them in step.

#define_import_path cutaway::relief_crossing

#import cutaway::asked::Interval
#import cutaway::crossing_list::{List, need}
#import cutaway::cuts::{MOST_CELLS, cut_table}
#import cutaway::pyramid::{LOWEST, along, levels_of, range_of}
#import cutaway::relief::corners_of
#import cutaway::relief_ray::{Carried, Way, add_found, begin_of, begin_way, depth_at_border, heading_of, no_step, walk_cell, way_through}

// Level at which a ray begins; it rises while nodes are skipped.
const FIRST_LEVEL: u32 = 3u;
// Most cells along a ray in a smallest block, including those that a mirrored map adds at its border.
const CELLS_OF_BLOCK: u32 = 9u;
// Greatest error, in cells, of the cell that f32 finds for a depth within 2^22 texels.
const MISS: u32 = 3u;

// True if the ray meets a cell's entry border before a depth, or at the depth if ties belong to this axis.
fn is_met(border: i32, texel: vec2<f32>, depth: f32, ties: bool) -> bool {
    let at = depth_at_border(border, texel);
    return at < depth || (ties && at <= depth);
}

// The last cell along one axis that the ray enters before a depth, given that it was in cell `now` earlier and does not go beyond cell
// `last`.
fn cell_at(depth: f32, ties: bool, now: i32, last: i32, up: bool, texel: vec2<f32>) -> i32 {
    let step = select(-1, 1, up);
    // Cell i is entered by border i when walking up, by i + 1 when walking down.
    let by = select(1, 0, up);
    var cell = clamp(i32(floor(texel.x + depth * texel.y)), min(now, last), max(now, last));
    for (var i = 0u; i < MISS; i++) {
        if cell == last || !is_met(cell + step + by, texel, depth, ties) {
            break;
        }
        cell += step;
    }
    for (var i = 0u; i < MISS; i++) {
        if cell == now || is_met(cell + by, texel, depth, ties) {
            break;
        }
        cell -= step;
    }
    return cell;
}

// Error bound of the walk over a node's cells, beyond which heights decide: one term for the ray, and a fraction of the node's range for
// the position in a cell.
fn rounding_of(way: Way) -> vec2<f32> {
    let slab = cut_table.surfaces[way.surface].slab;
    let height = abs(way.over_plane.x) + way.end * abs(way.over_plane.y) + max(abs(slab.x), abs(slab.y));
    let texels = abs(way.texel_x.x) + way.end * abs(way.texel_x.y) + abs(way.texel_y.x) + way.end * abs(way.texel_y.y);
    return vec2<f32>(height, texels + 8.0) * 1e-6;
}

fn cross_relief(list: ptr<function, List>, surface: u32, at_px: vec2<f32>, interval: Interval) {
    let way = way_through(list, surface, at_px, interval);
    if !(way.end > 0.0) {
        return;
    }
    let x = way.texel_x;
    let y = way.texel_y;
    let heading = heading_of(way);
    let up = heading.up;
    let ahead = heading.ahead;
    let rounding = rounding_of(way);
    let levels = levels_of(surface);
    let cell_limit = min(cut_table.surfaces[surface].cell_limit, MOST_CELLS);
    let begin = begin_of(way);
    var cell = begin.cell;
    var carried = Carried(begin.entry, true, false);
    var level = min(FIRST_LEVEL, levels);
    var border = vec2<i32>(0);
    var closes = vec2<bool>(false);
    // Upper bound on the cells left in the block being walked.
    var cells = 0u;
    // A round ends with one of the smallest blocks, or in one of its cells with crossings.
    for (var n = 0u; n < 2u * cell_limit; n++) {
        // Visits blocks, until one of the smallest is near the ray.
        for (var m = 0u; m < cell_limit + 64u && cells == 0u; m++) {
            let along_x = along(cell.x, level, way.map.size.x, way.map.wrap, up.x);
            let along_y = along(cell.y, level, way.map.size.y, way.map.wrap, up.y);
            border = vec2<i32>(along_x.border, along_y.border);
            closes = vec2<bool>(along_x.closes && level < levels, along_y.closes && level < levels);
            let border_x = depth_at_border(border.x, x);
            let border_y = depth_at_border(border.y, y);
            let exit = max(carried.entry, min(way.end, min(border_x, border_y)));
            let range = range_of(surface, way.map, level, vec2<u32>(along_x.node, along_y.node)) * way.relief_scale;
            let least = min(range.x, range.y);
            let greatest = max(range.x, range.y);
            let here = vec2<f32>(carried.entry, exit) * way.over_plane.y + way.over_plane.x;
            let room = rounding.x + rounding.y * (greatest - least);
            let kept = min(here.x, here.y) + least > room;
            let removed = max(here.x, here.y) + greatest < -room;
            let side_before = select(select(kept, way.over_plane.y < 0.0, way.from_slab), carried.kept, carried.begun);
            let side_after = select(kept, way.rises, way.to_slab && exit >= way.end);
            if !(kept || removed) || side_before != kept || side_after != kept {
                if level > LOWEST {
                    level--;
                    continue;
                }
                cells = CELLS_OF_BLOCK;
                continue;
            }
            if !carried.begun {
                begin_way(list, way, &carried, kept);
            }
            carried.entry = exit;
            if exit >= way.last {
                return;
            }
            // In a tie x comes first, as in the walk. The last cell before border i is i - 1 when walking up, i when walking down.
            if border_x <= border_y {
                cell = vec2<i32>(border.x - 1 + ahead.x, cell_at(border_x, false, cell.y, border.y - ahead.y, up.y, y));
                level += select(0u, 1u, closes.x);
            } else {
                cell = vec2<i32>(cell_at(border_y, true, cell.x, border.x - ahead.x, up.x, x), border.y - 1 + ahead.y);
                level += select(0u, 1u, closes.y);
            }
        }
        if cells == 0u {
            break;
        }
        // Walks the cells of the block that was found.
        var corners = corners_of(way.map, cell);
        var met = no_step();
        for (var i = 0u; i < CELLS_OF_BLOCK && cells > 0u && met.found.count == 0u && !met.is_last; i++) {
            let ahead_of_cell = cell + ahead;
            met = walk_cell(list, way, heading, &carried, &cell, &corners);
            let leaves = select(ahead_of_cell.y == border.y, ahead_of_cell.x == border.x, met.by_x);
            level += select(0u, 1u, leaves && select(closes.y, closes.x, met.by_x));
            cells = select(cells - 1u, 0u, leaves);
        }
        if add_found(list, way, met.found) || met.is_last {
            return;
        }
    }
    // Cells beyond the limit are skipped: mark the list.
    (*list).cut_short = true;
    atomicMax(&need[1], cell_limit + 1u);
}
