// Trains of pulses, integrated.

#define_import_path cutaway::pulses

// The integral of pulses that begin at whole numbers and are `width` long.
fn pulses_until(t: f32, width: f32) -> f32 {
    let whole = floor(t);
    return whole * width + min(t - whole, width);
}

// The mean over `footprint` around `at` of pulses of a width, 0 to 1, that are centred on whole numbers: what a pixel that covers that much
// of the period has of them.
fn pulse_cover(at: f32, width: f32, footprint: f32) -> f32 {
    // Near 0 the difference of two integrals keeps its bits.
    let near = at - round(at) + 0.5 * width;
    let half = 0.5 * max(footprint, 1e-5);
    return clamp((pulses_until(near + half, width) - pulses_until(near - half, width)) / (2.0 * half), 0.0, 1.0);
}
