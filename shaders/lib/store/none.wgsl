// Fragments leave nothing: the inside test draws the mesh again, or has its own passes over it.

#define_import_path cutaway::store

#import cutaway::lanes::Fragment

fn store(fragment: Fragment) {
}

fn begin(pixel: u32) {
}
