//! What the tests that draw share: one session on the software adapter, a question asked of it and of the exact reference,
//! and the answer judged.
//!
//! The reference is worked out once per [`Question`] and shared by all strategies that answer it. The session is one for
//! all tests: its programs, capacities and pipelines live on from scene to scene, as they do for a user.

pub(crate) mod command;
pub(crate) mod data;
pub(crate) mod meshes;
pub(crate) mod numbers;
pub(crate) mod package;
pub(crate) mod real;
pub(crate) mod refined;
pub(crate) mod scenes;
pub(crate) mod shares;
pub(crate) mod tolerances;

use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};

use cutaway::Model;
use cutaway::error::Diagnostic;
use cutaway::gpu::{Gpu, GpuOptions};
use cutaway::layers::Layers;
use cutaway::scene::{Camera, Precision, Prepared, Scene, View};
use cutaway::session::{Outcome, Session};
use cutaway::strategies::{Method, Strategy};
use cutaway_lab::compare::{Comparison, compare};
use cutaway_lab::exact::Truth;
use cutaway_lab::hard_cases::{self};

pub(crate) use cutaway_lab::hard_cases::{Judged, class_of, is_wrong};

/// How many tests draw at a time: what they do beside that keeps the cores busy that a frame leaves idle.
const SESSIONS: usize = 2;

/// Messages as one text, a line each.
pub(crate) fn text_of(messages: &[Diagnostic]) -> String {
    let texts: Vec<String> = messages.iter().map(Diagnostic::to_string).collect();
    texts.join("\n")
}

/// The folder of the project.
pub(crate) fn root() -> &'static Path {
    let tests = Path::new(env!("CARGO_MANIFEST_DIR"));
    tests.parent().expect("tests lie in the project")
}

/// Whether tests that take minutes or hours run whole: with CUTAWAY_LONG set.
pub(crate) fn is_long() -> bool {
    std::env::var_os("CUTAWAY_LONG").is_some()
}

/// All of some cases where tests run whole, or else the first of every so many.
pub(crate) fn some<T>(all: impl Iterator<Item = T>, every: usize) -> impl Iterator<Item = T> {
    all.step_by(if is_long() { 1 } else { every })
}

/// The session of this test, which others use in turn, on the device of [`gpu`]: what is read from a frame is read by the guard
/// that drew it, for between two guards another test may draw.
pub(crate) fn session() -> MutexGuard<'static, Session> {
    static ALL: [OnceLock<Mutex<Session>>; SESSIONS] = [const { OnceLock::new() }; SESSIONS];
    static TESTS: AtomicUsize = AtomicUsize::new(0);
    // Each test has a thread of its own.
    thread_local!(static MINE: usize = TESTS.fetch_add(1, Ordering::Relaxed) % SESSIONS);
    ALL[MINE.with(|mine| *mine)]
        .get_or_init(|| Mutex::new(Session::new(gpu())))
        .lock()
        // A test that failed while it drew must not take the others down with it.
        .unwrap_or_else(PoisonError::into_inner)
}

/// A device of this test alone: of the adapter that has `$CUTAWAY_ADAPTER` in its name, or of a software one, the same everywhere.
pub(crate) fn gpu() -> Gpu {
    let options = GpuOptions {
        adapter: std::env::var("CUTAWAY_ADAPTER").ok(),
        prefer_software: true,
    };
    Gpu::open(&options).unwrap_or_else(|e| panic!("tests that draw need a graphics adapter: {e}"))
}

/// How the rasteriser of the adapter places triangles.
pub(crate) fn hardware_precision() -> Precision {
    static FOUND: OnceLock<Precision> = OnceLock::new();
    *FOUND.get_or_init(|| Precision {
        sub_pixel_bits: gpu().report().sub_pixel_bits.expect("bits are measured"),
        slopes_in_f32: true,
    })
}

/// How many times as far as with 8 sub-pixel bits the adapter moves vertices: 1, or 16 with 4.
pub(crate) fn coarseness() -> f64 {
    hardware_precision().coarseness()
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
    pub(crate) exact: Arc<Truth<Prepared>>,
}

impl Question {
    /// The scene through its own camera.
    pub(crate) fn new(scene: &Scene, size_px: [u32; 2]) -> Self {
        Self::through(scene, &scene.camera, size_px)
    }

    /// The scene through another camera.
    pub(crate) fn through(scene: &Scene, camera: &Camera, size_px: [u32; 2]) -> Self {
        Self::of(hard_cases::Question::through(scene, camera, size_px))
    }

    /// The scene through its own camera, of a model that may have been updated from another.
    pub(crate) fn of_model(model: Model, scene: &Scene, size_px: [u32; 2]) -> Self {
        let view = model.prepared.view(size_px);
        Self::of(hard_cases::Question::of_model(model, scene, view))
    }

    /// The scene in another view of this question's.
    pub(crate) fn in_view(self, scene: &Scene, view: View) -> Self {
        Self::of(hard_cases::Question::of_model(self.model, scene, view))
    }

    fn of(question: hard_cases::Question) -> Self {
        let hard_cases::Question { model, view, exact } = question;
        Self { model, view, exact }
    }

    /// The answer of a method, judged.
    pub(crate) fn answer(&self, method: impl Into<Method>) -> Judged {
        self.answer_in(&mut session(), method)
    }

    /// The answer of a method in a session that is still held, for what else is read from its frame.
    pub(crate) fn answer_in(&self, session: &mut Session, method: impl Into<Method>) -> Judged {
        let method = method.into();
        (self.asked().answer(session, &method))
            .unwrap_or_else(|e| panic!("{method} could not draw: {e}"))
    }

    /// Judges the last frame of a session by a method, which ended so.
    pub(crate) fn judge(&self, session: &Session, method: Method, outcome: Outcome) -> Judged {
        (self.asked().judge(session, method, outcome)).expect("layers of a drawn frame")
    }

    /// Pixels of the exact image with a neighbour of another kind, part or clip-surface, or far away in depth.
    pub(crate) fn boundary_px(&self) -> usize {
        self.asked().boundary_px()
    }

    /// Judges layers from anywhere.
    pub(crate) fn compare(&self, layers: &Layers) -> Comparison {
        compare(&self.exact, layers, &self.view, self.model.prepared.scale)
    }

    fn asked(&self) -> hard_cases::Question {
        hard_cases::Question {
            model: self.model.clone(),
            view: self.view,
            exact: self.exact.clone(),
        }
    }
}
