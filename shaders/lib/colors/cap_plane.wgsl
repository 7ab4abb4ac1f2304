// Planes of caps: a pattern on a cap uses coordinates in the plane of the clip-surface.

#define_import_path cutaway::cap_plane

#import cutaway::frame::{centre_of, frame, ray_through}

struct CapPlane {
    u_row: vec4<f32>,
    v_row: vec4<f32>,
    // Normal of the plane; the last component is 1 for a cutter, whose faces lie in several planes.
    normal: vec4<f32>,
}

// A pixel's position on the plane of its cap, in scene units, and the steps to the next pixels.
struct Footing {
    uv: vec2<f32>,
    right: vec2<f32>,
    down: vec2<f32>,
}

// The plane of near-plane caps.
fn plane_of_view() -> CapPlane {
    let right = vec4<f32>(normalize(frame.ray_step[0].xyz), 0.0);
    let up = vec4<f32>(-normalize(frame.ray_step[1].xyz), 0.0);
    return CapPlane(right, up, vec4<f32>(frame.forward.xyz, 0.0));
}

// The axis nearest to a direction: 0, 1 or 2.
fn nearest_axis(direction: vec3<f32>) -> u32 {
    let size = abs(direction);
    if size.x >= size.y && size.x >= size.z {
        return 0u;
    }
    return select(2u, 1u, size.y >= size.z);
}

// The plane itself or, for a cutter, the axis-aligned plane whose normal is nearest to the face normal.
fn faced(plane: CapPlane, normal: vec3<f32>) -> CapPlane {
    if plane.normal.w < 0.5 {
        return plane;
    }
    let axis = nearest_axis(normal);
    let back = vec4<f32>(0.0, 0.0, -1.0, 0.0);
    let u_row = select(vec4<f32>(1.0, 0.0, 0.0, 0.0), back, axis == 0u);
    let v_row = select(vec4<f32>(0.0, 1.0, 0.0, 0.0), back, axis == 1u);
    return CapPlane(u_row, v_row, vec4<f32>(normal, 0.0));
}

// Displacement of the visible point on a plane with this normal when the pixel moves by `step` at the point's depth.
fn moved_along(normal: vec3<f32>, direction: vec3<f32>, step: vec3<f32>) -> vec3<f32> {
    let towards = dot(direction, normal);
    // At grazing angles a footprint would be infinite.
    let least = 0.05 * length(direction);
    let bounded = select(min(towards, -least), max(towards, least), towards > 0.0);
    return step - direction * (dot(step, normal) / bounded);
}

fn footing_on(plane: CapPlane, at: vec2<u32>, depth: f32) -> Footing {
    let ray = ray_through(centre_of(at));
    let point = vec4<f32>(ray.origin + depth * ray.direction, 1.0);
    let reach = select(depth, 1.0, frame.orthographic != 0u);
    let right = moved_along(plane.normal.xyz, ray.direction, reach * frame.ray_step[0].xyz);
    let down = moved_along(plane.normal.xyz, ray.direction, reach * frame.ray_step[1].xyz);
    return Footing(
        vec2<f32>(dot(plane.u_row, point), dot(plane.v_row, point)),
        vec2<f32>(dot(plane.u_row.xyz, right), dot(plane.v_row.xyz, right)),
        vec2<f32>(dot(plane.u_row.xyz, down), dot(plane.v_row.xyz, down)),
    );
}
