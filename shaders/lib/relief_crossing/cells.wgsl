// All crossings of a ray with a relief, cell by cell: in time to the cells between the entry into the slab of heights and the exit.

#define_import_path cutaway::relief_crossing

#import cutaway::asked::Interval
#import cutaway::crossing_list::{List, need}
#import cutaway::cuts::cut_table
#import cutaway::relief_ray::{Carried, begin_of, cross_cell, depth_at_border, way_through}

fn cross_relief(list: ptr<function, List>, surface: u32, at_px: vec2<f32>, interval: Interval) {
    let way = way_through(list, surface, at_px, interval);
    if !(way.end > 0.0) {
        return;
    }
    let x = way.texel_x;
    let y = way.texel_y;
    let step = vec2<i32>(select(-1, 1, x.y > 0.0), select(-1, 1, y.y > 0.0));
    // The border ahead of cell i is i + 1 when walking up, i when walking down.
    let ahead = vec2<i32>(select(0, 1, x.y > 0.0), select(0, 1, y.y > 0.0));
    let cell_limit = cut_table.surfaces[surface].cell_limit;
    let begin = begin_of(way);
    var cell = begin.cell;
    var carried = Carried(begin.entry, true, false);
    for (var n = 0u; n < cell_limit; n++) {
        let border_x = depth_at_border(cell.x + ahead.x, x);
        let border_y = depth_at_border(cell.y + ahead.y, y);
        let exit = max(carried.entry, min(way.end, min(border_x, border_y)));
        cross_cell(list, way, &carried, cell, exit);
        if exit >= way.last {
            return;
        }
        // Ties step in x first; the cell between has no length.
        if border_x <= border_y {
            cell.x += step.x;
        } else {
            cell.y += step.y;
        }
    }
    // Cells beyond the limit are not walked: say so.
    (*list).cut_short = true;
    atomicMax(&need[1], cell_limit + 1u);
}
