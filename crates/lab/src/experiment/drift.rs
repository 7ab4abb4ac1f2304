//! Flicker while a camera drifts sideways by fractions of a pixel, moves closer, or orbits the scene.
//!
//! As the picture moves, some pixels change from frame to frame in what they show: kind, part, clip-surface or side. A strategy
//! that is as good as exact changes the same pixels as exact; an additional or missing change is visible as flicker. A sideways
//! drift shifts the picture without parallax, so that few pixels have to change. Each step costs one frame of every renderer and
//! one of exact, plus the frames of the reference pictures with many samples, if these are requested.

use std::collections::BTreeMap;
use std::sync::Arc;

use cutaway::Result;
use cutaway::layers::{Kind, Layer, Layers};
use cutaway::scene::{Prepared, View};
use cutaway::session::{Outcome, Session};
use glam::{DQuat, DVec2};

use super::figures::OF_DRIFT;
use super::picture_flicker::{PictureFlicker, luminance, sampled};
use super::{FrameQuestion, Renderer};
use crate::exact::{Exact, Truth};

/// Drift of a camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drift {
    /// Number of frames.
    pub frames: u32,
    /// Shift of the picture from each frame to the next, in pixels.
    pub px: f64,
    /// Factor by which each frame is magnified relative to the previous one.
    pub zoom: f64,
    /// Angle in degrees by which the camera orbits the centre of the scene from each frame to the next.
    pub turn_deg: f64,
    /// Samples along each side of a pixel in the judged pictures; 1 means one sample per pixel, as in a plain frame.
    pub fineness: u32,
    /// Samples along each side of a pixel in the reference pictures; 0 if pictures are not compared with a reference.
    pub samples: u32,
}

impl Drift {
    /// The view in a frame.
    fn view(&self, first: &View, prepared: &Prepared, frame: u32) -> View {
        let frame = f64::from(frame);
        let turn = DQuat::from_axis_angle(prepared.up(), (frame * self.turn_deg).to_radians());
        let centre = prepared.bounds.centre();
        let turned = View {
            eye: centre + turn * (first.eye - centre),
            right: turn * first.right,
            up: turn * first.up,
            forward: turn * first.forward,
            half_height: first.half_height / self.zoom.powf(frame),
            ..*first
        };
        // A corner of the scene may now be closer than any was in the first frame; the near plane must not cut it off.
        let corners = prepared.bounds.corners().into_iter();
        let nearest = corners.map(|c| turned.depth_of(c));
        let nearest = nearest.fold(f64::INFINITY, f64::min) * 0.99;
        let turned = View {
            near: match nearest > 0.0 {
                true => first.near.min(nearest),
                false => first.near,
            },
            ..turned
        };
        // If the camera only shifts, its parameters are kept unchanged, without rounding.
        let moved = if self.turn_deg == 0.0 && self.zoom == 1.0 {
            *first
        } else {
            turned
        };
        moved.sampled_at(DVec2::new(frame * self.px, 0.0) + 0.5)
    }
}

/// Pixels that change while a camera drifts, summed over all pairs of consecutive frames.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Flicker {
    /// Pixels that change in the strategy's frames.
    pub px: usize,
    /// Pixels that change in the exact images.
    pub exact_px: usize,
    /// Pixels decided in both frames that change in either the strategy or exact, but not in both.
    pub excess_px: usize,
}

impl Flicker {
    /// As figures of a record.
    pub fn figures(self) -> BTreeMap<String, f64> {
        let names = OF_DRIFT.map(str::to_owned);
        let values = [self.px, self.exact_px, self.excess_px].map(|n| n as f64);
        names.into_iter().zip(values).collect()
    }

