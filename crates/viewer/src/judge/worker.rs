//! A web worker that answers questions on its own device: a second instance of this program, driven by messages.
//!
//! ```text
//! page    [question, scene, path, further files] -> worker
//! worker  [reply, bytes]                         -> page
//! ```
//!
//! The worker opens the document itself. It keeps files and the prepared scene from one question to the next.

use std::cell::{Cell, RefCell};
use std::path::PathBuf;
use std::rc::Rc;
use std::sync::Arc;

use cutaway::{Error, Result};
use cutaway_io::{Document, load::Assets};
use js_sys::{Array, Function, Promise, Uint8Array};
use wasm_bindgen::prelude::{Closure, wasm_bindgen};
use wasm_bindgen::{JsCast, JsValue};
use wasm_bindgen_futures::{JsFuture, spawn_local};
use web_sys::{DedicatedWorkerGlobalScope, Event, MessageEvent, Worker, WorkerOptions, WorkerType};

use super::context::JudgeContext;
use super::message::{QuestionKind, QuestionMessage, Reply};
use super::{Answer, AnswerSink, ErrorQuestion, JudgeFinding, Subject};
use super::{cost, errors, magnify, survey};
use crate::picture::shown::Shown;
use crate::state::State;
use crate::web::files::PageFiles;

/// The script that starts this program as a worker.
const SCRIPT: &str = "./judge.js";

/// The page's handle to the worker.
pub struct Judge {
    worker: Option<Worker>,
    replies: Rc<RefCell<Replies>>,
    /// True after the worker has failed: it sends no more answers.
    is_lost: Rc<Cell<bool>>,
    /// Number of files sent to the worker so far.
    given: Cell<usize>,
    /// The last question of each kind.
    asked: Rc<RefCell<[Option<QuestionMessage>; 2]>>,
    /// Handlers for the worker's messages and for its failure.
    _on_message: Closure<dyn FnMut(MessageEvent)>,
    _on_error: Closure<dyn FnMut(Event)>,
}

/// Replies of the worker not yet processed.
#[derive(Default)]
struct Replies {
    answers: Vec<Answer>,
    findings: Vec<JudgeFinding>,
}

impl Replies {
    fn add(&mut self, reply: Reply) {
        match reply {
            Reply::Answer(answer) => self.answers.push(answer),
            Reply::JudgeFinding(finding) => self.findings.push(finding),
        }
    }
}

/// Message for questions that the failed worker cannot answer.
const LOST: &str = "the comparison worker has failed: reload the page";

impl Judge {
    /// Starts the worker, on the browser's adapter; `wake` is called for every answer.
    pub fn start(_adapter: &str, wake: impl Fn() + 'static) -> Self {
        let replies = Rc::new(RefCell::new(Replies::default()));
        let (own, wake) = (replies.clone(), Rc::new(wake));
        let woken = wake.clone();
        let on_message = Closure::new(move |event: MessageEvent| {
            if let Some(reply) = Reply::from_message(&event.data()) {
                own.borrow_mut().add(reply);
                woken();
            }
        });
        let options = WorkerOptions::new();
        options.set_type(WorkerType::Module);
        let worker = Worker::new_with_options(SCRIPT, &options).ok();
        let asked = Rc::new(RefCell::new([const { None::<QuestionMessage> }; 2]));
        let is_lost = Rc::new(Cell::new(false));
        let (own, questions, lost_now) = (replies.clone(), asked.clone(), is_lost.clone());
        let on_error = Closure::new(move |_: Event| {
            lost_now.set(true);
            let lost = questions.borrow();
            let unanswered = lost.iter().flatten().flat_map(|q| q.unanswered(LOST));
            unanswered.for_each(|reply| own.borrow_mut().add(reply));
            wake();
        });
        if let Some(worker) = &worker {
            worker.set_onmessage(Some(on_message.as_ref().unchecked_ref()));
            worker.set_onerror(Some(on_error.as_ref().unchecked_ref()));
        }
        Self {
            worker,
            replies,
            asked,
            is_lost,
            given: Cell::new(0),
            _on_message: on_message,
            _on_error: on_error,
        }
    }

    /// Sends a question about the visible picture; earlier questions of this kind are dropped.
    pub fn ask(&self, state: &State, question: ErrorQuestion) {
        let wants_errors = question.wants_errors;
        let kind = QuestionKind::Slots { wants_errors };
        let (id, renderers) = (question.id, question.renderers);
        let message = QuestionMessage::new(id, &question.subject, renderers, kind);
        self.send(state, message);
    }

