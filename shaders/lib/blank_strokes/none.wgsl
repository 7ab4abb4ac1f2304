// A style without strokes: there is nothing to clear.

#define_import_path cutaway::blank_strokes

fn blank_strokes(at: vec2<u32>) {
}
