// What begins anew with a screen: nothing is nearest yet in any pixel. Bound as @group(1) @binding(5).

#define_import_path cutaway::fresh

#import cutaway::frame::pixel_count

// Two planes, one word per pixel each.
@group(1) @binding(5) var<storage, read_write> nearest: array<u32>;

// Called with each number from 0 to that of the last pixel, and possibly beyond.
fn freshen(number: u32) {
    if number < pixel_count() {
        nearest[number] = 0u;
        nearest[pixel_count() + number] = 0u;
    }
}
