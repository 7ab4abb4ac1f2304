// What the shaders of a host ask: whether a point of a part is kept. Given to them as text, and therefore without an entry point.

#import cutaway::crossings::passed_at
#import cutaway::cuts::is_removed
#import cutaway::frame::{buffer_from_depth, frame, pixel_index}

struct Clip {
    // By how much scene space is larger than the host's world.
    scene_from_world: f32,
    // Bits of the cuts that apply to each part of the scene; all of them where it is removed altogether.
    cuts_of_part: array<u32>,
}

@group(0) @binding(3) var<storage, read> clip: Clip;

fn cutaway_depth(distance: f32) -> f32 {
    return buffer_from_depth(distance * clip.scene_from_world);
}

fn cutaway_is_kept(pixel: vec2<u32>, depth: f32, part: u32) -> bool {
    if any(pixel >= frame.size_px) {
        return true;
    }
    return !is_removed(passed_at(depth, pixel_index(pixel)).sides, clip.cuts_of_part[part]);
}
