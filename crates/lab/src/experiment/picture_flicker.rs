//! Flicker of a picture while the camera drifts: how far each pixel's colour deviates from the same pixel drawn with many samples, and
//! how this deviation changes from frame to frame.
//!
//! A deviation that is equal in all frames is seen as blur or sharpness; one that changes is seen as flicker. So the figure is the standard
//! deviation, over the frames, of the picture minus the picture with many samples, in linear luminance, as RMS over the pixels of one kind.

use std::collections::BTreeMap;

use cutaway::Result;
use cutaway::layers::{Kind, Layers};
use cutaway::scene::{View, linear_from_srgb};
use cutaway::session::{Session, StyleChannels};
use cutaway::strategies::Method;

use super::SceneAtTime;
use super::figures::OF_PICTURES;

/// Accumulated values of a pixel over all frames so far.
#[derive(Clone, Copy, Debug, Default)]
struct PixelTotals {
    sum: f64,
    squares: f64,
    /// True if the pixel was something other than a cap in some frame.
    is_other: bool,
    is_shown: bool,
    is_stroked: bool,
}

/// Accumulates the pictures that one method draws for a drifting camera.
#[derive(Clone, Debug, Default)]
pub(super) struct PictureFlicker {
    frames: f64,
    pixels: Vec<PixelTotals>,
}

impl PictureFlicker {
    /// Adds a frame: its picture and the picture with many samples, both in linear luminance, and the layer of each pixel.
    pub(super) fn add(
        &mut self,
        picture: &[f32],
        truth: &[f32],
        layers: &Layers,
        channels: &StyleChannels,
    ) {
        self.frames += 1.0;
        self.pixels.resize(picture.len(), PixelTotals::default());
        for (i, seen) in self.pixels.iter_mut().enumerate() {
            let strays = f64::from(picture[i]) - f64::from(truth[i]);
            seen.sum += strays;
            seen.squares += strays * strays;
            let kind = layers.pixels[i].kind;
            let is_stroked = channels.stroke.get(i).is_some_and(|s| *s > 0.0);
            seen.is_shown |= kind != Kind::Background || is_stroked;
            seen.is_stroked |= is_stroked;
            seen.is_other |= kind != Kind::Cap;
        }
    }

    /// The figures for a record: over all covered pixels, over caps without strokes, and over strokes.
    pub(super) fn figures(&self) -> BTreeMap<String, f64> {
        let of = |is_of: fn(&PixelTotals) -> bool| {
            let pixels = self.pixels.iter().filter(|p| is_of(p));
            let (count, sum) = pixels.fold((0.0, 0.0), |(count, sum), pixel| {
                let mean = pixel.sum / self.frames;
                (
                    count + 1.0,
                    sum + (pixel.squares / self.frames - mean * mean).max(0.0),
                )
            });
            (count > 0.0).then(|| (sum / count).sqrt())
        };
        let values = [
            of(|p| p.is_shown),
            of(|p| !p.is_other && !p.is_stroked),
            of(|p| p.is_stroked),
        ];
        let named = OF_PICTURES.iter().zip(values);
        named
            .filter_map(|(name, value)| Some(((*name).to_owned(), value?)))
            .collect()
    }
}

/// Linear luminance of a method's last frame.
pub(super) fn luminance(session: &Session, method: Method) -> Result<Vec<f32>> {
    let rgba = session.picture(method)?;
    Ok(rgba
        .chunks_exact(4)
        .map(|c| {
            let [r, g, b] = [c[0], c[1], c[2]].map(|v| linear_from_srgb(f32::from(v) / 255.0));
            0.2126 * r + 0.7152 * g + 0.0722 * b
        })
        .collect())
}

/// Luminance of a picture with `samples` samples along each side of a pixel; empty if a sample is refused.
pub(super) fn sampled(
    session: &mut Session,
    shown: &SceneAtTime,
    view: &View,
    (method, samples): (Method, u32),
) -> Result<Vec<f32>> {
    let mut mean = Vec::new();
    for (_, view) in view.samples(samples) {
        // The outcome is ignored: the same view was already drawn with its samples at the pixel centres.
        let _ = session.draw(&shown.model, &view, method)?;
        let sample = luminance(session, method)?;
        mean.resize(sample.len(), 0.0);
        let share = 1.0 / (samples * samples) as f32;
        mean.iter_mut()
            .zip(sample)
            .for_each(|(m, s)| *m += s * share);
    }
    Ok(mean)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_strays_alike_in_all_frames_is_no_flicker() {
        let mut layers = Layers::background([4, 1]);
        layers.pixels[1].kind = Kind::Cap;
        layers.pixels[2].kind = Kind::Surface;
        layers.pixels[3].kind = Kind::Cap;
        let channels = StyleChannels {
            stroke: vec![0.0, 0.0, 0.0, 0.5],
            ..StyleChannels::default()
        };
        let mut flicker = PictureFlicker::default();
        for strays in [0.1, -0.1] {
            let picture = [0.5, 0.5 + strays, 0.7, 0.5 + 2.0 * strays];
            flicker.add(&picture, &[0.0, 0.5, 0.5, 0.5], &layers, &channels);
        }
        let figures = flicker.figures();
        let [whole, cap, stroke] = OF_PICTURES.map(|name| figures[name]);
        assert!((cap - 0.1).abs() < 1e-6, "{cap}");
        assert!((stroke - 0.2).abs() < 1e-6, "{stroke}");
        // The RMS is over three pixels, one of which does not flicker.
        assert!((whole - (0.05_f64 / 3.0).sqrt()).abs() < 1e-6, "{whole}");
    }
}
