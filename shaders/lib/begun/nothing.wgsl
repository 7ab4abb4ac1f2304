// A pass before has made pixels ready for fragments, or nothing wants that.

#define_import_path cutaway::begun

fn begin(number: u32) {
}
