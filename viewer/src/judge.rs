//! The reference, and the errors of the slots against it, on a thread with a device of its own: the window never waits for it.
//!
//! A question is answered at a quarter of the resolution, then at half, then whole, so that the first answer comes while a hand still
//! moves. A newer question ends the one before it between two steps. The thread leaves a core to the window.
//!
//! Cannot: end in the middle of a step.

use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::thread;

use cutaway::compare::{Comparison, compare, heatmap_overlay};
use cutaway::exact::evaluate;
use cutaway::experiment::{Evaluator, Renderer, SceneAtTime};
use cutaway::scene::{Camera, View};
use cutaway::{Exact, Gpu, GpuOptions, Outcome, Result, Session};
use image::RgbaImage;

use crate::slot::Side;

/// By how much coarser the answers are that come one after the other.
const DIVISORS: [u32; 3] = [4, 2, 1];

/// What is asked.
#[derive(Clone, Debug)]
pub struct Question {
    /// Its number, which answers name.
    pub id: u64,
    /// The scene.
    pub at: Arc<SceneAtTime>,
    /// From where it is seen.
    pub camera: Camera,
    /// The picture that is looked at, in pixels.
    pub size_px: [u32; 2],
    /// Who draws the slots; none that is not seen.
    pub renderers: [Option<Renderer>; 2],
    /// Whether errors are wanted, or only the pictures of slots that are drawn on the CPU.
    pub wants_errors: bool,
}

/// A part of the answer.
#[derive(Debug)]
pub struct Answer {
    /// The number of the question.
    pub id: u64,
    /// The slot that it is about.
    pub side: Side,
    /// By how much coarser than the picture it is.
    pub divisor: u32,
    /// What is known.
    pub what: Known,
}

/// What is known of a slot.
#[derive(Debug)]
pub enum Known {
    /// The picture of one that is drawn on the CPU.
    Picture(RgbaImage),
    /// What is wrong where in one that is not.
    Errors {
        /// What is wrong where: transparent where nothing is.
        marks: RgbaImage,
        /// The counts.
        comparison: Comparison,
    },
    /// The method refuses the scene, or something failed.
    Failed(String),
}

/// The newest question, and whether the thread is to end.
#[derive(Default)]
struct Desk {
    question: Mutex<(Option<Question>, bool)>,
    changed: Condvar,
}

/// The thread that answers.
pub struct Judge {
    desk: Arc<Desk>,
    answers: Receiver<Answer>,
}

impl Judge {
    /// Starts the thread, which opens the adapter of a name; `wake` is called whenever there is an answer.
    pub fn start(adapter: String, wake: impl Fn() + Send + Sync + 'static) -> Self {
        let desk = Arc::new(Desk::default());
        let (tell, answers) = channel();
        let own = desk.clone();
        thread::spawn(move || work(&own, &adapter, &tell, &wake));
        Self { desk, answers }
    }

    /// Asks; what was asked before is not answered any more.
    pub fn ask(&self, question: Question) {
        let mut desk = lock(&self.desk.question);
        desk.0 = Some(question);
        self.desk.changed.notify_one();
    }

    /// What was answered since.
    pub fn answers(&self) -> impl Iterator<Item = Answer> + '_ {
        self.answers.try_iter()
    }
}

impl Drop for Judge {
    fn drop(&mut self) {
        lock(&self.desk.question).1 = true;
        self.desk.changed.notify_one();
    }
}

fn lock<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

fn work(desk: &Desk, adapter: &str, tell: &Sender<Answer>, wake: &(dyn Fn() + Sync)) {
    let cores = thread::available_parallelism().map_or(1, usize::from);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(cores.saturating_sub(1).max(1));
    let Ok(pool) = pool.build() else {
        return;
    };
    let mut session = None;
    while let Some(question) = next(desk) {
        let Question { id, renderers, .. } = question;
        let say = |side, divisor, what| {
            // The window is closed: there is nobody left to tell.
            let _ = tell.send(Answer {
                id,
                side,
                divisor,
                what,
            });
            wake();
        };
        let answered = pool.install(|| answer(desk, adapter, &mut session, &question, &say));
        if let Err(error) = answered {
            let asked = Side::BOTH
                .into_iter()
                .filter(|side| renderers[side.index()].is_some());
            asked.for_each(|side| say(side, 1, Known::Failed(error.to_string())));
        }
    }
}

/// Waits for a question; none when the thread is to end.
fn next(desk: &Desk) -> Option<Question> {
    let mut held = lock(&desk.question);
    loop {
        if held.1 {
            return None;
        }
        if let Some(question) = held.0.take() {
            return Some(question);
        }
        held = desk
            .changed
            .wait(held)
            .unwrap_or_else(PoisonError::into_inner);
    }
}

/// Whether nobody waits for the present answer any more.
fn is_outdated(desk: &Desk) -> bool {
    let held = lock(&desk.question);
    held.1 || held.0.is_some()
}

fn answer(
    desk: &Desk,
    adapter: &str,
    session: &mut Option<Session>,
    question: &Question,
    say: &(dyn Fn(Side, u32, Known) + Sync),
) -> Result<()> {
    let session = match session {
        Some(session) => session,
        None => session.insert(Session::new(Gpu::open(&GpuOptions {
            adapter: Some(adapter.to_owned()),
            prefer_software: false,
        })?)),
    };
    let model = &question.at.model;
    for divisor in DIVISORS {
        let size_px = question.size_px.map(|s| (s / divisor).max(1));
        let view = model.prepared.view_of(&question.camera, size_px);
        let mut exact: Option<Exact> = None;
        for side in Side::BOTH {
            let Some(renderer) = question.renderers[side.index()] else {
                continue;
            };
            if is_outdated(desk) {
                return Ok(());
            }
            let say = |known| say(side, divisor, known);
            let judged = judge(session, question, renderer, &view, &mut exact, &say);
            if let Err(error) = judged {
                say(Known::Failed(error.to_string()));
            }
        }
    }
    Ok(())
}

/// Says what is to be known of a slot at a resolution; the reference is evaluated once for both.
fn judge(
    session: &mut Session,
    question: &Question,
    renderer: Renderer,
    view: &View,
    exact: &mut Option<Exact>,
    say: &dyn Fn(Known),
) -> Result<()> {
    let model = &question.at.model;
    let truth = question.at.truth()?;
    let layers = match renderer {
        Renderer::Cpu(Evaluator::Exact) => {
            let exact = exact.get_or_insert_with(|| evaluate(truth, view));
            exact.layers.clone()
        }
        Renderer::Cpu(evaluator) => evaluator.evaluate(truth, view).layers,
        Renderer::Method(_) if !question.wants_errors => return Ok(()),
        Renderer::Method(method) => {
            let drawn = session.draw(model, view, method)?;
            if let Outcome::Refused(refusal) = drawn.outcome {
                say(Known::Failed(refusal.reason));
                return Ok(());
            }
            session.layers(method)?
        }
    };
    if let Renderer::Cpu(_) = renderer {
        let rgba = session.shade(model, view, &layers)?;
        let [width, height] = view.size_px;
        let picture = RgbaImage::from_raw(width, height, rgba).unwrap_or_default();
        say(Known::Picture(picture));
    }
    if question.wants_errors && renderer != Renderer::EXACT {
        let exact = exact.get_or_insert_with(|| evaluate(truth, view));
        let comparison = compare(exact, &layers, view, model.prepared.scale);
        let marks = heatmap_overlay(exact, &layers);
        say(Known::Errors { marks, comparison });
    }
    Ok(())
}
