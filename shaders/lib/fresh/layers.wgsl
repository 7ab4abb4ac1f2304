// What begins anew with the screen of a frame whose picture is made of its layers: nothing is nearest yet in any pixel, and none is to
// be painted. Bound as @group(1) @binding(5) and (6).

#define_import_path cutaway::fresh

#import cutaway::frame::pixel_count

@group(1) @binding(5) var<storage, read_write> nearest: array<vec2<u32>>;
@group(1) @binding(6) var<storage, read_write> painted: array<u32>;

// Called with each number from 0 to that of the last pixel, and possibly beyond.
fn freshen(number: u32) {
    if number == 0u {
        painted[0] = 0u;
    }
    if number < pixel_count() {
        nearest[number] = vec2<u32>(0u);
    }
}
