// Resets the tiles that the previous frame touched to background, with no nearest sample; resets the whole picture if there was no previous
// frame or it had a different background. Workgroups share the tiles, an invocation owns a pixel of each.

#import cutaway::begun::make_ready
#import cutaway::blank::{blank_picture, kind_of_blank}
#import cutaway::frame::{frame, pixel_index}
#import cutaway::layers::{BACKGROUND, WORDS_PER_PIXEL}
#import cutaway::touched::{blank_of_frame, pixel_in, tile_count, turns_among}
#import cutaway::touched_list::{touched, touched_at, touched_count}

@group(1) @binding(3) var<storage, read_write> layers: array<u32>;
@group(1) @binding(5) var<storage, read_write> nearest: array<vec2<u32>>;

// True if all pixels outside the listed tiles already are background.
fn is_kept() -> bool {
    let now = blank_of_frame(kind_of_blank());
    let before = touched.blank;
    return all(now.size_px == before.size_px) && all(now.band == before.band) && now.depth == before.depth && now.kind == before.kind;
}

@compute @workgroup_size(16, 16)
fn main(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_id) local: vec3<u32>,
) {
    let is_known = is_kept();
    let end = turns_among(select(tile_count(), touched_count(), is_known), group.x, groups.x);
    let depth = blank_of_frame(kind_of_blank()).depth;
    for (var turn = 0u; turn < end; turn++) {
        let place = group.x + turn * groups.x;
        let tile = select(place, touched_at(place), is_known);
        let at = pixel_in(tile, local.xy);
        if all(at < frame.size_px) {
            let pixel = pixel_index(at);
            make_ready(pixel);
            nearest[pixel] = vec2<u32>(0u);
            let first = pixel * WORDS_PER_PIXEL;
            layers[first] = BACKGROUND;
            layers[first + 1u] = 0u;
            layers[first + 2u] = depth;
            blank_picture(at);
        }
    }
}
