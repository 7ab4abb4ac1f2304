// No lines.

#define_import_path cutaway::phantom

fn phantom_cover(at: vec2<i32>) -> f32 {
    return 0.0;
}
