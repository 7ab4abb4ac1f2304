// What begins anew with a screen whose tiles are asked for: no triangle is in any.

#define_import_path cutaway::begun

#import cutaway::reach::reach_count

@group(1) @binding(4) var<storage, read_write> reach: array<vec2<u32>>;

// Called as `freshen`.
fn begin(number: u32) {
    if number < reach_count() {
        reach[number] = vec2<u32>(0u);
    }
}
