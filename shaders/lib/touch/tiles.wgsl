// The sweep itself finds the touched tiles.

#define_import_path cutaway::touch

#import cutaway::touching::touch_box

// Pixels from `first` to `last` may be covered.
fn touch(first: vec2<i32>, last: vec2<i32>) {
    touch_box(first, last);
}