    /// Sends a question about a pixel; the previous one is dropped.
    pub fn magnify(&self, state: &State, question: magnify::MagnifyQuestion) {
        let kind = QuestionKind::Pixel(question.at_px);
        let (id, renderers) = (question.id, question.renderers);
        let message = QuestionMessage::new(id, &question.subject, renderers, kind);
        self.send(state, message);
    }

    fn send(&self, state: &State, question: QuestionMessage) {
        if let Err(why) = self.try_send(state, &question) {
            let mut replies = self.replies.borrow_mut();
            (question.unanswered(&why).into_iter()).for_each(|reply| replies.add(reply));
        }
        let kind = question.about.kind();
        self.asked.borrow_mut()[kind] = Some(question);
    }

    fn try_send(&self, state: &State, question: &QuestionMessage) -> Result<(), String> {
        let worker = (self.worker.as_ref()).ok_or("the browser started no comparison worker")?;
        if self.is_lost.get() {
            return Err(LOST.to_owned());
        }
        let document = state.as_seen().map_err(|e| e.to_string())?;
        let asked = serde_json::to_string(question).map_err(|e| e.to_string())?;
        let path = document.path().to_string_lossy().into_owned();
        let further = Array::new();
        let mut given = self.given.get();
        for (path, bytes) in PageFiles::of_page().since(given) {
            further.push(&Array::of2(
                &path.to_string_lossy().as_ref().into(),
                &Uint8Array::from(&*bytes),
            ));
            given += 1;
        }
        let text = document.to_string();
        let message = Array::of4(&asked.into(), &text.into(), &path.into(), &further);
        let sent = worker.post_message(&message);
        sent.map_err(|_| "the browser cannot send messages to the comparison worker".to_owned())?;
        self.given.set(given);
        Ok(())
    }

    /// Answers that arrived since the last call.
    pub fn answers(&self) -> impl Iterator<Item = Answer> + '_ {
        std::mem::take(&mut self.replies.borrow_mut().answers).into_iter()
    }

    /// Findings that arrived since the last call.
    pub fn findings(&self) -> impl Iterator<Item = JudgeFinding> + '_ {
        std::mem::take(&mut self.replies.borrow_mut().findings).into_iter()
    }

    /// Does nothing: a page offers no time measurements, because a browser's timers are too coarse.
    pub fn cost(&self, _: cost::CostQuestion) {}

    /// Does nothing: a page offers no time measurements, because a browser's timers are too coarse.
    pub fn survey(&self, _: survey::SurveyQuestion) {}

    /// Does nothing: a page offers no surveys.
    pub fn cancel_survey(&self) {}
}

impl Drop for Judge {
    fn drop(&mut self) {
        if let Some(worker) = &self.worker {
            worker.terminate();
        }
    }
}

/// A question received by the worker, with its scene.
struct Received {
    asked: QuestionMessage,
    scene: Document,
}

/// State of the worker.
struct WorkerMailbox {
    /// The newest unanswered question of each kind.
    pending: RefCell<[Option<Received>; 2]>,
    /// State for answering; `None` while a question is being answered.
    state: RefCell<Option<WorkerState>>,
    files: Arc<PageFiles>,
    /// True if files have arrived since the last check.
    has_further: Cell<bool>,
}

/// State kept from one question to the next.
struct WorkerState {
    context: JudgeContext,
    assets: Assets,
    /// The scene of the last question, with its document's text.
    shown: Option<(String, Shown)>,
}

thread_local! {
    static MAILBOX: Rc<WorkerMailbox> = Rc::new(WorkerMailbox::new());
}

/// Receives a message from the page; called by the worker's script.
#[wasm_bindgen]
pub fn judge(message: &JsValue) {
    let mailbox = MAILBOX.with(Rc::clone);
    let Some(received) = read_question(message, &mailbox) else {
        return;
    };
    let kind = received.asked.about.kind();
    mailbox.pending.borrow_mut()[kind] = Some(received);
    // If the state is taken, an answer is in progress, and its task goes on with the new question.
    if let Some(state) = mailbox.state.take() {
        spawn_local(work(mailbox, state));
    }
}

fn read_question(message: &JsValue, mailbox: &WorkerMailbox) -> Option<Received> {
    let message: &Array = message.dyn_ref()?;
    let text = |index| message.get(index).as_string();
    let asked: QuestionMessage = serde_json::from_str(&text(0)?).ok()?;
    let further = message.get(3).dyn_into::<Array>().ok()?;
    mailbox
        .has_further
        .set(mailbox.has_further.get() || further.length() > 0);
    for file in further.iter() {
        let file: Array = file.dyn_into().ok()?;
        let bytes: Uint8Array = file.get(1).dyn_into().ok()?;
        mailbox
            .files
            .insert(file.get(0).as_string()?, bytes.to_vec());
    }
    Some(Received {
        asked,
        scene: Document::parse(PathBuf::from(text(2)?), &text(1)?).ok()?,
    })
}

