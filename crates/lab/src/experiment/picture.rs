//! Pictures of a scene, by a strategy or from the exact reference, antialiased by supersampling.
//!
//! Supersampling draws the picture N x N times, each time with another sample position within the pixels, and averages in
//! linear light, as mixing sRGB values would darken every edge. It takes N² times as long as one frame, but needs no larger frame
//! on the device. It does not affect measurements: layers and times are always those of the plain resolution. Large pictures are drawn in
//! strips of rows, or shaded from layers that are ([`Session::strips`]).

use std::io::Cursor;

use cutaway::layers::Layers;
use cutaway::passes::{GroundShadow, Model};
use cutaway::scene::{View, linear_from_srgb, srgb_from_linear};
use cutaway::session::{Drawn, Outcome, Session, Strip};
use cutaway::strategies::{Refusal, Strategy, Unsupported};
use cutaway::{Error, Result};
use glam::Vec3;
use image::{ImageFormat, RgbaImage};
use rayon::prelude::*;

use crate::experiment::{Renderer, SceneAtTime};

/// A picture, and the frames that it was averaged from.
pub struct Picture {
    /// The image.
    pub image: RgbaImage,
    /// One frame for each sample, in order; empty for exact.
    pub frames: Vec<Drawn>,
}

/// Gets layers strip by strip, each with the number of its first row.
pub type LayersNote<'a> = &'a mut dyn FnMut(&Layers, u32);

/// Draws a picture, strip by strip if it is large.
pub fn draw(
    session: &mut Session,
    shown: &SceneAtTime,
    view: &View,
    renderer: Renderer,
    supersample: u32,
) -> Result<Picture> {
    draw_noting(session, shown, view, renderer, supersample, None)
}

/// Draws a picture. `note` gets the layers of the last sample.
pub fn draw_noting(
    session: &mut Session,
    shown: &SceneAtTime,
    view: &View,
    renderer: Renderer,
    supersample: u32,
    mut note: Option<LayersNote<'_>>,
) -> Result<Picture> {
    let grounded = on_ground(session, shown, renderer)?;
    let model = grounded.as_ref().unwrap_or(&shown.model);
    let strips = match renderer {
        Renderer::Cpu(_) => None,
        Renderer::Method(method) => session.strips(model, view, method),
    };
    // Layers that are not drawn in strips with their picture are those of the whole picture, and are shaded.
    let is_shaded = strips.is_none();
    let [width, height] = view.size_px;
    let strips = strips.unwrap_or_else(|| vec![Strip::whole(view)]);
    let is_whole = strips.len() == 1;
    let pixels = if is_whole {
        0
    } else {
        width as usize * height as usize
    };
    let mut rgba = Vec::with_capacity(pixels * 4);
    let mut frames: Vec<Drawn> = Vec::new();
    for strip in strips {
        let mut samples = PictureSamples::new([width, strip.rows()[1]], supersample);
        let first_row = strip.rows()[0];
        for (number, (at, view)) in strip.view.samples(supersample).enumerate() {
            let is_last = number + 1 == (supersample * supersample) as usize;
            let note = note.as_mut().filter(|_| is_last);
            let mut count = |drawn: Drawn| match frames.get_mut(number) {
                Some(frame) => frame.add(drawn),
                None => frames.push(drawn),
            };
            let layers = match renderer {
                Renderer::Cpu(evaluator) => evaluator.evaluate(shown.truth()?, &view).layers,
                Renderer::Method(method) if is_shaded => {
                    let drawn = session.draw_layers(model, &view, method)?;
                    let (drawn, layers) = drawn.map_err(|r| refused(renderer, &r))?;
                    count(drawn);
                    layers
                }
                Renderer::Method(method) => {
                    let drawn = session.draw(model, &view, method)?;
                    if let Outcome::Refused(refusal) = &drawn.outcome {
                        return Err(refused(renderer, refusal));
                    }
                    count(drawn);
                    samples.add(at, strip.own(&session.picture(method)?, 4));
                    if let Some(note) = note {
                        note(&strip.own_layers(session.layers(method)?), first_row);
                    }
                    continue;
                }
            };
            samples.add(at, &session.shade(model, &view, &layers)?);
            if let Some(note) = note {
                note(&layers, first_row);
            }
        }
        let filtered = filtered(samples);
        match is_whole {
            true => rgba = filtered,
            false => rgba.extend(filtered),
        }
    }
    Ok(Picture {
        image: image_of(rgba, view.size_px),
        frames,
    })
}

