// Hatches: parallel lines on caps, anchored to the clip-surface in units of the scene. Bound as @group(2) @binding(2) and (3).
//
// A line is a pulse of a period; what a pixel has of it is the integral of the pulses over the pixel's footprint across the lines, which is
// right at any distance from line to line: finer than a pixel it is their mean, and never noise.

#define_import_path cutaway::cap_pattern

#import cutaway::frame::{centre_of, frame, ray_through}
#import cutaway::layers::{NEAR_PLANE, OVERLAP, clip_surface_of}
#import cutaway::pulses::pulse_cover
#import cutaway::style::style

struct HatchPlane {
    u_row: vec4<f32>,
    v_row: vec4<f32>,
    normal: vec4<f32>,
}

struct PartHatch {
    across: vec2<f32>,
    width_px: f32,
    alpha: f32,
    is_solid: u32,
    padding: u32,
    padding_b: u32,
    padding_c: u32,
    color: vec4<f32>,
}

// By the number of a clip-surface.
@group(2) @binding(2) var<storage, read> hatch_planes: array<HatchPlane>;
// By the place of a part in the table.
@group(2) @binding(3) var<storage, read> part_hatches: array<PartHatch>;

// The plane of a cap: of a cutter the one of the axes that its normal is nearest to, of the near plane that of the view.
fn plane_of(number: u32, normal: vec3<f32>) -> HatchPlane {
    if number == NEAR_PLANE {
        let right = vec4<f32>(normalize(frame.ray_step[0].xyz), 0.0);
        let up = vec4<f32>(-normalize(frame.ray_step[1].xyz), 0.0);
        return HatchPlane(right, up, vec4<f32>(frame.forward.xyz, 0.0));
    }
    let plane = hatch_planes[number];
    if plane.normal.w < 0.5 {
        return plane;
    }
    let size = abs(normal);
    if size.x >= size.y && size.x >= size.z {
        return HatchPlane(vec4<f32>(0.0, 0.0, -1.0, 0.0), vec4<f32>(0.0, 1.0, 0.0, 0.0), vec4<f32>(normal, 0.0));
    }
    if size.y >= size.z {
        return HatchPlane(vec4<f32>(1.0, 0.0, 0.0, 0.0), vec4<f32>(0.0, 0.0, -1.0, 0.0), vec4<f32>(normal, 0.0));
    }
    return HatchPlane(vec4<f32>(1.0, 0.0, 0.0, 0.0), vec4<f32>(0.0, 1.0, 0.0, 0.0), vec4<f32>(normal, 0.0));
}

// How far a point of the plane moves when the pixel moves by `step` at its depth.
fn moved_on(plane: HatchPlane, direction: vec3<f32>, step: vec3<f32>) -> vec2<f32> {
    let towards = dot(direction, plane.normal.xyz);
    // At grazing angles a footprint would be infinite.
    let least = 0.05 * length(direction);
    let bounded = select(min(towards, -least), max(towards, least), towards > 0.0);
    let moved = step - direction * (dot(step, plane.normal.xyz) / bounded);
    return vec2<f32>(dot(plane.u_row.xyz, moved), dot(plane.v_row.xyz, moved));
}

fn patterned(color: vec3<f32>, at: vec2<u32>, word: u32, depth: f32, normal: vec3<f32>, place: u32) -> vec3<f32> {
    let hatch = part_hatches[place];
    let number = clip_surface_of(word);
    let is_bare = number != NEAR_PLANE && number >= arrayLength(&hatch_planes);
    if (word & OVERLAP) != 0u || hatch.alpha <= 0.0 || is_bare {
        return color;
    }
    if hatch.is_solid != 0u {
        return mix(color, hatch.color.rgb, hatch.alpha);
    }
    let plane = plane_of(number, normal);
    let ray = ray_through(centre_of(at));
    let point = vec4<f32>(ray.origin + depth * ray.direction, 1.0);
    let reach = select(depth, 1.0, frame.orthographic != 0u);
    let right = moved_on(plane, ray.direction, reach * frame.ray_step[0].xyz);
    let down = moved_on(plane, ray.direction, reach * frame.ray_step[1].xyz);
    let phase = dot(hatch.across, vec2<f32>(dot(plane.u_row, point), dot(plane.v_row, point)));
    let per_px = length(vec2<f32>(dot(hatch.across, right), dot(hatch.across, down)));
    let cover = pulse_cover(phase, min(hatch.width_px * per_px, 1.0), per_px / style.fineness);
    return mix(color, hatch.color.rgb, hatch.alpha * cover);
}
