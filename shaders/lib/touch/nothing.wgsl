// A pass before has found the tiles that are touched, or they are not needed.

#define_import_path cutaway::touch

fn touch(first: vec2<i32>, last: vec2<i32>) {
}
