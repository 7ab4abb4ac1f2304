// Prepares pixels for the fragments of an inside test (the open module `store`).

#define_import_path cutaway::begun

#import cutaway::store::begin

fn make_ready(pixel: u32) {
    begin(pixel);
}
