// Pixels are made ready for the fragments that an inside test wants (the open module `store`).

#define_import_path cutaway::begun

#import cutaway::store::begin

fn make_ready(pixel: u32) {
    begin(pixel);
}
