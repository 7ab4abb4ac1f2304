//! One frame of one scene with its reference, and the result of a strategy.
//!
//! The exact image is evaluated once per [`Question`] and shared by all strategies that answer it. [`is_wrong`] defines wrong pixels
//! independently of [`crate::compare`], so that the counts there can be checked.

use std::sync::Arc;

use cutaway::Result;
use cutaway::layers::{Kind, Layer, Layers};
use cutaway::passes::Model;
use cutaway::scene::{Camera, Precision, Prepared, Scene, View};
use cutaway::session::{Outcome, Session};
use cutaway::strategies::Method;

use crate::compare::{Comparison, around, compare};
use crate::exact::{Exact, Truth};

/// One frame of one scene, and its exact images.
#[derive(Clone)]
pub struct Question {
    /// The scene as a model for strategies.
    pub model: Model,
    /// The view.
    pub view: View,
    /// The reference.
    pub exact: Arc<Truth<Prepared>>,
}

/// Result of a strategy for a question.
pub struct Judged {
    /// Errors compared with exact; all zero if the strategy refused.
    pub comparison: Comparison,
    /// The reference, for the rasteriser that drew the frame.
    pub exact: Arc<Exact>,
    /// Layers that the strategy drew; all background if it refused.
    pub layers: Layers,
    /// Outcome of the frame.
    pub outcome: Outcome,
    /// Precision of the rasteriser that drew the frame.
    pub precision: Precision,
}

impl Question {
    /// The scene through its own camera.
    pub fn new(scene: &Scene, size_px: [u32; 2]) -> Self {
        Self::through(scene, &scene.camera, size_px)
    }

    /// The scene through another camera.
    pub fn through(scene: &Scene, camera: &Camera, size_px: [u32; 2]) -> Self {
        let model = Model::new(scene);
        let view = model.prepared.view_of(camera, size_px);
        Self::of_model(model, scene, view)
    }

    /// The scene in a view. The model may be one that was updated from another scene.
    pub fn of_model(model: Model, scene: &Scene, view: View) -> Self {
        let exact = Arc::new(Truth::new(model.truth(scene).into_owned(), view));
        Self { model, view, exact }
    }

    /// Draws with a method and judges the frame. Fails if the device does; a refusal is an outcome.
    pub fn answer(&self, session: &mut Session, method: &Method) -> Result<Judged> {
        let outcome = session.draw(&self.model, &self.view, method)?.outcome;
        match outcome {
            Outcome::Refused(_) => Ok(Judged {
                comparison: Comparison::default(),
                exact: self.exact.at(Precision::USUAL),
                layers: Layers::background(self.view.size_px),
                outcome,
                precision: Precision::USUAL,
            }),
            _ => self.judge(session, *method, outcome),
        }
    }

    /// Judges a method's last frame, given the frame's outcome.
    pub fn judge(&self, session: &Session, method: Method, outcome: Outcome) -> Result<Judged> {
        let layers = session.layers(method)?;
        let precision = session.precision(method)?;
        let exact = self.exact.at(precision);
        let scale = self.model.prepared.scale;
        Ok(Judged {
            comparison: compare(&exact, &layers, &self.view, scale),
            exact,
            layers,
            outcome,
            precision,
        })
    }

    /// Number of pixels of the exact image that have a neighbour of another kind, part or clip-surface, or far away in depth.
    pub fn boundary_px(&self) -> usize {
        let layers = &self.exact.layers;
        let [width, height] = layers.size_px;
        let differ = |x: u32, y: u32, i: u32, j: u32| {
            let (a, b) = (layers.at(x, y), layers.at(i, j));
            let step = self.view.pixel_size(a.depth.min(b.depth));
            class_of(a) != class_of(b) || (a.depth - b.depth).abs() > 8.0 * step
        };
        (0..width * height)
            .filter(|p| {
                let (x, y) = (p % width, p / width);
                (x + 1 < width && differ(x, y, x + 1, y))
                    || (y + 1 < height && differ(x, y, x, y + 1))
            })
            .count()
    }

    /// Judges layers from any source.
    pub fn compare(&self, layers: &Layers) -> Comparison {
        compare(&self.exact, layers, &self.view, self.model.prepared.scale)
    }
}

