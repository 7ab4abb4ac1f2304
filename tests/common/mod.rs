//! What the tests that draw share: one session on the software adapter, a question asked of it and of the exact reference,
//! and the answer judged.
//!
//! The reference is worked out once per [`Question`] and shared by all strategies that answer it. The session is one per
//! test binary: its programs, capacities and pipelines live on from scene to scene, as they do for a user.

#![allow(
    dead_code,
    reason = "each test binary uses its own share of what is here"
)]

pub(crate) mod data;
pub(crate) mod meshes;
pub(crate) mod numbers;
pub(crate) mod real;
pub(crate) mod scenes;
pub(crate) mod tolerances;

use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};

use cutaway::compare::{Comparison, compare};
use cutaway::exact::{Exact, evaluate};
use cutaway::gpu::{Gpu, GpuOptions};
use cutaway::layers::{Kind, Layer, Layers};
use cutaway::passes::Model;
use cutaway::scene::{Camera, Scene, View};
use cutaway::session::{Outcome, Session};
use cutaway::strategies::Strategy;

/// The session of this test binary, on the software adapter: the same everywhere.
pub(crate) fn session() -> MutexGuard<'static, Session> {
    static SESSION: OnceLock<Mutex<Session>> = OnceLock::new();
    SESSION
        .get_or_init(|| {
            let gpu = Gpu::open(&software()).expect("tests that draw need a graphics adapter");
            Mutex::new(Session::new(gpu))
        })
        .lock()
        // A test that failed while it drew must not take the others down with it.
        .unwrap_or_else(PoisonError::into_inner)
}

/// The adapter that tests ask for.
pub(crate) fn software() -> GpuOptions {
    GpuOptions {
        prefer_software: true,
        ..GpuOptions::default()
    }
}

/// A strategy by its name.
pub(crate) fn strategy(name: &str) -> Strategy {
    name.parse().expect("the name of a strategy")
}

/// One frame of one scene, and the truth about it.
pub(crate) struct Question {
    /// The scene as strategies take it.
    pub(crate) model: Model,
    /// The view.
    pub(crate) view: View,
    /// The reference.
    pub(crate) exact: Arc<Exact>,
}

/// What a strategy made of a question.
pub(crate) struct Judged {
    /// Error against exact; all zero where the strategy refused.
    pub(crate) comparison: Comparison,
    /// The reference.
    pub(crate) exact: Arc<Exact>,
    /// What the strategy drew; background where it refused.
    pub(crate) layers: Layers,
    /// How the frame ended.
    pub(crate) outcome: Outcome,
}

impl Question {
    /// The scene through its own camera.
    pub(crate) fn of(scene: &Scene, size_px: [u32; 2]) -> Self {
        Self::through(scene, &scene.camera, size_px)
    }

    /// The scene through another camera.
    pub(crate) fn through(scene: &Scene, camera: &Camera, size_px: [u32; 2]) -> Self {
        let model = Model::of(scene);
        let view = model.prepared.view_of(camera, size_px);
        let exact = Arc::new(evaluate(&model.truth(scene), &view));
        Self { model, view, exact }
    }

    /// The scene through its own camera, of a model that may have been updated from another.
    pub(crate) fn of_model(model: Model, scene: &Scene, size_px: [u32; 2]) -> Self {
        let view = model.prepared.view(size_px);
        let exact = Arc::new(evaluate(&model.truth(scene), &view));
        Self { model, view, exact }
    }

    /// The answer of a strategy, judged.
    pub(crate) fn answer(&self, strategy: &Strategy) -> Judged {
        let mut session = session();
        let drawn = session
            .draw(&self.model, &self.view, strategy)
            .unwrap_or_else(|e| panic!("{strategy} could not draw: {e}"));
        let refused = matches!(drawn.outcome, Outcome::Refused(_));
        let layers = if refused {
            Layers::background(self.view.size_px)
        } else {
            session.layers(strategy).expect("layers of a drawn frame")
        };
        let comparison = if refused {
            Comparison::default()
        } else {
            self.compare(&layers)
        };
        Judged {
            comparison,
            exact: self.exact.clone(),
            layers,
            outcome: drawn.outcome,
        }
    }

    /// Pixels of the exact image with a neighbour of another kind, part or clip-surface, or far away in depth.
    pub(crate) fn boundary_px(&self) -> usize {
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

    /// Judges layers from anywhere.
    pub(crate) fn compare(&self, layers: &Layers) -> Comparison {
        compare(&self.exact, layers, &self.view, self.model.prepared.scale)
    }
}

/// The answer of a strategy to a scene through a camera, judged.
pub(crate) fn judge(
    scene: &Scene,
    camera: &Camera,
    size_px: [u32; 2],
    strategy: &Strategy,
) -> Judged {
    Question::through(scene, camera, size_px).answer(strategy)
}

impl Judged {
    /// What keeps this from being the frame of an exact strategy, if anything does.
    pub(crate) fn fault_of_exact(&self) -> Option<String> {
        let c = &self.comparison;
        let faults = [
            (c.decided_wrong_px, "decided wrong"),
            (c.crack_px, "crack"),
            (c.odd_parity_px, "odd"),
        ];
        let mut told: Vec<String> = faults
            .iter()
            .filter(|(count, _)| *count > 0)
            .map(|(count, what)| format!("{count} {what}"))
            .collect();
        if self.outcome != Outcome::Complete {
            told.push(format!("outcome {:?}", self.outcome));
        }
        if told.is_empty() {
            return None;
        }
        told.extend(self.first_decided_wrong().map(|i| self.told(i)));
        Some(told.join(", "))
    }

    /// Numbers of the decided pixels that are wrong.
    pub(crate) fn decided_wrong(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.layers.pixels.len()).filter(|i| {
            !self.exact.undecided[*i]
                && is_wrong(&self.exact.layers.pixels[*i], &self.layers.pixels[*i])
        })
    }

    /// The first of them.
    pub(crate) fn first_decided_wrong(&self) -> Option<usize> {
        self.decided_wrong().next()
    }

    /// A pixel in words.
    pub(crate) fn told(&self, pixel: usize) -> String {
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

/// Whether two pixels show different things. Written apart from `compare`, so that the two can be held against each other.
pub(crate) fn is_wrong(truth: &Layer, found: &Layer) -> bool {
    let class = class_of(truth) != class_of(found);
    let turned = truth.kind == Kind::Surface && !truth.back_face && found.back_face;
    class || turned
}

/// What a pixel shows, without depth and normal.
pub(crate) fn class_of(layer: &Layer) -> (Kind, u16, u8) {
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
