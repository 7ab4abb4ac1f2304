//! A thread that answers questions on its own device. A survey takes its next step only when no other question waits. The thread leaves a
//! core free for the window.
//!
//! A panic is reported as the answer to its question, and all kept state is rebuilt for the next question.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Condvar, Mutex, PoisonError};

use cutaway::Result;
use pollster::block_on;

use super::context::JudgeContext;
use super::survey::{self, Found, Survey};
use super::{Answer, AnswerSink, ErrorQuestion, JudgeFinding, cost, errors, failed, magnify};
use crate::beside::beside;
use crate::state::State;

/// Holds the newest question of each kind: a new question replaces one that was not yet begun.
#[derive(Default)]
struct Mailbox {
    pending: Mutex<PendingQuestions>,
    changed: Condvar,
}

/// Questions not yet begun, by kind.
#[derive(Default)]
struct PendingQuestions {
    errors: Option<ErrorQuestion>,
    pixel: Option<magnify::MagnifyQuestion>,
    cost: Option<cost::CostQuestion>,
    survey: Option<survey::SurveyQuestion>,
    /// Id of the survey in progress.
    surveyed: Option<u64>,
    /// True if the thread should end.
    is_over: bool,
}

/// The next task.
enum JudgeTask {
    Errors(ErrorQuestion),
    Pixel(magnify::MagnifyQuestion),
    Cost(cost::CostQuestion),
    BeginSurvey(survey::SurveyQuestion),
    GoOnWithSurvey,
}

/// The thread that answers.
pub struct Judge {
    mailbox: Arc<Mailbox>,
    answers: Receiver<Answer>,
    findings: Receiver<JudgeFinding>,
}

impl Judge {
    /// Starts the thread, which opens the named adapter; `wake` is called for every answer.
    pub fn start(adapter: &str, wake: impl Fn() + Send + Sync + 'static) -> Self {
        let mailbox = Arc::new(Mailbox::default());
        let (send_answer, answers) = channel();
        let (send_finding, findings) = channel();
        let (own, adapter) = (mailbox.clone(), adapter.to_owned());
        beside(move || work(&own, adapter, (&send_answer, &send_finding), &wake));
        Self {
            mailbox,
            answers,
            findings,
        }
    }

    /// Requests the errors of the slots, and drops earlier questions about errors.
    pub fn ask(&self, _: &State, question: ErrorQuestion) {
        self.put(|pending| pending.errors = Some(question));
    }

    /// Requests the neighbourhood of a pixel.
    pub fn magnify(&self, _: &State, question: magnify::MagnifyQuestion) {
        self.put(|pending| pending.pixel = Some(question));
    }

    /// Requests the cost of the slots' frames.
    pub fn cost(&self, question: cost::CostQuestion) {
        self.put(|pending| pending.cost = Some(question));
    }

    /// Begins a survey, replacing the previous one.
    pub fn survey(&self, question: survey::SurveyQuestion) {
        self.put(|pending| {
            pending.surveyed = Some(question.id);
            pending.survey = Some(question);
        });
    }

    /// Ends the survey before its next step.
    pub fn cancel_survey(&self) {
        self.put(|pending| (pending.survey, pending.surveyed) = (None, None));
    }

    /// Answers that arrived since the last call.
    pub fn answers(&self) -> impl Iterator<Item = Answer> + '_ {
        self.answers.try_iter()
    }

    /// Findings that arrived since the last call.
    pub fn findings(&self) -> impl Iterator<Item = JudgeFinding> + '_ {
        self.findings.try_iter()
    }

    fn put(&self, change: impl FnOnce(&mut PendingQuestions)) {
        change(&mut lock(&self.mailbox.pending));
        self.mailbox.changed.notify_one();
    }
}

impl Drop for Judge {
    fn drop(&mut self) {
        self.put(|pending| pending.is_over = true);
    }
}

fn lock<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

fn work(
    mailbox: &Mailbox,
    adapter: String,
    (answers, findings): (&Sender<Answer>, &Sender<JudgeFinding>),
    wake: &(dyn Fn() + Sync),
) {
    let mut context = JudgeContext::new(Some(adapter));
    let mut survey: Option<Survey> = None;
    let found = |finding| {
        // Sending fails only after the window was closed, and is then ignored.
        let _ = findings.send(finding);
        wake();
    };
    let sink = ThreadSink {
        mailbox,
        answers,
        wake,
    };
    while let Some(task) = next(mailbox, &mut survey) {
        match task {
            JudgeTask::Errors(question) => {
                let answered = guarded(&mut context, |context| {
                    Ok(block_on(errors::answer(context, &question, &sink)))
                });
                match answered {
                    Ok(is_done) => {
                        let mut held = lock(&mailbox.pending);
                        if !is_done && held.errors.is_none() {
                            // A question about a pixel interrupted this one, which starts again afterwards.
                            held.errors = Some(question);
                        }
                    }
                    Err(why) => failed(question.id, &why)
                        .into_iter()
                        .for_each(|answer| sink.send(answer)),
                }
            }
            JudgeTask::Pixel(question) => {
                let magnified = guarded(&mut context, |context| {
                    let answer = async |context: &mut JudgeContext| {
                        magnify::answer(context, &question).await
                    };
                    block_on(context.retried(answer))
                });
                found(JudgeFinding::Magnified(question.id, magnified));
            }
            JudgeTask::Cost(question) => {
                for (side, renderer) in question.slots() {
                    let cost = guarded(&mut context, |context| {
                        let answer = async |context: &mut JudgeContext| {
                            cost::answer(context, &question, renderer).await
                        };
                        block_on(context.retried(answer))
                    });
                    found(JudgeFinding::Cost(question.id, side, cost));
                }
            }
            JudgeTask::BeginSurvey(question) => survey = Some(Survey::new(question)),
            JudgeTask::GoOnWithSurvey => {
                if let Some(survey) = &mut survey {
                    let method = survey.begin_step();
                    let step = guarded(&mut context, |context| {
                        block_on(survey.step(context, method))
                    });
                    let surveyed = survey.surveyed(method, step.unwrap_or_else(Found::Refused));
                    found(JudgeFinding::Surveyed(survey.id(), surveyed));
                }
            }
        }
    }
}

