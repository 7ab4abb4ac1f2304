// What begins anew with a screen: nothing, where sweeps only count or store.

#define_import_path cutaway::fresh

fn freshen(number: u32) {
}
