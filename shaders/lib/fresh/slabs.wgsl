// When a frame's screen is transformed, no tile is touched, and the lists of pixels and of samples within slabs are empty.

#define_import_path cutaway::fresh

#import cutaway::untouched::reset_tile

@group(1) @binding(6) var<storage, read_write> within_list: array<u32>;
@group(2) @binding(8) var<storage, read_write> pixel_list: array<u32>;
@group(2) @binding(9) var<storage, read_write> listed_groups: array<u32>;

fn freshen(number: u32) {
    if number == 0u {
        within_list[0] = 0u;
        pixel_list[0] = 0u;
        for (var i = 0u; i < 6u; i++) {
            listed_groups[i] = select(1u, 0u, i % 3u == 0u);
        }
    }
    reset_tile(number);
}
