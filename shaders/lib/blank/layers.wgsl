// Outside the touched tiles only the layers are kept as background; later passes make the whole picture from the layers.

#define_import_path cutaway::blank

// A nonzero number that identifies this kind of background.
fn kind_of_blank() -> u32 {
    return 1u;
}

fn blank_picture(at: vec2<u32>) {
}
