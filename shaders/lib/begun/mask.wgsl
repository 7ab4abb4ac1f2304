// What begins anew with a screen where no pass before it has made pixels ready for fragments: their words of the inside mask.

#define_import_path cutaway::begun

#import cutaway::frame::pixel_count
#import cutaway::mask::clear

// Called as `freshen`.
fn begin(number: u32) {
    if number < pixel_count() {
        clear(number);
    }
}
