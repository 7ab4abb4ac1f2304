// All crossings of a ray with a relief, cell by cell: in time to the cells between the entry into the slab of heights and the exit.

#define_import_path cutaway::relief_crossing

#import cutaway::asked::Interval
#import cutaway::crossing_list::{List, need}
#import cutaway::cuts::cut_table
#import cutaway::relief::{corners_beside, corners_of}
#import cutaway::relief_ray::{Carried, Found, add_found, begin_of, cross_cell, depth_at_border, way_through}

fn cross_relief(list: ptr<function, List>, surface: u32, at_px: vec2<f32>, interval: Interval) {
    let way = way_through(list, surface, at_px, interval);
    if !(way.end > 0.0) {
        return;
    }
    let x = way.texel_x;
    let y = way.texel_y;
    let up = vec2<bool>(x.y > 0.0, y.y > 0.0);
    let step = select(vec2<i32>(-1), vec2<i32>(1), up);
    // The border ahead of cell i is i + 1 when walking up, i when walking down.
    let ahead = select(vec2<i32>(0), vec2<i32>(1), up);
    let cell_limit = cut_table.surfaces[surface].cell_limit;
    let begin = begin_of(way);
    var cell = begin.cell;
    var carried = Carried(begin.entry, true, false);
    var corners = corners_of(way.map, cell);
    var walked = 0u;
    // A round ends in a cell that holds something, or in the last.
    for (var round = 0u; round <= cell_limit && walked < cell_limit; round++) {
        var found = Found(0u, vec2<f32>(0.0), false);
        var is_last = false;
        for (; walked < cell_limit && found.count == 0u && !is_last; walked++) {
            let border_x = depth_at_border(cell.x + ahead.x, x);
            let border_y = depth_at_border(cell.y + ahead.y, y);
            let exit = max(carried.entry, min(way.end, min(border_x, border_y)));
            found = cross_cell(list, way, &carried, cell, corners, exit);
            is_last = exit >= way.last;
            // Ties step in x first; the cell between has no length.
            let by_x = border_x <= border_y;
            cell += select(vec2<i32>(0, step.y), vec2<i32>(step.x, 0), by_x);
            corners = corners_beside(way.map, corners, cell, by_x, select(up.y, up.x, by_x));
        }
        add_found(list, way, found);
        if is_last {
            return;
        }
    }
    // Cells beyond the limit are not walked: say so.
    (*list).cut_short = true;
    atomicMax(&need[1], cell_limit + 1u);
}
