// A style without strokes: there are none to take away.

#define_import_path cutaway::blank_strokes

fn blank_strokes(at: vec2<u32>) {
}