/// Returns an answer, or the error or panic that prevented it; after a panic all kept state is rebuilt.
fn guarded<T>(
    context: &mut JudgeContext,
    answer: impl FnOnce(&mut JudgeContext) -> Result<T>,
) -> Result<T, String> {
    let answered = catch_unwind(AssertUnwindSafe(|| answer(context)));
    answered.map_or_else(
        |panic| {
            context.clear();
            let said = panic.downcast_ref::<&str>().copied();
            let said = said.or_else(|| panic.downcast_ref::<String>().map(String::as_str));
            let said = said.unwrap_or("no reason is given");
            Err(format!(
                "this comparison failed: {said}\n  help: it is a fault of this program: please report it with the scene"
            ))
        },
        |answer| answer.map_err(|e| e.to_string()),
    )
}

/// Sends answers to the window.
struct ThreadSink<'a> {
    mailbox: &'a Mailbox,
    answers: &'a Sender<Answer>,
    wake: &'a (dyn Fn() + Sync),
}

impl AnswerSink for ThreadSink<'_> {
    fn send(&self, answer: Answer) {
        // Sending fails only after the window was closed, and is then ignored.
        let _ = self.answers.send(answer);
        (self.wake)();
    }

    async fn is_superseded(&self) -> bool {
        let held = lock(&self.mailbox.pending);
        held.is_over || held.errors.is_some() || held.pixel.is_some()
    }
}

/// Waits for the next task; `None` when the thread should end.
fn next(mailbox: &Mailbox, survey: &mut Option<Survey>) -> Option<JudgeTask> {
    let mut held = lock(&mailbox.pending);
    loop {
        let pending = &mut *held;
        if pending.is_over {
            return None;
        }
        let is_wanted =
            |survey: &Survey| pending.surveyed == Some(survey.id()) && !survey.is_done();
        *survey = survey.take().filter(is_wanted);
        let goes_on = survey.as_ref().map(|_| JudgeTask::GoOnWithSurvey);
        let task = (pending.pixel.take().map(JudgeTask::Pixel))
            .or_else(|| pending.errors.take().map(JudgeTask::Errors))
            .or_else(|| pending.cost.take().map(JudgeTask::Cost))
            .or_else(|| pending.survey.take().map(JudgeTask::BeginSurvey))
            .or(goes_on);
        if task.is_some() {
            return task;
        }
        held = mailbox
            .changed
            .wait(held)
            .unwrap_or_else(PoisonError::into_inner);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicBool, Ordering};
    use std::time::Duration;

    use super::super::{Content, Subject};
    use cutaway_io::Document;
    use cutaway_io::document::part;
    use cutaway_io::load::Assets;
    use cutaway_lab::experiment::Renderer;

    #[test]
    fn a_panic_is_an_answer_and_the_next_question_has_another() {
        let mut document = Document::new();
        document.add_part(part("shape:cube")).expect("a part");
        let state = State::open(document, Assets::default()).expect("a scene");
        let (wake, woken) = channel();
        // What tells the window of an answer is part of answering.
        let panics = Arc::new(AtomicBool::new(false));
        let own = panics.clone();
        let judge = Judge::start("", move || {
            assert!(!own.swap(false, Ordering::Relaxed), "nobody wakes");
            let _ = wake.send(());
        });
        let wait = || {
            woken
                .recv_timeout(Duration::from_secs(60))
                .expect("an answer")
        };
        let subject = Subject::of(&state, [64, 48]).expect("a picture");
        let ask_pixel = |id, at_px| {
            judge.magnify(
                &state,
                magnify::MagnifyQuestion {
                    id,
                    subject: subject.clone(),
                    renderers: [None; 2],
                    at_px,
                },
            );
            wait();
            match judge.findings().next() {
                Some(JudgeFinding::Magnified(of, answer)) if of == id => answer,
                other => panic!("{other:?}"),
            }
        };
        // There is no such pixel, which the window never asks about.
        let failed = ask_pixel(1, [9_000, 9_000]).expect_err("a reason");
        assert!(failed.contains("this comparison failed"), "{failed}");
        assert!(ask_pixel(2, [32, 24]).is_ok(), "the next one");

        let ask_errors = |id| {
            let question = ErrorQuestion {
                id,
                subject: subject.clone(),
                renderers: [Some(Renderer::EXACT), None],
                wants_errors: false,
            };
            judge.ask(&state, question);
            wait();
            let own = judge.answers().filter(|answer| answer.id == id);
            own.map(|answer| answer.what).collect::<Vec<_>>()
        };
        panics.store(true, Ordering::Relaxed);
        let failed =
            |what: &Content| matches!(what, Content::Failed(why) if why.contains("nobody wakes"));
        let answers = ask_errors(1);
        assert!(answers.iter().any(failed), "{answers:?}");
        // The second half of that answer.
        wait();
        let answers = ask_errors(2);
        assert!(matches!(answers[0], Content::Layers(_)), "{answers:?}");
    }
}
