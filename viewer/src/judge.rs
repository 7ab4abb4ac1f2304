//! The reference, and what is compared with it, on a thread with a device of its own: the window never waits for it.
//!
//! Of each kind of question the newest is answered: the errors of the slots, a pixel that is [magnified](magnify), the [cost] of a
//! frame, a [survey] of all methods. The errors are found at a quarter of the resolution, then at half, then whole, so that the first
//! answer comes while a hand still moves; a newer question ends the one before it between two steps. A survey takes its next step only
//! when nothing else is asked. The thread leaves a core to the window.
//!
//! The reference at the whole resolution is kept, 40 bytes a pixel, for the next question about the same picture.
//!
//! Cannot: end in the middle of a step.

pub mod cost;
mod errors;
pub mod magnify;
pub mod survey;
mod worker;

use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::thread;

use cutaway::compare::Comparison;
use cutaway::experiment::{Renderer, SceneAtTime};
use cutaway::scene::{Camera, View};
use image::RgbaImage;

use crate::slot::Side;
use cost::Cost;
use magnify::Magnified;
use survey::{Survey, Surveyed};
use worker::Worker;

/// A picture that is asked about.
#[derive(Clone, Debug)]
pub struct Subject {
    /// Another number whenever solids, cuts or the eye may be others.
    pub revision: u64,
    /// The scene.
    pub at: Arc<SceneAtTime>,
    /// From where it is seen.
    pub camera: Camera,
    /// Width and height in pixels.
    pub size_px: [u32; 2],
}

impl Subject {
    /// Its view at the whole resolution.
    pub fn view(&self) -> View {
        let prepared = &self.at.model.prepared;
        prepared.view_of(&self.camera, self.size_px)
    }

    /// Whether the rays meet the same in it, however that is dressed.
    pub fn has_the_rays_of(&self, other: &Self) -> bool {
        let scale = |subject: &Self| subject.at.model.prepared.scale;
        self.revision == other.revision
            && self.view() == other.view()
            && scale(self) == scale(other)
    }
}

/// What is asked of the errors of the slots.
#[derive(Clone, Debug)]
pub struct Question {
    /// Its number, which answers name.
    pub id: u64,
    /// The picture that is looked at.
    pub subject: Subject,
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

/// What else was found.
#[derive(Debug)]
pub enum Finding {
    /// The neighbourhood of a pixel, by the number of the question.
    Magnified(u64, Result<Magnified, String>),
    /// The cost of a frame of a slot, by the number of the question.
    Cost(u64, Side, Result<Cost, String>),
    /// A step of a survey, by the number of the question.
    Surveyed(u64, Surveyed),
}

/// The newest questions.
#[derive(Default)]
struct Desk {
    asked: Mutex<Asked>,
    changed: Condvar,
}

/// What is asked and not begun, by kind.
#[derive(Default)]
struct Asked {
    errors: Option<Question>,
    pixel: Option<magnify::Question>,
    cost: Option<cost::Question>,
    survey: Option<survey::Question>,
    /// The number of the survey that is to go on.
    surveyed: Option<u64>,
    /// The thread is to end.
    is_over: bool,
}

/// What is done next.
enum Task {
    Errors(Question),
    Pixel(magnify::Question),
    Cost(cost::Question),
    BeginSurvey(survey::Question),
    GoOnWithSurvey,
}

/// The thread that answers.
pub struct Judge {
    desk: Arc<Desk>,
    answers: Receiver<Answer>,
    findings: Receiver<Finding>,
}

impl Judge {
    /// Starts the thread, which opens the adapter of a name; `wake` is called whenever there is an answer.
    pub fn start(adapter: String, wake: impl Fn() + Send + Sync + 'static) -> Self {
        let desk = Arc::new(Desk::default());
        let (tell, answers) = channel();
        let (find, findings) = channel();
        let own = desk.clone();
        thread::spawn(move || work(&own, adapter, (&tell, &find), &wake));
        Self {
            desk,
            answers,
            findings,
        }
    }

    /// Asks for errors; what was asked of them before is not answered any more.
    pub fn ask(&self, question: Question) {
        self.put(|asked| asked.errors = Some(question));
    }

