// The sweep itself finds the touched tiles, and the depth range of the cut parts in each.

#define_import_path cutaway::touch

#import cutaway::touching::touch_box_at_depths

// Pixels from `first` to `last` may be covered by a triangle whose corners have depth-buffer values `z`.
fn touch(first: vec2<i32>, last: vec2<i32>, z: vec3<f32>, is_cut: bool) {
    touch_box_at_depths(first, last, z, is_cut);
}
