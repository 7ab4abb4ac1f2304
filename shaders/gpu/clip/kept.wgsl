// Clip test for a host's shaders: is a point of a part kept? The host gets this text without the entry points. Names begin with `cutaway`
// to differ from those of a host in the same module.

#import cutaway::crossings::crossings_before
#import cutaway::cuts::is_removed
#import cutaway::frame::{buffer_from_depth, frame}

struct CutawayClip {
    // Scale from the host's world to scene space.
    scene_from_world: f32,
    // For each part of the scene, bits of the cuts that reach it, and 1 if a cut removes the whole part.
    parts: array<vec2<u32>>,
}

@group(0) @binding(3) var<storage, read> cutaway_clip: CutawayClip;

fn cutaway_depth(distance: f32) -> f32 {
    return buffer_from_depth(distance * cutaway_clip.scene_from_world);
}

fn cutaway_is_kept(pixel: vec2<u32>, depth: f32, part: u32) -> bool {
    if any(pixel >= frame.size_px) {
        return true;
    }
    let clip = cutaway_clip.parts[part];
    return clip.y == 0u && !is_removed(crossings_before(depth, pixel).sides, clip.x);
}

// Example use of the two functions, by a host whose vertices are in scene space. Hosts have entry points of their own.

struct CutawayCorner {
    @builtin(position) position: vec4<f32>,
    @location(0) distance: f32,
    @location(1) @interpolate(flat) part: u32,
}

@vertex
fn vertex(@location(0) at: vec3<f32>, @builtin(instance_index) part: u32) -> CutawayCorner {
    let position = frame.clip_from_scene * vec4<f32>(at, 1.0);
    return CutawayCorner(position, position.w / cutaway_clip.scene_from_world, part);
}

@fragment
fn fragment(corner: CutawayCorner) -> @location(0) vec4<f32> {
    if !cutaway_is_kept(vec2<u32>(corner.position.xy), cutaway_depth(corner.distance), corner.part) {
        discard;
    }
    return vec4<f32>(1.0);
}
