// Draws cutters only for their fragments: each stores its depth, its clip-surface and the shading normal in its pixel's list.
//
// The first vertex of a triangle is unshared: it carries the triangle's data. A fragment's normal is that of its visible side: a ray
// that leaves the removed region sees the face from inside that region, so a cap's normal faces the eye.
//
// A triangle that extends behind the eye is clipped, by any rasteriser, to corners up to a hundred thousand pixels away, and values that
// fixed functions interpolate between these have a visible error: there the depth is computed from the triangle's plane.

#import cutaway::crossing_words::normal_bits
#import cutaway::frame::{buffer_from_depth, centre_of, frame, pixel_index, ray_through}
#import cutaway::layers::unpack_normal
#import cutaway::mesh::{clip_position, drawn_position}
#import cutaway::sheet_lists::leave
#import cutaway::sheet_words::sheet_word

// A triangle of a cutter, without its first corner.
struct CutterFace {
    second: vec4<f32>,
    third: vec4<f32>,
    // Its plane; the last component is 1 if it is shaded by the normals of its corners.
    normal: vec4<f32>,
}

@group(0) @binding(1) var<storage, read> cutter_faces: array<CutterFace>;

// Greatest ratio of corner depths at which fixed-function interpolation is accurate enough.
const MOST_DEPTHS: f32 = 16.0;

struct Corner {
    @builtin(position) @invariant position: vec4<f32>,
    @location(0) normal: vec3<f32>,
    @location(1) @interpolate(flat, first) surface: u32,
    @location(2) @interpolate(flat, first) first: vec3<f32>,
    // For the triangle that begins here: its plane, whether it is shaded by the normals of its corners, and its depth range if its depth is
    // computed from the plane, or 0.
    @location(3) @interpolate(flat, first) plane: vec4<f32>,
    @location(4) @interpolate(flat, first) depths: vec2<f32>,
}

fn depths_of(first: vec3<f32>, face: CutterFace) -> vec2<f32> {
    if frame.orthographic != 0u {
        return vec2<f32>(0.0);
    }
    let depths = vec3<f32>(clip_position(first).w, clip_position(face.second.xyz).w, clip_position(face.third.xyz).w);
    let low = max(min(depths.x, min(depths.y, depths.z)), frame.near);
    let high = max(depths.x, max(depths.y, depths.z));
    return select(vec2<f32>(0.0), vec2<f32>(low, high), high > MOST_DEPTHS * low);
}

@vertex
fn vertex(@location(0) position: vec3<f32>, @location(1) normal: u32, @builtin(vertex_index) index: u32, @builtin(instance_index) surface: u32) -> Corner {
    let face = cutter_faces[index];
    return Corner(drawn_position(position), unpack_normal(normal), surface, position, face.normal, depths_of(position, face));
}

fn z_of(corner: Corner) -> f32 {
    let ray = ray_through(centre_of(vec2<u32>(corner.position.xy)));
    let along = dot(corner.plane.xyz, ray.direction);
    let depth = clamp(dot(corner.plane.xyz, corner.first - ray.origin) / along, corner.depths.x, corner.depths.y);
    let is_asked = corner.depths.y > 0.0 && abs(along) > 0.0;
    return select(corner.position.z, buffer_from_depth(depth), is_asked);
}

@fragment
fn fragment(corner: Corner, @builtin(front_facing) front: bool) {
    let shaded = select(corner.plane.xyz, corner.normal, corner.plane.w > 0.5);
    let normal = normalize(select(-shaded, shaded, front));
    leave(pixel_index(vec2<u32>(corner.position.xy)), z_of(corner), sheet_word(corner.surface, front) | normal_bits(normal));
}
