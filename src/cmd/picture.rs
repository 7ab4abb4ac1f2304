//! Pictures of a scene, by a strategy or from the exact reference, smoothed by drawing them finer.
//!
//! Supersampling draws the picture N x N times, each time with the pixel centres elsewhere in their pixels, and averages in
//! linear light: mixing sRGB values would darken every edge. It costs N² the time of one frame, but no larger frame on the
//! device, and changes nothing about what is measured: layers and times are always those of the plain resolution.

use std::io::Cursor;

use glam::{DVec2, Vec3};
use image::{ImageFormat, RgbaImage};
use rayon::prelude::*;

use crate::experiment::{Renderer, SceneAtTime};
use crate::layers::{Kind, Layers};
use crate::scene::View;
use crate::session::{Drawn, Outcome, Session};
use crate::strategies::{Refusal, Strategy};
use crate::{Error, Result};

/// What is behind the model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Backdrop {
    /// The gradient of the shading pass.
    Gradient,
    /// One colour, sRGB.
    Color(Vec3),
    /// Nothing: alpha is the share of the pixel that the model covers.
    Transparent,
}

/// How a picture is drawn.
#[derive(Clone, Copy, Debug)]
pub(super) struct Style {
    /// Fineness along each side.
    pub(super) supersample: u32,
    /// What is behind the model.
    pub(super) backdrop: Backdrop,
}

/// A picture, and the frames that it was made of.
pub(super) struct Picture {
    /// What it shows.
    pub(super) image: RgbaImage,
    /// One for each sample, in order; none of exact.
    pub(super) frames: Vec<Drawn>,
}

/// Draws a picture.
pub(super) fn draw(
    session: &mut Session,
    shown: &SceneAtTime,
    view: &View,
    renderer: Renderer,
    style: Style,
) -> Result<Picture> {
    let n = style.supersample;
    let mut samples = Samples::new(view.size_px, n, style.backdrop != Backdrop::Gradient);
    let mut frames = Vec::new();
    for (i, j) in (0..n).flat_map(|j| (0..n).map(move |i| (i, j))) {
        let at = (DVec2::new(f64::from(i), f64::from(j)) + 0.5) / f64::from(n);
        let view = view.sampled_at(at);
        let (rgba, layers) = match renderer {
            Renderer::Cpu(evaluator) => {
                let layers = evaluator.evaluate(shown.truth()?, &view).layers;
                (session.shade(&shown.model, &view, &layers)?, Some(layers))
            }
            Renderer::Method(method) => {
                let drawn = session.draw(&shown.model, &view, method)?;
                if let Outcome::Refused(refusal) = &drawn.outcome {
                    return Err(refused(renderer, refusal));
                }
                frames.push(drawn);
                let wanted = samples.empty.is_some();
                let layers = wanted.then(|| session.layers(method)).transpose()?;
                (session.picture(method)?, layers)
            }
        };
        samples.add([i, j], &rgba, layers.as_ref());
    }
    let image = filtered(&samples, style);
    Ok(Picture { image, frames })
}

/// The samples of a picture: N x N in each pixel, as if it were drawn so much finer.
struct Samples {
    size_px: [u32; 2],
    n: u32,
    rgba: Vec<u8>,
    /// Whether a sample shows nothing, where that is asked.
    empty: Option<Vec<bool>>,
}

impl Samples {
    fn new([width, height]: [u32; 2], n: u32, asks_for_empty: bool) -> Self {
        let size_px = [width * n, height * n];
        let count = size_px[0] as usize * size_px[1] as usize;
        Self {
            size_px,
            n,
            rgba: vec![0; count * 4],
            empty: asks_for_empty.then(|| vec![false; count]),
        }
    }