/// The model with its shadow on the ground, if the style has one.
fn on_ground(session: &Session, shown: &SceneAtTime, renderer: Renderer) -> Result<Option<Model>> {
    if !shown.model.prepared.style.shadow.is_drawn() {
        return Ok(None);
    }
    let shadow = match renderer {
        Renderer::Cpu(evaluator) => {
            let truth = shown.truth()?;
            let views = GroundShadow::views(truth);
            let [below, above] = views.map(|view| evaluator.evaluate(truth, &view).layers);
            GroundShadow::of(truth, &views, [&below, &above])
        }
        Renderer::Method(method) => session
            .ground_shadow(&shown.model, method)?
            .map_err(|refusal| refused(renderer, &refusal))?,
    };
    Ok(Some(shown.model.on_ground(shadow)))
}

/// The samples of a picture, N x N per pixel, laid out as a picture N times as wide and high.
struct PictureSamples {
    size_px: [u32; 2],
    n: u32,
    rgba: Vec<u8>,
}

impl PictureSamples {
    fn new([width, height]: [u32; 2], n: u32) -> Self {
        let size_px = [width * n, height * n];
        let count = size_px[0] as usize * size_px[1] as usize;
        Self {
            size_px,
            n,
            rgba: vec![0; count * 4],
        }
    }

    /// Stores a frame as one sample of every pixel.
    fn add(&mut self, [i, j]: [u32; 2], rgba: &[u8]) {
        let [width, n] = [self.size_px[0], self.n].map(|v| v as usize);
        let (i, j, columns) = (i as usize, j as usize, width / n);
        for (pixel, color) in rgba.chunks_exact(4).enumerate() {
            let at = (pixel / columns * n + j) * width + pixel % columns * n + i;
            self.rgba[at * 4..at * 4 + 4].copy_from_slice(color);
        }
    }
}

/// Name of a renderer in JSON, including its draw options.
pub fn strategy_name(renderer: Renderer) -> String {
    match renderer.method() {
        Some(method) => method.strategy.to_string(),
        None => renderer.to_string(),
    }
}

/// The error to report if a strategy refused the scene.
pub fn refused(renderer: Renderer, refusal: &Refusal) -> Error {
    let help = if refusal.unsupported == Unsupported::Cuts {
        "cut the mesh by some of the cuts first (`cutaway export MODEL --section ... -o part.ply`), then draw part.ply with the other cuts"
    } else if renderer
        .method()
        .is_some_and(|m| m.strategy == Strategy::RAYCAST_MASK)
    {
        "lower --resolution, or cut by fewer or flatter clip-surfaces"
    } else {
        "use --strategy raycast+mask, or see `cutaway compare` for the strategies that draw this scene"
    };
    Error::input(format!("strategy {renderer}"), &refusal.reason, help)
}

