// Fragments contribute nothing: the inside test uses other data. The pixel's mask still starts empty.

#define_import_path cutaway::store

#import cutaway::lanes::Fragment
#import cutaway::mask::clear

fn store(fragment: Fragment) {
}

fn begin(pixel: u32) {
    clear(pixel);
}
