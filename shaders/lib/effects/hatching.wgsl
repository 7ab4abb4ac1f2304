// Hatches: families of parallel lines on caps, anchored to the clip-surface in scene units. Bound as @group(2) @binding(2), (3), (5).
//
// Lines are a train of pulses. The covered fraction of a pixel is the integral of the pulses over the pixel, which is correct at any line
// spacing: if the spacing is below a pixel, the result is the mean, without noise. Dashes are pulses along the lines.

#define_import_path cutaway::hatching

#import cutaway::cap_plane::{CapPlane, Footing, faced, footing_on, plane_of_view}
#import cutaway::hatch_zoom::{lines_cover, spacing_at}
#import cutaway::layers::{NEAR_PLANE, OVERLAP, clip_surface_of}
#import cutaway::pulses::pulse_cover
#import cutaway::style::style

struct HatchPlanes {
    planes: array<CapPlane, 256>,
    count: u32,
    unit_px: f32,
    padding_b: u32,
    padding_c: u32,
}

struct PartHatch {
    color: vec4<f32>,
    first_line: u32,
    line_count: u32,
    alpha: f32,
    width_px: f32,
    turned: vec4<f32>,
    start: vec4<f32>,
    end: vec4<f32>,
}

// Maximum number of dashes in the pattern of a line, and of line families in a hatch.
const MOST_DASHES: u32 = 4u;
const MOST_LINES: u32 = 64u;

struct HatchLine {
    across: vec2<f32>,
    along: vec2<f32>,
    phase: f32,
    dash_phase: f32,
    shift: f32,
    dash_count: u32,
    dash_centres: vec4<f32>,
    dash_lengths: vec4<f32>,
}

// Indexed by clip-surface number.
@group(2) @binding(2) var<uniform> hatch_planes: HatchPlanes;
// Indexed by part-table index.
@group(2) @binding(3) var<storage, read> part_hatches: array<PartHatch>;
@group(2) @binding(5) var<storage, read> hatch_lines: array<HatchLine>;

// The plane of a cap.
fn plane_of(number: u32, normal: vec3<f32>) -> CapPlane {
    if number == NEAR_PLANE {
        return plane_of_view();
    }
    return faced(hatch_planes.planes[number], normal);
}

// Undoes the motion of the part in a footing, because lines turn with the part about the plane's normal and move with its centre.
fn carried_back(plane: CapPlane, footing: Footing, hatch: PartHatch) -> Footing {
    if hatch.start.w < 0.5 {
        return footing;
    }
    // Cosine and sine of half the angle of the rotation component about the normal.
    let half = vec2<f32>(hatch.turned.w, dot(hatch.turned.xyz, cross(plane.u_row.xyz, plane.v_row.xyz)));
    let size = dot(half, half);
    let turn = select(vec2<f32>(1.0, 0.0), vec2<f32>(half.x * half.x - half.y * half.y, 2.0 * half.x * half.y) / size, size > 1e-6);
    let back = mat2x2<f32>(vec2<f32>(turn.x, -turn.y), vec2<f32>(turn.y, turn.x));
    let end = vec4<f32>(hatch.end.xyz, 1.0);
    let start = vec4<f32>(hatch.start.xyz, 1.0);
    let centre = vec2<f32>(dot(plane.u_row, end), dot(plane.v_row, end));
    let was_at = vec2<f32>(dot(plane.u_row, start), dot(plane.v_row, start));
    return Footing(was_at + back * (footing.uv - centre), back * footing.right, back * footing.down);
}

fn footing_of(at: vec2<u32>, number: u32, depth: f32, normal: vec3<f32>, hatch: PartHatch) -> Footing {
    let plane = plane_of(number, normal);
    return carried_back(plane, footing_on(plane, at, depth), hatch);
}

// Fraction of a pixel that the lines of a family cover.
fn line_cover(hatch_line: HatchLine, footing: Footing, width_px: f32) -> f32 {
    let across = dot(hatch_line.across, footing.uv) + hatch_line.phase;
    let steps = vec2<f32>(dot(hatch_line.across, footing.right), dot(hatch_line.across, footing.down));
    // 1, which gives the initial spacing, if a pixel covers as much of the scene as initially.
    let scale = length(steps) / max(length(hatch_line.across) * hatch_planes.unit_px, 1e-20);
    let cover = lines_cover(across, steps, width_px * length(steps), scale);
    if hatch_line.dash_count == 0u || cover <= 0.0 {
        return cover;
    }
    let spread = spacing_at(scale);
    let along = dot(hatch_line.along, footing.uv) + hatch_line.dash_phase - hatch_line.shift * spread * round(across / spread);
    let along_steps = vec2<f32>(dot(hatch_line.along, footing.right), dot(hatch_line.along, footing.down));
    // A dot is as long as the line is wide.
    let least = width_px * length(along_steps);
    var dashed = 0.0;
    for (var i = 0u; i < min(hatch_line.dash_count, MOST_DASHES); i++) {
        let drawn = min(max(hatch_line.dash_lengths[i], least), 1.0);
        dashed += pulse_cover(along - hatch_line.dash_centres[i], drawn, along_steps / style.fineness);
    }
    return cover * min(dashed, 1.0);
}

// True if a cap has a hatch; false if several solids share the cap, or if its clip-surface is unknown.
fn has_hatch(word: u32, place: u32) -> bool {
    let number = clip_surface_of(word);
    let is_known = number == NEAR_PLANE || number < hatch_planes.count;
    return part_hatches[place].alpha > 0.0 && (word & OVERLAP) == 0u && is_known;
}

// Fraction of a cap pixel that lines cover.
fn hatch_cover(hatch: PartHatch, footing: Footing) -> f32 {
    // A hatch without lines fills the cap.
    var bare = select(1.0, 0.0, hatch.line_count == 0u);
    for (var i = 0u; i < min(hatch.line_count, MOST_LINES); i++) {
        bare *= 1.0 - line_cover(hatch_lines[hatch.first_line + i], footing, hatch.width_px);
    }
    return 1.0 - bare;
}
