// Only the queue is reset together with a screen.

#define_import_path cutaway::fresh

fn freshen(number: u32) {
}
