//! A thread that answers, with a device of its own. A survey takes its next step only when nothing else is asked. The thread leaves a core to
//! the window.

use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Condvar, Mutex, PoisonError};

use pollster::block_on;

use super::bench::Bench;
use super::survey::{self, Survey};
use super::{Answer, Asker, Finding, Question, cost, errors, magnify};
use crate::beside::beside;
use crate::state::State;

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
    pub fn start(adapter: &str, wake: impl Fn() + Send + Sync + 'static) -> Self {
        let desk = Arc::new(Desk::default());
        let (tell, answers) = channel();
        let (find, findings) = channel();
        let (own, adapter) = (desk.clone(), adapter.to_owned());
        beside(move || work(&own, adapter, (&tell, &find), &wake));
        Self {
            desk,
            answers,
            findings,
        }
    }

    /// Asks for errors; what was asked of them before is not answered any more.
    pub fn ask(&self, _: &State, question: Question) {
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
    let mut bench = Bench::new(Some(adapter));
    let mut survey: Option<Survey> = None;
    let found = |finding| {
        // The window is closed: there is nobody left to tell.
        let _ = find.send(finding);
        wake();
    };
    let window = Window { desk, tell, wake };
    while let Some(task) = next(desk, &mut survey) {
        match task {
            Task::Errors(question) => {
                let is_done = block_on(errors::answer(&mut bench, &question, &window));
                let mut held = lock(&desk.asked);
                if !is_done && held.errors.is_none() {
                    // It gave way to a pixel, and begins again after it.
                    held.errors = Some(question);
                }
            }
            Task::Pixel(question) => {
                let magnified = block_on(magnify::answer(&mut bench, &question));
                let magnified = magnified.map_err(|e| e.to_string());
                found(Finding::Magnified(question.id, magnified));
            }
            Task::Cost(question) => {
                for (side, renderer) in question.slots() {
                    let cost = block_on(cost::answer(&mut bench, &question, renderer));
                    let cost = cost.map_err(|e| e.to_string());
                    found(Finding::Cost(question.id, side, cost));
                }
            }
            Task::BeginSurvey(question) => survey = Some(Survey::new(question)),
            Task::GoOnWithSurvey => {
                if let Some(survey) = &mut survey {
                    let surveyed = block_on(survey.step(&mut bench));
                    found(Finding::Surveyed(survey.id(), surveyed));
                }
            }
        }
    }
}

/// Who asks for errors.
struct Window<'a> {
    desk: &'a Desk,
    tell: &'a Sender<Answer>,
    wake: &'a (dyn Fn() + Sync),
}

impl Asker for Window<'_> {
    fn tell(&self, answer: Answer) {
        // As above.
        let _ = self.tell.send(answer);
        (self.wake)();
    }

    async fn is_outdated(&self) -> bool {
        let held = lock(&self.desk.asked);
        held.is_over || held.errors.is_some() || held.pixel.is_some()
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
