// The sweep itself finds the touched tiles, and the depth range of the cut parts in each.

#define_import_path cutaway::touch

#import cutaway::touched::tile_at
#import cutaway::touching::{box_of, reach_of, touch_tile, widen}

// Pixels from `first` to `last` may be covered by a triangle whose corners have depth-buffer values `z`. The box has at most 65 pixels a
// side.
fn touch(first: vec2<i32>, last: vec2<i32>, z: vec3<f32>, is_cut: bool) {
    let box = box_of(first, last);
    let reach = reach_of(z);
    for (var y = 0u; y < box.size.y; y++) {
        for (var x = 0u; x < box.size.x; x++) {
            let tile = tile_at(box.first + vec2<u32>(x, y));
            touch_tile(tile);
            if is_cut {
                widen(tile, reach.x, reach.y);
            }
        }
    }
}
