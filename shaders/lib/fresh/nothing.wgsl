// When a screen is transformed, only the queue is reset.

#define_import_path cutaway::fresh

fn freshen(number: u32) {
}