    /// Asks for the neighbourhood of a pixel.
    pub fn magnify(&self, question: magnify::Question) {
        self.put(|asked| asked.pixel = Some(question));
    }

    /// Asks for the cost of a frame.
    pub fn cost(&self, question: cost::Question) {
        self.put(|asked| asked.cost = Some(question));
    }

    /// Begins a survey in the place of the last.
    pub fn survey(&self, question: survey::Question) {
        self.put(|asked| {
            asked.surveyed = Some(question.id);
            asked.survey = Some(question);
        });
    }

    /// Ends the survey before its next step.
    pub fn cancel_survey(&self) {
        self.put(|asked| (asked.survey, asked.surveyed) = (None, None));
    }

    /// What was answered since.
    pub fn answers(&self) -> impl Iterator<Item = Answer> + '_ {
        self.answers.try_iter()
    }

    /// What else was found since.
    pub fn findings(&self) -> impl Iterator<Item = Finding> + '_ {
        self.findings.try_iter()
    }

    fn put(&self, change: impl FnOnce(&mut Asked)) {
        change(&mut lock(&self.desk.asked));
        self.desk.changed.notify_one();
    }
}

impl Drop for Judge {
    fn drop(&mut self) {
        self.put(|asked| asked.is_over = true);
    }
}

fn lock<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

fn work(
    desk: &Desk,
    adapter: String,
    (tell, find): (&Sender<Answer>, &Sender<Finding>),
    wake: &(dyn Fn() + Sync),
) {
    let cores = thread::available_parallelism().map_or(1, usize::from);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(cores.saturating_sub(1).max(1));
    let Ok(pool) = pool.build() else {
        return;
    };
    let mut worker = Worker::new(adapter);
    let mut survey: Option<Survey> = None;
    let found = |finding| {
        // The window is closed: there is nobody left to tell.
        let _ = find.send(finding);
        wake();
    };
    while let Some(task) = next(desk, &mut survey) {
        pool.install(|| match task {
            Task::Errors(question) => {
                let say = |answer| {
                    let _ = tell.send(answer);
                    wake();
                };
                errors::answer(&mut worker, &question, &|| is_outdated(desk), &say);
            }
            Task::Pixel(question) => {
                let magnified = magnify::answer(&mut worker, &question);
                found(Finding::Magnified(
                    question.id,
                    magnified.map_err(|e| e.to_string()),
                ));
            }
            Task::Cost(question) => {
                for (side, renderer) in question.slots() {
                    let cost = cost::answer(&mut worker, &question, renderer);
                    found(Finding::Cost(
                        question.id,
                        side,
                        cost.map_err(|e| e.to_string()),
                    ));
                }
            }
            Task::BeginSurvey(question) => survey = Some(Survey::new(question)),
            Task::GoOnWithSurvey => {
                if let Some(survey) = &mut survey {
                    let surveyed = survey.step(&mut worker);
                    found(Finding::Surveyed(survey.id(), surveyed));
                }
            }
        });
    }
}

/// Waits for something to be done; none when the thread is to end.
fn next(desk: &Desk, survey: &mut Option<Survey>) -> Option<Task> {
    let mut held = lock(&desk.asked);
    loop {
        let asked = &mut *held;
        if asked.is_over {
            return None;
        }
        let is_wanted = |survey: &Survey| asked.surveyed == Some(survey.id()) && !survey.is_done();
        *survey = survey.take().filter(is_wanted);
        let goes_on = survey.as_ref().map(|_| Task::GoOnWithSurvey);
        let task = (asked.pixel.take().map(Task::Pixel))
            .or_else(|| asked.errors.take().map(Task::Errors))
            .or_else(|| asked.cost.take().map(Task::Cost))
            .or_else(|| asked.survey.take().map(Task::BeginSurvey))
            .or(goes_on);
        if task.is_some() {
            return task;
        }
        held = desk
            .changed
            .wait(held)
            .unwrap_or_else(PoisonError::into_inner);
    }
}

/// Whether nobody waits for the errors that are being found any more.
fn is_outdated(desk: &Desk) -> bool {
    let held = lock(&desk.asked);
    held.is_over || held.errors.is_some()
}
