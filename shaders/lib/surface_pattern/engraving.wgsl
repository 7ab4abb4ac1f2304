// Tone as lines: a line is drawn where a surface meets a family of parallel planes of the scene, wider for darker tones (tone as a
// threshold: Freudenberg, Masuch and Strothotte 2002; here it is the width). Dark tones have a second family.
//
// The plane spacing is the power of two at which lines in the picture are about as far apart as the style sets; between two such scales
// every second line thins out, so that a receding camera moves no line.

#define_import_path cutaway::surface_pattern

#import cutaway::frame::{centre_of, frame, ray_through}
#import cutaway::pulses::pulse_cover
#import cutaway::style::style

// From the tone at which a family begins to the one at which it is densest.
const LIGHT_FAMILY: vec2<f32> = vec2<f32>(0.80, 0.15);
const DARK_FAMILY: vec2<f32> = vec2<f32>(0.42, 0.0);

// A surface at a smaller angle to its family's planes than this has no distinct lines, and gets their mean instead.
const LEAST_SLANT: f32 = 0.06;

// Fraction of a pixel that the lines of a family cover: `place` is the position across them in scene units, `steps` the advance of the
// pixel sides across them; the line spacing is in pixels.
fn family_cover(place: f32, steps: vec2<f32>, spacing_px: f32, darkness: f32) -> f32 {
    let per_px = length(steps);
    let scale = log2(max(spacing_px * per_px, 1e-12));
    let spacing = exp2(floor(scale));
    let between = fract(scale);
    // Half the spacing is ink at the darkest tone.
    let width = 0.25 * darkness * spacing_px * per_px / spacing;
    let at = 0.5 * place / spacing;
    let footprint = 0.5 * steps / spacing / style.fineness;
    let kept = pulse_cover(at, min(width, 1.0), footprint);
    let thinning = pulse_cover(at + 0.5, min(width * (1.0 - between), 1.0), footprint);
    return min(kept + thinning, 1.0);
}

fn engraved(color: vec3<f32>, base: vec3<f32>, at: vec2<u32>, depth: f32, normal: vec3<f32>) -> vec3<f32> {
    let ray = ray_through(centre_of(at));
    let point = ray.origin + depth * ray.direction;
    let reach = select(depth, 1.0, frame.orthographic != 0u);
    // At grazing angles a footprint would be infinite.
    let towards = min(dot(ray.direction, normal), -0.03 * length(ray.direction));
    let right = reach * (frame.ray_step[0].xyz - ray.direction * (dot(frame.ray_step[0].xyz, normal) / towards));
    let down = reach * (frame.ray_step[1].xyz - ray.direction * (dot(frame.ray_step[1].xyz, normal) / towards));
    let tone = dot(color, vec3<f32>(0.2126, 0.7152, 0.0722));
    var bare = 1.0;
    for (var i = 0u; i < 2u; i++) {
        let across = style.engraving[i];
        let range = select(LIGHT_FAMILY, DARK_FAMILY, i == 1u);
        let darkness = clamp((range.x - tone) / (range.x - range.y), 0.0, 1.0);
        let steps = vec2<f32>(dot(across.xyz, right), dot(across.xyz, down));
        let slant = length(steps) / max(length(right), length(down));
        // At 0 the line spacing is undefined.
        let bounded = select(steps, vec2<f32>(0.01 * length(right), 0.0), slant < 0.01);
        let lines = family_cover(dot(across.xyz, point), bounded, across.w, darkness);
        let mean = 0.375 * darkness;
        bare *= 1.0 - mix(mean, lines, smoothstep(0.5 * LEAST_SLANT, LEAST_SLANT, slant));
    }
    return mix(style.ink.rgb, base, bare);
}
