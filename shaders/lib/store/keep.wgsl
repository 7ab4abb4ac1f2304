// A fragment's contribution to the inside test while lists are filled: its depth and its part.

#define_import_path cutaway::store

#import cutaway::fragment_lists::{forget, keep}
#import cutaway::lanes::Fragment

fn store(fragment: Fragment) {
    keep(fragment.pixel, fragment.z, fragment.place);
}

fn begin(pixel: u32) {
    forget(pixel);
}
