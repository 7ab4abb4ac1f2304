// Lines are a power of two as far from each other as in the scene, the one at which they are in the picture about as far as they first were;
// between two such scales every second line thins out, so that a camera that comes nearer moves no line. Dashes stay as long as they are.

#define_import_path cutaway::hatch_zoom

#import cutaway::pulses::pulse_cover
#import cutaway::style::style

// The distance from line to line, over that of the family, where a pixel shows `scale` times as much of the scene as at first.
fn spacing_at(scale: f32) -> f32 {
    return exp2(floor(log2(max(scale, 1e-6))));
}

// How much of a pixel lines of a width cover that are at multiples of the spacing, where the sides of a pixel go by `steps` across them.
fn lines_cover(across: f32, steps: vec2<f32>, width: f32, scale: f32) -> f32 {
    let apart = 2.0 * spacing_at(scale);
    // From 0 where every line is drawn to 1 where every second is.
    let between = 2.0 * scale / apart - 1.0;
    let footprint = steps / apart / style.fineness;
    let kept = pulse_cover(across / apart, min(width / apart, 0.5), footprint);
    let thinning = pulse_cover(across / apart + 0.5, min(width / apart, 0.5) * (1.0 - between), footprint);
    return min(kept + thinning, 1.0);
}