/// Encodes a picture as PNG.
pub fn png(picture: &RgbaImage) -> Result<Vec<u8>> {
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

/// Makes a picture from RGBA8 data as a session returns it.
pub fn plain(mut rgba: Vec<u8>, size_px: [u32; 2]) -> RgbaImage {
    clear_transparent(&mut rgba);
    image_of(rgba, size_px)
}

/// An image of RGBA8 data that fits its size.
fn image_of(rgba: Vec<u8>, [width, height]: [u32; 2]) -> RgbaImage {
    RgbaImage::from_raw(width, height, rgba).unwrap_or_default()
}

/// The picture that samples average to: RGBA8.
fn filtered(samples: PictureSamples) -> Vec<u8> {
    let PictureSamples {
        size_px,
        n,
        mut rgba,
    } = samples;
    if n == 1 {
        clear_transparent(&mut rgba);
        return rgba;
    }
    let [width, height] = size_px.map(|s| s / n);
    let linear: Vec<f32> = (0..=255_u8)
        .map(|v| linear_from_srgb(f32::from(v) / 255.0))
        .collect();
    let mut out = vec![0_u8; width as usize * height as usize * 4];
    let rows = out.par_chunks_mut(width as usize * 4).enumerate();
    rows.for_each(|(y, row)| {
        for (x, pixel) in row.chunks_exact_mut(4).enumerate() {
            let (mut sum, mut cover) = (Vec3::ZERO, 0.0_f32);
            for (i, j) in (0..n).flat_map(|j| (0..n).map(move |i| (i, j))) {
                let (fx, fy) = (x as u32 * n + i, y as u32 * n + j);
                let at = (fy as usize * size_px[0] as usize + fx as usize) * 4;
                let own = |c: usize| linear[usize::from(rgba[at + c])];
                let share = f32::from(rgba[at + 3]) / 255.0;
                sum += Vec3::new(own(0), own(1), own(2)) * share;
                cover += share;
            }
            // Straight alpha, as PNG requires.
            let color = if cover > 0.0 { sum / cover } else { Vec3::ZERO };
            let byte = |v: f32| (v.clamp(0.0, 1.0) * 255.0).round() as u8;
            for (slot, v) in pixel.iter_mut().zip(color.to_array()) {
                *slot = byte(srgb_from_linear(v));
            }
            pixel[3] = byte(cover / (n * n) as f32);
        }
    });
    out
}

/// Makes all pixels without cover equal.
fn clear_transparent(rgba: &mut [u8]) {
    let pixels = rgba.as_chunks_mut::<4>().0.iter_mut();
    pixels.filter(|p| p[3] == 0).for_each(|p| *p = [0; 4]);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A picture of one pixel from 2 x 2 samples.
    fn of_four(rgba: [[u8; 4]; 4]) -> Vec<u8> {
        let mut samples = PictureSamples::new([1, 1], 2);
        for (at, color) in [[0, 0], [1, 0], [0, 1], [1, 1]].into_iter().zip(rgba) {
            samples.add(at, &color);
        }
        filtered(samples)
    }

    #[test]
    fn samples_find_their_places() {
        let mut samples = PictureSamples::new([2, 1], 2);
        for (v, at) in [[0, 0], [1, 0], [0, 1], [1, 1]].into_iter().enumerate() {
            let v = v as u8 * 10;
            samples.add(at, &[v, v, v, v, v + 1, v + 1, v + 1, v + 1]);
        }
        let firsts: Vec<u8> = samples.rgba.chunks_exact(4).map(|c| c[0]).collect();
        assert_eq!(firsts, [0, 10, 1, 11, 20, 30, 21, 31]);
    }

    #[test]
    fn without_supersampling_nothing_changes() {
        let rgba: Vec<u8> = (0..=255).flat_map(|v| [v, 255 - v, v / 2, 255]).collect();
        let picture = plain(rgba.clone(), [16, 16]);
        assert_eq!(
            picture.into_raw(),
            rgba,
            "every value survives the round trip"
        );
    }

    #[test]
    fn black_and_white_mix_in_linear_light() {
        let (black, white) = ([0, 0, 0, 255], [255, 255, 255, 255]);
        let picture = of_four([black, white, white, black]);
        assert_eq!(picture, [188, 188, 188, 255], "not 128");
    }

    #[test]
    fn what_covers_nothing_has_no_say_in_the_colour() {
        let (model, nothing) = ([200, 100, 50, 255], [9, 9, 9, 0]);
        let clear = of_four([model, nothing, nothing, nothing]);
        assert_eq!(clear, [200, 100, 50, 64], "a quarter is covered");
        let half = [200, 100, 50, 128];
        let soft = of_four([model, half, nothing, nothing]);
        assert_eq!(soft, [200, 100, 50, 96], "three eighths");
    }
}
