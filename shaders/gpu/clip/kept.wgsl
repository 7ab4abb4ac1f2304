// Clip test for a host's shaders: tests whether the cuts keep a point of a part. The host gets this text without the entry points. Names
// begin with `cutaway`, so that they differ from the host's names in the same module.

#import cutaway::crossings::crossings_before
#import cutaway::cuts::is_removed
#import cutaway::frame::{buffer_from_depth, frame}

struct CutawayClip {
    // Scale factor from the host's world space to scene space.
    scene_from_world: f32,
    // For each part of the scene: one bit per cut that reaches it, and 1 if a cut removes the whole part.
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

// Example of entry points of a host that uses the two functions and whose vertices are in scene space.

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
