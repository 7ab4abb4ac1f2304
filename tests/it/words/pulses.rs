//! Hatch lines are what a pixel has of them, however fine they are.

use super::*;

const SHADER: &str = "#import cutaway::pulses::pulse_cover
@group(0) @binding(0) var<storage, read> asked: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read_write> words: array<u32>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x < arrayLength(&asked) {
        let a = asked[id.x];
        words[id.x] = bitcast<u32>(pulse_cover(a.x, a.y, a.z));
    }
}
";

/// The share of a footprint that pulses of a width cover, by many samples.
fn sampled(at: f64, width: f64, footprint: f64) -> f64 {
    let count = 4096;
    let inside = (0..count).filter(|i| {
        let x = at + footprint * ((f64::from(*i) + 0.5) / f64::from(count) - 0.5);
        (x - x.round()).abs() < width / 2.0
    });
    inside.count() as f64 / f64::from(count)
}

#[test]
fn a_pixel_has_what_samples_have_of_a_line() {
    let mut asked: Vec<[f32; 4]> = Vec::new();
    // Periods from 40 px to a fifth of one, with lines of 1.5 px, or half the period where that is less.
    for period_px in [40.0, 11.0, 5.2, 3.0, 1.7, 1.0, 0.61, 0.2_f64] {
        for i in 0..200 {
            let at = f64::from(i) * 0.137 - 9.0 + 1e-3;
            let width = (1.5 / period_px).min(0.5);
            asked.push([at as f32, width as f32, (1.0 / period_px) as f32, 0.0]);
        }
    }
    let inputs = [(
        "asked",
        asked.iter().flatten().map(|v| v.to_bits()).collect(),
    )];
    let found = answers(SHADER, &inputs, asked.len(), 1);
    let [mut squares, mut thresholded] = [0.0, 0.0];
    for (word, [at, width, footprint, _]) in found.iter().zip(&asked) {
        let [at, width, footprint] = [at, width, footprint].map(|v| f64::from(*v));
        let truth = sampled(at, width, footprint);
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
