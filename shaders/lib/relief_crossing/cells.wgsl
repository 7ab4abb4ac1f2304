// Finds all crossings of a ray with a relief, cell by cell. Takes time in proportion to the number of cells in the height slab.

#define_import_path cutaway::relief_crossing

#import cutaway::asked::Interval
#import cutaway::crossing_list::{List, need}
#import cutaway::cuts::{MOST_CELLS, cut_table}
#import cutaway::relief::corners_of
#import cutaway::relief_ray::{Carried, add_found, begin_of, heading_of, no_step, walk_cell, way_through}

fn cross_relief(list: ptr<function, List>, surface: u32, at_px: vec2<f32>, interval: Interval) {
    let way = way_through(list, surface, at_px, interval);
    if !(way.end > 0.0) {
        return;
    }
    let heading = heading_of(way);
    let cell_limit = min(cut_table.surfaces[surface].cell_limit, MOST_CELLS);
    let begin = begin_of(way);
    var cell = begin.cell;
    var carried = Carried(begin.entry, true, false);
    var corners = corners_of(way.map, cell);
    var walked = 0u;
    // A round ends in a cell with crossings, or in the last cell.
    for (var round = 0u; round <= cell_limit && walked < cell_limit; round++) {
        var met = no_step();
        for (; walked < cell_limit && met.found.count == 0u && !met.is_last; walked++) {
            met = walk_cell(list, way, heading, &carried, &cell, &corners);
        }
        if add_found(list, way, met.found) || met.is_last {
            return;
        }
    }
    // Cells beyond the limit are not visited: mark the list.
    (*list).cut_short = true;
    atomicMax(&need[1], cell_limit + 1u);
}
