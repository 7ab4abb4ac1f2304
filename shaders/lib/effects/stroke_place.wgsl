// Position of a stroke on its border, in 12 bits: each of the two ends has an offset across the border, or lies in the middle of
// the border. Bits 8-19 of a pixel's word are for the border to its right, bits 20-31 for that below it.

#define_import_path cutaway::stroke_place

struct Place {
    // Offsets of the first and the last end, in pixels, at most half a pixel.
    off: vec2<f32>,
    // For each end, true if it lies in the middle of the border.
    is_shortened: vec2<bool>,
}

const SHORTENED: i32 = -32;
const STEPS: f32 = 62.0;

fn end_bits(off: f32, is_shortened: bool) -> u32 {
    return u32(select(i32(round(off * STEPS)), SHORTENED, is_shortened)) & 63u;
}

fn placed(place: Place) -> u32 {
    return end_bits(place.off.x, place.is_shortened.x) | (end_bits(place.off.y, place.is_shortened.y) << 6u);
}

// One end from its bits: its offset across, and its position along the border relative to the middle, in direction `sign`.
fn end_at(bits: u32, sign: f32) -> vec2<f32> {
    let steps = i32(bits << 26u) >> 26u;
    if steps == SHORTENED {
        return vec2<f32>(0.0);
    }
    return vec2<f32>(f32(steps) / STEPS, 0.5 * sign);
}

// The two ends of the stroke on the border to the right of a pixel, or below it: each as its offsets across and along the border.
fn ends_of(word: u32, is_right: bool) -> array<vec2<f32>, 2> {
    let bits = select(word >> 20u, word >> 8u, is_right);
    return array(end_at(bits & 63u, -1.0), end_at((bits >> 6u) & 63u, 1.0));
}
