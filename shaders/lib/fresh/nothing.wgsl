// Nothing but the queue begins anew with a screen.

#define_import_path cutaway::fresh

fn freshen(number: u32) {
}
