// What a fragment of a sheet leaves while lists are filled: its depth and its word.

#define_import_path cutaway::sheet_store

#import cutaway::fragment_lists::keep

fn leave(pixel: u32, z: f32, word: u32) {
    keep(pixel, z, word);
}