/// Answers all pending questions, pixels before slots.
async fn work(mailbox: Rc<WorkerMailbox>, mut state: WorkerState) {
    loop {
        let received = mailbox
            .pending
            .borrow_mut()
            .iter_mut()
            .find_map(Option::take);
        let Some(received) = received else {
            break;
        };
        let page = PageSink { mailbox: &mailbox };
        if mailbox.has_further.take() {
            // A new file may replace one of the same name.
            state.assets = Assets::from_files(mailbox.files.clone());
            state.shown = None;
        }
        let asked = &received.asked;
        let shown = match open(&received.scene, &mut state.assets, &mut state.shown) {
            Ok(shown) => shown,
            Err(error) => {
                let unanswered = asked.unanswered(&error.to_string());
                unanswered.into_iter().for_each(post);
                continue;
            }
        };
        let (id, renderers) = (asked.id, asked.renderers());
        let subject = Subject {
            revision: asked.revision,
            at: shown.at.clone(),
            camera: shown.scene.camera,
            size_px: asked.size_px,
        };
        match asked.about {
            QuestionKind::Slots { wants_errors } => {
                let question = ErrorQuestion {
                    id,
                    subject,
                    renderers,
                    wants_errors,
                };
                let is_done = errors::answer(&mut state.context, &question, &page).await;
                let kind = asked.about.kind();
                let mut pending = mailbox.pending.borrow_mut();
                if !is_done && pending[kind].is_none() {
                    // A question about a pixel interrupted this one, which starts again afterwards.
                    pending[kind] = Some(received);
                }
            }
            QuestionKind::Pixel(at_px) => {
                let question = magnify::MagnifyQuestion {
                    id,
                    subject,
                    renderers,
                    at_px,
                };
                let answer =
                    async |context: &mut JudgeContext| magnify::answer(context, &question).await;
                let magnified = state.context.retried(answer).await;
                let magnified = magnified.map_err(|e| e.to_string());
                post(Reply::JudgeFinding(JudgeFinding::Magnified(id, magnified)));
            }
        }
    }
    *mailbox.state.borrow_mut() = Some(state);
}

/// The prepared scene of a document; if the document differs from the last one, the last scene is updated.
fn open<'a>(
    document: &Document,
    assets: &mut Assets,
    shown: &'a mut Option<(String, Shown)>,
) -> Result<&'a Shown> {
    let text = document.to_string();
    let next = match shown.take() {
        Some((of, same)) if of == text => same,
        last => {
            let last = last.as_ref().map(|(_, shown)| shown);
            let time_s = document.timeline(assets)?.settings().time_s;
            let opened = Shown::open(document, assets, time_s, last)?;
            let none = || Error::input("the scene", "it has no parts", "add one");
            let mut opened = opened.ok_or_else(none)?;
            opened.classify()?;
            opened
        }
    };
    let (_, shown) = shown.insert((text, next));
    Ok(shown)
}

impl WorkerMailbox {
    fn new() -> Self {
        let files = Arc::new(PageFiles::default());
        let state = WorkerState {
            context: JudgeContext::new(None),
            assets: Assets::from_files(files.clone()),
            shown: None,
        };
        Self {
            pending: RefCell::default(),
            state: RefCell::new(Some(state)),
            files,
            has_further: Cell::new(false),
        }
    }
}

/// Sends answers to the page.
struct PageSink<'a> {
    mailbox: &'a WorkerMailbox,
}

/// Sends a reply to the page.
fn post(reply: Reply) {
    let worker: DedicatedWorkerGlobalScope = js_sys::global().unchecked_into();
    if let Some(message) = reply.into_message() {
        // Posting fails only if the page is closed, and is then ignored.
        let _ = worker.post_message(&message);
    }
}

impl AnswerSink for PageSink<'_> {
    fn send(&self, answer: Answer) {
        post(Reply::Answer(answer));
    }

    async fn is_superseded(&self) -> bool {
        // A worker receives messages only between its tasks, so this task ends here and continues in the next one.
        let next_task = Promise::new(&mut |resolve: Function, _| {
            let worker: DedicatedWorkerGlobalScope = js_sys::global().unchecked_into();
            let set = worker.set_timeout_with_callback(&resolve);
            if set.is_err() {
                let _ = resolve.call0(&JsValue::NULL);
            }
        });
        // This promise is never rejected.
        let _ = JsFuture::from(next_task).await;
        self.mailbox.pending.borrow().iter().any(Option::is_some)
    }
}