    /// Puts a frame into its place in every pixel.
    fn add(&mut self, [i, j]: [u32; 2], rgba: &[u8], layers: Option<&Layers>) {
        let [width, n] = [self.size_px[0], self.n].map(|v| v as usize);
        let (i, j, columns) = (i as usize, j as usize, width / n);
        for (pixel, color) in rgba.chunks_exact(4).enumerate() {
            let at = (pixel / columns * n + j) * width + pixel % columns * n + i;
            self.rgba[at * 4..at * 4 + 4].copy_from_slice(color);
            if let (Some(empty), Some(layers)) = (&mut self.empty, layers) {
                empty[at] = layers.pixels[pixel].kind == Kind::Background;
            }
        }
    }
}

/// The strategy of a renderer, by whatever means, as JSON names it.
pub(super) fn strategy_name(renderer: Renderer) -> String {
    match renderer.method() {
        Some(method) => method.strategy.to_string(),
        None => renderer.to_string(),
    }
}

/// The error of a strategy that does not draw what it was asked to.
pub(super) fn refused(renderer: Renderer, refusal: &Refusal) -> Error {
    let help = if renderer
        .method()
        .is_some_and(|m| m.strategy == Strategy::RAYCAST_MASK)
    {
        "lower --resolution, or cut by fewer or flatter clip-surfaces"
    } else {
        "use --strategy raycast+mask, or see `cutaway compare` for those that draw this scene"
    };
    Error::input(format!("strategy {renderer}"), &refusal.reason, help)
}

/// A picture as PNG.
pub(super) fn png(picture: &RgbaImage) -> Result<Vec<u8>> {
    let mut bytes = Cursor::new(Vec::new());
    picture
        .write_to(&mut bytes, ImageFormat::Png)
        .map_err(|e| {
            Error::input(
                "the picture",
                format!("cannot be encoded: {e}"),
                "lower --resolution",
            )
        })?;
    Ok(bytes.into_inner())
}

/// A picture of RGBA8 words, as they come from a session.
pub(super) fn plain(rgba: &[u8], size_px: [u32; 2]) -> RgbaImage {
    let style = Style {
        supersample: 1,
        backdrop: Backdrop::Gradient,
    };
    let mut samples = Samples::new(size_px, 1, false);
    samples.add([0, 0], rgba, None);
    filtered(&samples, style)
}

fn filtered(samples: &Samples, style: Style) -> RgbaImage {
    let Samples { size_px, n, .. } = *samples;
    let [width, height] = size_px.map(|s| s / n);
    let linear: Vec<f32> = (0..=255_u8)
        .map(|v| linear_from_srgb(f32::from(v) / 255.0))
        .collect();
    let behind = match style.backdrop {
        Backdrop::Color(color) => Some(color.map_each(linear_from_srgb)),
        _ => None,
    };
    let mut out = vec![0_u8; width as usize * height as usize * 4];
    let rows = out.par_chunks_mut(width as usize * 4).enumerate();
    rows.for_each(|(y, row)| {
        for (x, pixel) in row.chunks_exact_mut(4).enumerate() {
            let (mut sum, mut cover) = (Vec3::ZERO, 0.0_f32);
            for (i, j) in (0..n).flat_map(|j| (0..n).map(move |i| (i, j))) {
                let (fx, fy) = (x as u32 * n + i, y as u32 * n + j);
                let at = (fy * size_px[0] + fx) as usize;
                let empty = samples.empty.as_ref().is_some_and(|empty| empty[at]);
                let own = |c: usize| linear[usize::from(samples.rgba[at * 4 + c])];
                match behind {
                    Some(color) if empty => sum += color,
                    None if empty => continue,
                    _ => sum += Vec3::new(own(0), own(1), own(2)),
                }
                cover += 1.0;
            }
            // Not premultiplied, as PNG has it.
            let color = if cover > 0.0 { sum / cover } else { Vec3::ZERO };
            let byte = |v: f32| (v.clamp(0.0, 1.0) * 255.0).round() as u8;
            for (slot, v) in pixel.iter_mut().zip(color.to_array()) {
                *slot = byte(srgb_from_linear(v));
            }
            pixel[3] = byte(cover / (n * n) as f32);
        }
    });
    RgbaImage::from_raw(width, height, out).unwrap_or_default()
}

