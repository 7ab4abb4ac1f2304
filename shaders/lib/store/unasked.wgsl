// No part is cut: fragments leave nothing for an inside test, and nothing begins empty for one.

#define_import_path cutaway::store

#import cutaway::lanes::Fragment

fn store(fragment: Fragment) {
}

fn begin(pixel: u32) {
}
