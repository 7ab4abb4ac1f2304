// What a fragment leaves for an inside test that asks elsewhere: nothing. The pixel's mask begins empty all the same.

#define_import_path cutaway::store

#import cutaway::lanes::Fragment
#import cutaway::mask::clear

fn store(fragment: Fragment) {
}

fn begin(pixel: u32) {
    clear(pixel);
}
