// Integrals of pulse trains over pixels.

#define_import_path cutaway::pulses

// The double integral of pulses that begin at whole numbers and are `width` long.
fn twice_integrated(t: f32, width: f32) -> f32 {
    let whole = floor(t);
    let part = t - whole;
    let rise = min(part, width);
    let of_part = rise * rise * 0.5 + width * (part - rise);
    return whole * (width * (0.5 * (whole - 1.0) + 1.0 - 0.5 * width + part)) + of_part;
}

// The integral of such pulses.
fn integrated(t: f32, width: f32) -> f32 {
    let whole = floor(t);
    return whole * width + min(t - whole, width);
}

// The fraction of a pixel that pulses cover. Pulses have a width of 0 to 1 and are centred on whole numbers; `steps` is the advance across
// pulses along the pixel's two sides. In this direction a pixel is the convolution of two boxes, so two integrals give the exact result.
fn pulse_cover(at: f32, width: f32, steps: vec2<f32>) -> f32 {
    let long = max(max(abs(steps.x), abs(steps.y)), 1e-5);
    let short = min(abs(steps.x), abs(steps.y));
    // If the pixel is many periods wide, the mean is used, because integrals would lose precision.
    if long > 32.0 {
        return width;
    }
    // Near 0 the difference of integrals keeps its precision.
    let near = at - round(at) + 0.5 * width;
    if short < 0.02 * long || long * short < 1e-5 {
        let half = 0.5 * long;
        return clamp((integrated(near + half, width) - integrated(near - half, width)) / long, 0.0, 1.0);
    }
    let outer = 0.5 * (long + short);
    let inner = 0.5 * (long - short);
    let ahead = twice_integrated(near + outer, width) - twice_integrated(near + inner, width);
    let behind = twice_integrated(near - inner, width) - twice_integrated(near - outer, width);
    return clamp((ahead - behind) / (long * short), 0.0, 1.0);
}
