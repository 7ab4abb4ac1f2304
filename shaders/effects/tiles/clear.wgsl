// Clears the whole picture to background without strokes if the previous frame had a different background; otherwise does nothing.
// Workgroups share the tiles.

#import cutaway::backdrop::backdrop
#import cutaway::blank_strokes::blank_strokes
#import cutaway::color::srgb_from_linear
#import cutaway::effect_tile_list::effect_tiles
#import cutaway::frame::{frame, pixel_index}
#import cutaway::picture::picture
#import cutaway::touched::{pixel_in, tile_count, turns_among}

// True if all pixels outside the tiles already have this frame's background.
fn is_kept() -> bool {
    let before = effect_tiles.before;
    let now = effect_tiles.now;
    let is_same_place = all(before.size_px == now.size_px) && all(before.band == now.band);
    return is_same_place && all(before.top == now.top) && all(before.bottom == now.bottom);
}

@compute @workgroup_size(16, 16)
fn main(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_id) local: vec3<u32>,
) {
    let end = turns_among(select(tile_count(), 0u, is_kept()), group.x, groups.x);
    for (var turn = 0u; turn < end; turn++) {
        let at = pixel_in(group.x + turn * groups.x, local.xy);
        if all(at < frame.size_px) {
            let color = backdrop(at.y);
            picture[pixel_index(at)] = pack4x8unorm(vec4<f32>(srgb_from_linear(color.rgb), color.a));
            blank_strokes(at);
        }
    }
}
