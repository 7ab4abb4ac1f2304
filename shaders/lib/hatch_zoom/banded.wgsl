// Line spacing is the scene's times a power of two, chosen so that lines keep about their initial spacing in the picture. Between two such
// powers every second line fades, so that lines do not move when the camera approaches. Dashes keep their length.

#define_import_path cutaway::hatch_zoom

#import cutaway::pulses::pulse_cover
#import cutaway::style::style

// Line spacing relative to the family's, where a pixel covers `scale` times as much of the scene as initially.
fn spacing_at(scale: f32) -> f32 {
    return exp2(floor(log2(max(scale, 1e-6))));
}

// Fraction of a pixel covered by lines of a width at multiples of the spacing, if the sides of a pixel advance by `steps` across them.
fn lines_cover(across: f32, steps: vec2<f32>, width: f32, scale: f32) -> f32 {
    let apart = 2.0 * spacing_at(scale);
    // From 0, where every line is drawn, to 1, where only every second one is.
    let between = 2.0 * scale / apart - 1.0;
    let footprint = steps / apart / style.fineness;
    let kept = pulse_cover(across / apart, min(width / apart, 0.5), footprint);
    let thinning = pulse_cover(across / apart + 0.5, min(width / apart, 0.5) * (1.0 - between), footprint);
    return min(kept + thinning, 1.0);
}
