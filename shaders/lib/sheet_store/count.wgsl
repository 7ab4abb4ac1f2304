// What a fragment of a sheet leaves while lists are counted: one more in its pixel's list.

#define_import_path cutaway::sheet_store

#import cutaway::fragment_lists::count

fn leave(pixel: u32, z: f32, word: u32) {
    count(pixel);
}
