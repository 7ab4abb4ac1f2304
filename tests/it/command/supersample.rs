//! Promise: a picture of N x N samples a pixel is the mean, in linear light, of the picture that is N times as large.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common::command::Scratch;

/// Light of a byte in sRGB.
fn linear(byte: u8) -> f64 {
    let v = f64::from(byte) / 255.0;
    match v <= 0.04045 {
        true => v / 12.92,
        false => ((v + 0.055) / 1.055).powf(2.4),
    }
}

/// The byte in sRGB of a light.
fn byte(light: f64) -> f64 {
    let v = match light <= 0.003_130_8 {
        true => light * 12.92,
        false => 1.055 * light.powf(1.0 / 2.4) - 0.055,
    };
    (v * 255.0).round()
}

#[test]
fn a_smoothed_picture_is_the_mean_of_a_larger_one_in_linear_light() {
    let folder = Scratch::new("supersample");
    let of = |size: &str, samples: u32, file: &str| {
        let line = format!(
            "render shape:crank --section -z=50% --relief fractal --style lit --strategy exact --resolution {size} --supersample {samples} -o {file}"
        );
        folder.run(&line).exits(0);
        image::open(folder.path(file)).unwrap().to_rgba8()
    };
    let (smooth, large) = (of("120,90", 2, "smooth.png"), of("240,180", 1, "large.png"));
    let off = |mean: &dyn Fn([u8; 4]) -> f64| {
        let mut most = 0.0_f64;
        for (x, y, pixel) in smooth.enumerate_pixels() {
            for channel in 0..3 {
                let at = |i: u32| large.get_pixel(2 * x + i % 2, 2 * y + i / 2).0[channel];
                let own = f64::from(pixel.0[channel]);
                most = most.max((own - mean([0, 1, 2, 3].map(at))).abs());
            }
        }
        most
    };
    let in_light = off(&|four| byte(four.map(linear).iter().sum::<f64>() / 4.0));
    assert!(in_light <= 1.0, "{in_light} of 255");
    // The control: the mean of the bytes is something else along edges.
    let of_bytes = off(&|four| four.map(f64::from).iter().sum::<f64>() / 4.0);
    assert!(of_bytes > 20.0, "{of_bytes} of 255");
}