    /// Adds the changes between two consecutive frames, each given with its exact image.
    pub fn add(&mut self, [before, after]: [(&Exact, &Layers); 2]) {
        for pixel in 0..after.1.pixels.len() {
            let changes =
                |a: &Layers, b: &Layers| class(&a.pixels[pixel]) != class(&b.pixels[pixel]);
            let drawn = changes(before.1, after.1);
            let exact = changes(&before.0.layers, &after.0.layers);
            let is_sure = !before.0.undecided[pixel] && !after.0.undecided[pixel];
            self.px += usize::from(drawn);
            self.exact_px += usize::from(exact);
            self.excess_px += usize::from(is_sure && drawn != exact);
        }
    }
}

/// What a pixel shows, without depth: kind, part, clip-surface, and the side of a surface.
fn class(layer: &Layer) -> (Kind, u16, u8, bool) {
    match layer.kind {
        Kind::Background => (Kind::Background, 0, 0, false),
        Kind::Surface => (Kind::Surface, layer.part, 0, layer.back_face),
        Kind::Cap => (Kind::Cap, layer.part, layer.clip_surface, false),
    }
}

/// The exact image for the sub-pixel bits with which a frame was drawn, and the layers of that frame.
type ComparedFrame = (Arc<Exact>, Layers);

/// Moves the camera of a scene and returns the figures of each renderer; a renderer that refuses a frame or is not a method has none.
/// Returns `None` as soon as `goes_on` returns false.
pub fn flicker(
    session: &mut Session,
    question: &FrameQuestion<'_>,
    renderers: &[Renderer],
    drift: Drift,
    step: &mut dyn FnMut(String),
    goes_on: &dyn Fn() -> bool,
) -> Result<Option<Vec<BTreeMap<String, f64>>>> {
    let truth = question.truth.unwrap_or(question.shown).truth()?;
    let mut sums: Vec<Option<Flicker>> = vec![Some(Flicker::default()); renderers.len()];
    let mut pictures = vec![PictureFlicker::default(); renderers.len()];
    let mut before: Option<Vec<Option<ComparedFrame>>> = None;
    for frame in 0..drift.frames {
        if !goes_on() {
            return Ok(None);
        }
        step(format!("drift {} of {}", frame + 1, drift.frames));
        let view = drift.view(&question.view, &question.shown.model.prepared, frame);
        let exact = Truth::new(truth, view);
        let mut drawn = Vec::with_capacity(renderers.len());
        for (renderer, pictures) in renderers.iter().zip(&mut pictures) {
            let Some(method) = renderer.or(question.options).method() else {
                drawn.push(None);
                continue;
            };
            let outcome = session.draw(&question.shown.model, &view, method);
            let layers = match outcome.map(|d| d.outcome) {
                Ok(Outcome::Refused(_)) => Ok(None),
                Ok(_) => session.layers(method).map(Some),
                Err(e) => Err(e),
            };
            let layers = layers?;
            if let Some(layers) = layers.as_ref().filter(|_| drift.samples > 0) {
                let channels = session.style_channels(&question.shown.model, &view, layers)?;
                let picture = match drift.fineness {
                    0 | 1 => luminance(session, method)?,
                    fineness => sampled(session, question.shown, &view, (method, fineness))?,
                };
                let truth = sampled(session, question.shown, &view, (method, drift.samples))?;
                pictures.add(&picture, &truth, layers, &channels);
            }
            let judged = layers.map(|l| Ok((exact.at(session.precision(method)?), l)));
            drawn.push(judged.transpose()?);
        }
        if let Some(before) = &before {
            for (sum, (a, b)) in sums.iter_mut().zip(before.iter().zip(&drawn)) {
                match (a, b, &mut *sum) {
                    (Some((x, a)), Some((y, b)), Some(sum)) => sum.add([(x, a), (y, b)]),
                    _ => *sum = None,
                }
            }
        }
        before = Some(drawn);
    }
    let figures = sums.iter().zip(&pictures).map(|(sum, pictures)| {
        let mut figures = sum.map(Flicker::figures).unwrap_or_default();
        figures.extend(pictures.figures());
        figures
    });
    Ok(Some(figures.collect()))
}