trait MapEach {
    fn map_each(self, f: fn(f32) -> f32) -> Self;
}

impl MapEach for Vec3 {
    fn map_each(self, f: fn(f32) -> f32) -> Self {
        Self::from_array(self.to_array().map(f))
    }
}

fn linear_from_srgb(v: f32) -> f32 {
    if v <= 0.040_45 {
        v / 12.92
    } else {
        ((v + 0.055) / 1.055).powf(2.4)
    }
}

fn srgb_from_linear(v: f32) -> f32 {
    if v <= 0.003_130_8 {
        12.92 * v
    } else {
        1.055 * v.powf(1.0 / 2.4) - 0.055
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn style(supersample: u32, backdrop: Backdrop) -> Style {
        Style {
            supersample,
            backdrop,
        }
    }

    /// A picture of one pixel from 2 x 2 samples.
    fn of_four(rgba: [[u8; 4]; 4], layers: Option<&Layers>) -> Samples {
        let mut samples = Samples::new([1, 1], 2, layers.is_some());
        for (at, color) in [[0, 0], [1, 0], [0, 1], [1, 1]].into_iter().zip(rgba) {
            let one = layers.map(|l| Layers {
                size_px: [1, 1],
                pixels: vec![*l.at(at[0], at[1])],
            });
            samples.add(at, &color, one.as_ref());
        }
        samples
    }

    #[test]
    fn samples_find_their_places() {
        let mut samples = Samples::new([2, 1], 2, false);
        for (v, at) in [[0, 0], [1, 0], [0, 1], [1, 1]].into_iter().enumerate() {
            let v = v as u8 * 10;
            samples.add(at, &[v, v, v, v, v + 1, v + 1, v + 1, v + 1], None);
        }
        let firsts: Vec<u8> = samples.rgba.chunks_exact(4).map(|c| c[0]).collect();
        assert_eq!(firsts, [0, 10, 1, 11, 20, 30, 21, 31]);
    }

    #[test]
    fn without_supersampling_nothing_changes() {
        let rgba: Vec<u8> = (0..=255).flat_map(|v| [v, 255 - v, v / 2, 255]).collect();
        let picture = plain(&rgba, [16, 16]);
        assert_eq!(
            picture.into_raw(),
            rgba,
            "every value survives the round trip"
        );
    }

    #[test]
    fn black_and_white_mix_in_linear_light() {
        let (black, white) = ([0, 0, 0, 255], [255, 255, 255, 255]);
        let samples = of_four([black, white, white, black], None);
        let picture = filtered(&samples, style(2, Backdrop::Gradient));
        assert_eq!(picture.get_pixel(0, 0).0, [188, 188, 188, 255], "not 128");
    }

    #[test]
    fn what_shows_nothing_becomes_the_backdrop() {
        let mut layers = Layers::background([2, 2]);
        layers.pixels[0].kind = Kind::Cap;
        let rgba = [[200, 100, 50, 255]; 4];
        let clear = filtered(
            &of_four(rgba, Some(&layers)),
            style(2, Backdrop::Transparent),
        );
        assert_eq!(
            clear.get_pixel(0, 0).0,
            [200, 100, 50, 64],
            "a quarter is covered"
        );
        let red = Backdrop::Color(Vec3::X);
        let mut samples = Samples::new([2, 2], 1, true);
        samples.add([0, 0], &rgba.concat(), Some(&layers));
        let on_red = filtered(&samples, style(1, red));
        assert_eq!(on_red.get_pixel(0, 0).0, [200, 100, 50, 255]);
        assert_eq!(on_red.get_pixel(1, 1).0, [255, 0, 0, 255]);
    }
}
