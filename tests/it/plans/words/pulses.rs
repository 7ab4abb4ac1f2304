//! Hatch lines are what a pixel has of them, however fine they are.

use super::*;

const SHADER: &str = "#import cutaway::pulses::pulse_cover
@group(0) @binding(0) var<storage, read> asked: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read_write> words: array<u32>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x < arrayLength(&asked) {
        let a = asked[id.x];
        words[id.x] = bitcast<u32>(pulse_cover(a.x, a.y, a.zw));
    }
}
";

/// The share of a pixel that pulses of a width cover, whose sides go by so much across them, by many samples.
fn sampled(at: f64, width: f64, steps: [f64; 2]) -> f64 {
    let count = 128;
    let off = |i: i32| (f64::from(i) + 0.5) / f64::from(count) - 0.5;
    let places = (0..count).flat_map(|i| (0..count).map(move |j| (i, j)));
    let inside = places.filter(|(i, j)| {
        let x = at + steps[0] * off(*i) + steps[1] * off(*j);
        (x - x.round()).abs() < width / 2.0
    });
    inside.count() as f64 / f64::from(count * count)
}

#[test]
fn a_pixel_has_what_samples_have_of_a_line() {
    let mut asked: Vec<[f32; 4]> = Vec::new();
    // Periods from 40 px to a fifth of one, with lines of 1.5 px, or half the period where that is less.
    for period_px in [40.0, 11.0, 5.2, 3.0, 1.7, 1.0, 0.61, 0.2_f64] {
        for i in 0..200 {
            let at = f64::from(i) * 0.137 - 9.0 + 1e-3;
            let width = (1.5 / period_px).min(0.5);
            // Lines in all directions, along the sides of pixels and across their corners among them.
            let angle = f64::from(i % 9) * std::f64::consts::FRAC_PI_4 / 2.0;
            let steps = [angle.cos() / period_px, -angle.sin() / period_px];
            asked.push([at as f32, width as f32, steps[0] as f32, steps[1] as f32]);
        }
    }
    let inputs = [(
        "asked",
        asked.iter().flatten().map(|v| v.to_bits()).collect(),
    )];
    let found = answers(SHADER, &inputs, asked.len(), 1);
    let [mut squares, mut thresholded] = [0.0, 0.0];
    for (word, asked) in found.iter().zip(&asked) {
        let [at, width, x, y] = asked.map(f64::from);
        let truth = sampled(at, width, [x, y]);
        squares += (f64::from(f32::from_bits(word[0])) - truth).powi(2);
        let line = f64::from(u8::from((at - at.round()).abs() < width / 2.0));
        thresholded += (line - truth).powi(2);
    }
    let rms = |squares: f64| (squares / asked.len() as f64).sqrt();
    assert!(rms(squares) < 0.002, "{}", rms(squares));
    assert!(
        rms(thresholded) > 0.09,
        "a threshold is noticed: {}",
        rms(thresholded)
    );
}
