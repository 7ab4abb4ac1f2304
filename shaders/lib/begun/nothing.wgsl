// Another pass makes pixels ready for fragments, or nothing wants that.

#define_import_path cutaway::begun

fn make_ready(pixel: u32) {
}