impl Judged {
    /// The first fault that rules out an exact strategy, if the frame has one.
    pub fn fault_of_exact(&self) -> Option<String> {
        let c = &self.comparison;
        let faults = [
            (c.decided_wrong_px, "decided wrong"),
            (c.crack_px, "crack"),
            (c.odd_parity_px, "odd"),
        ];
        let mut lines: Vec<String> = faults
            .iter()
            .filter(|(count, _)| *count > 0)
            .map(|(count, what)| format!("{count} {what}"))
            .collect();
        if self.outcome != Outcome::Complete {
            lines.push(format!("outcome {:?}", self.outcome));
        }
        if lines.is_empty() {
            return None;
        }
        lines.extend(self.first_decided_wrong().map(|i| self.describe(i)));
        Some(lines.join(", "))
    }

    /// Indices of the decided pixels that are wrong.
    pub fn decided_wrong(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.layers.pixels.len()).filter(|i| {
            !self.exact.undecided[*i]
                && is_wrong(&self.exact.layers.pixels[*i], &self.layers.pixels[*i])
        })
    }

    /// The first decided wrong pixel.
    pub fn first_decided_wrong(&self) -> Option<usize> {
        self.decided_wrong().next()
    }

    /// The first decided pixel that is wrong and that the strategy does not mark.
    pub fn first_unmarked_wrong(&self) -> Option<usize> {
        self.decided_wrong()
            .find(|i| !self.layers.pixels[*i].unreliable)
    }

    /// Number of decided pixels that show a back face where exact shows none.
    pub fn back_faces(&self) -> usize {
        let pairs = self.layers.pixels.iter().zip(&self.exact.layers.pixels);
        pairs
            .zip(&self.exact.undecided)
            .filter(|((found, truth), undecided)| {
                found.back_face && !truth.back_face && !**undecided
            })
            .count()
    }

    /// Number of decided background pixels where exact has the outer side of a solid, and no background within `outline_px`. With 1 pixel
    /// these are a comparison's cracks, except for cracks that show a back face.
    pub fn holes(&self, outline_px: usize) -> usize {
        let truth = &self.exact.layers.pixels;
        let is_sky = |l: &Layer| l.kind == Kind::Background;
        let is_outline =
            |i: usize| around(self.layers.size_px, i, outline_px).any(|j| is_sky(&truth[j]));
        let is_hole = |i: &usize| {
            let is_solid = !is_sky(&truth[*i]) && !truth[*i].back_face;
            is_solid
                && is_sky(&self.layers.pixels[*i])
                && !self.exact.undecided[*i]
                && !is_outline(*i)
        };
        (0..truth.len()).filter(is_hole).count()
    }

    /// Describes a pixel.
    pub fn describe(&self, pixel: usize) -> String {
        let width = self.layers.size_px[0] as usize;
        format!(
            "pixel ({}, {}): exact {}, found {}",
            pixel % width,
            pixel / width,
            words(&self.exact.layers.pixels[pixel]),
            words(&self.layers.pixels[pixel])
        )
    }
}

/// Returns true if two pixels show different things.
pub fn is_wrong(truth: &Layer, found: &Layer) -> bool {
    let class = class_of(truth) != class_of(found);
    let turned = truth.kind == Kind::Surface && !truth.back_face && found.back_face;
    class || turned
}

/// Class of a pixel, without depth and normal.
pub fn class_of(layer: &Layer) -> (Kind, u16, u8) {
    match layer.kind {
        Kind::Background => (Kind::Background, 0, 0),
        Kind::Surface => (Kind::Surface, layer.part, 0),
        Kind::Cap => (Kind::Cap, layer.part, layer.clip_surface),
    }
}

fn words(l: &Layer) -> String {
    let back = if l.back_face { " back" } else { "" };
    match l.kind {
        Kind::Background => "background".to_owned(),
        Kind::Surface => format!("surface{back} of {} at {}", l.part, l.depth),
        Kind::Cap => format!("cap of {} by {} at {}", l.part, l.clip_surface, l.depth),
    }
}
