// Another pass prepares pixels for fragments, or no preparation is needed.

#define_import_path cutaway::begun

fn make_ready(pixel: u32) {
}
