// A fragment's contribution to the inside test while lists are counted: one more in its pixel's list.

#define_import_path cutaway::store

#import cutaway::fragment_lists::{count, forget}
#import cutaway::lanes::Fragment

fn store(fragment: Fragment) {
    count(fragment.pixel);
}

fn begin(pixel: u32) {
    forget(pixel);
}
