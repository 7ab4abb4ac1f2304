// Of what a frame leaves the layers alone are kept as background; later passes make all of the picture of them.

#define_import_path cutaway::blank

// A number for that, not 0.
fn kind_of_blank() -> u32 {
    return 1u;
}

fn blank_picture(at: vec2<u32>) {
}
