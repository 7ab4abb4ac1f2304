//! A worker of a page that answers, with a device of its own: a second instance of this very program, which is asked by messages.
//!
//! ```text
//! page    [question, scene, path, further files] -> worker
//! worker  [answer, bytes]                        -> page
//! ```
//!
//! The worker opens the document by itself, and keeps files and what it has prepared from one question to the next.

use std::cell::{Cell, RefCell};
use std::path::PathBuf;
use std::rc::Rc;
use std::sync::Arc;

use bytemuck::pod_collect_to_vec;
use cutaway::compare::Comparison;
use cutaway::experiment::Renderer;
use cutaway::gpu::{layers_from_words, words_from_layers};
use cutaway::load::Assets;
use cutaway::{Document, Error, Layers, Result};
use image::RgbaImage;
use js_sys::{Array, Function, Promise, Uint8Array};
use serde::{Deserialize, Serialize};
use wasm_bindgen::prelude::{Closure, wasm_bindgen};
use wasm_bindgen::{JsCast, JsValue};
use wasm_bindgen_futures::{JsFuture, spawn_local};
use web_sys::{DedicatedWorkerGlobalScope, Event, MessageEvent, Worker, WorkerOptions, WorkerType};

use super::bench::Bench;
use super::{Answer, Asker, Finding, Known, Question, Subject, cost, errors, magnify, survey};
use crate::shown::Shown;
use crate::slot::Side;
use crate::state::State;
use crate::web::files::PageFiles;

/// The script that starts this program as a worker.
const SCRIPT: &str = "./judge.js";

/// A question, as a message has it.
#[derive(Serialize, Deserialize)]
struct Asked {
    id: u64,
    revision: u64,
    size_px: [u32; 2],
    renderers: [Option<String>; 2],
    wants_errors: bool,
}

/// An answer, as a message has it beside its bytes.
#[derive(Serialize, Deserialize)]
struct Told {
    id: u64,
    is_b: bool,
    divisor: u32,
    what: What,
}

#[derive(Serialize, Deserialize)]
enum What {
    Layers([u32; 2]),
    Errors([u32; 2], Box<Comparison>),
    Failed(String),
}

/// The worker, as the page sees it.
pub struct Judge {
    worker: Option<Worker>,
    answers: Rc<RefCell<Vec<Answer>>>,
    /// So many files it has been given.
    given: Cell<usize>,
    /// The number of the last question.
    asked: Rc<Cell<u64>>,
    /// What takes in its messages, and that it has failed.
    _on_message: Closure<dyn FnMut(MessageEvent)>,
    _on_error: Closure<dyn FnMut(Event)>,
}

/// What is told where the worker fails.
const LOST: &str = "the worker that compares has failed: reload the page";

/// That a question is not answered.
fn failed(id: u64, why: &str) -> [Answer; 2] {
    Side::BOTH.map(|side| Answer {
        id,
        side,
        divisor: 1,
        what: Known::Failed(why.to_owned()),
    })
}

impl Judge {
    /// Starts the worker, on the adapter that the browser gives; `wake` is called whenever there is an answer.
    pub fn start(_adapter: &str, wake: impl Fn() + 'static) -> Self {
        let answers = Rc::new(RefCell::new(Vec::new()));
        let (told, wake) = (answers.clone(), Rc::new(wake));
        let woken = wake.clone();
        let on_message = Closure::new(move |event: MessageEvent| {
            if let Some(answer) = read_answer(&event.data()) {
                told.borrow_mut().push(answer);
                woken();
            }
        });
        let options = WorkerOptions::new();
        options.set_type(WorkerType::Module);
        let worker = Worker::new_with_options(SCRIPT, &options).ok();
        let asked = Rc::new(Cell::new(0));
        let (told, id) = (answers.clone(), asked.clone());
        let on_error = Closure::new(move |_: Event| {
            told.borrow_mut().extend(failed(id.get(), LOST));
            wake();
        });
        if let Some(worker) = &worker {
            worker.set_onmessage(Some(on_message.as_ref().unchecked_ref()));
            worker.set_onerror(Some(on_error.as_ref().unchecked_ref()));
        }
        Self {
            worker,
            answers,
            asked,
            given: Cell::new(0),
            _on_message: on_message,
            _on_error: on_error,
        }
    }

    /// Asks about what is seen; what was asked before is not answered any more.
    pub fn ask(&self, state: &State, question: Question) {
        self.asked.set(question.id);
        if let Err(why) = self.try_ask(state, &question) {
            self.answers.borrow_mut().extend(failed(question.id, &why));
        }
    }

    fn try_ask(&self, state: &State, question: &Question) -> Result<(), String> {
        let worker = self.worker.as_ref();
        let worker = worker.ok_or("the browser started no worker to judge by")?;
        let document = state.as_seen().map_err(|e| e.to_string())?;
        let asked = Asked {
            id: question.id,
            revision: question.subject.revision,
            size_px: question.subject.size_px,
            renderers: question.renderers.map(|r| r.map(|r| r.to_string())),
            wants_errors: question.wants_errors,
        };
        let asked = serde_json::to_string(&asked).map_err(|e| e.to_string())?;
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
        sent.map_err(|_| "the browser does not reach its worker".to_owned())?;
        self.given.set(given);
        Ok(())
    }

    /// What was answered since.
    pub fn answers(&self) -> impl Iterator<Item = Answer> + '_ {
        self.answers.take().into_iter()
    }

    /// What else was found since: nothing, for a page asks for errors alone.
    pub fn findings(&self) -> impl Iterator<Item = Finding> + '_ {
        std::iter::empty()
    }

    /// Not offered on a page.
    pub fn magnify(&self, _: magnify::Question) {}

    /// Not offered on a page.
    pub fn cost(&self, _: cost::Question) {}

    /// Not offered on a page.
    pub fn survey(&self, _: survey::Question) {}

    /// Not offered on a page.
    pub fn cancel_survey(&self) {}
}

impl Drop for Judge {
    fn drop(&mut self) {
        if let Some(worker) = &self.worker {
            worker.terminate();
        }
    }
}

fn read_answer(message: &JsValue) -> Option<Answer> {
    let message: &Array = message.dyn_ref()?;
    let told: Told = serde_json::from_str(&message.get(0).as_string()?).ok()?;
    let bytes = message.get(1).dyn_into::<Uint8Array>().ok()?.to_vec();
    let what = match told.what {
        What::Layers(size_px) => Known::Layers(Layers {
            size_px,
            pixels: layers_from_words(&pod_collect_to_vec::<u8, u32>(&bytes)),
        }),
        What::Errors([width, height], comparison) => Known::Errors {
            marks: RgbaImage::from_raw(width, height, bytes)?,
            comparison: *comparison,
        },
        What::Failed(why) => Known::Failed(why),
    };
    Some(Answer {
        id: told.id,
        side: if told.is_b { Side::B } else { Side::A },
        divisor: told.divisor,
        what,
    })
}

/// A question that has come to the worker, and the scene that it is about.
struct Received {
    asked: Asked,
    scene: Document,
}

/// What the worker keeps.
struct Desk {
    newest: RefCell<Option<Received>>,
    /// What it works with; taken while it does.
    tools: RefCell<Option<Tools>>,
    files: Arc<PageFiles>,
    /// Whether files have come since they were last looked at.
    has_further: Cell<bool>,
}

/// What is kept from one question to the next.
struct Tools {
    bench: Bench,
    assets: Assets,
    /// The scene of the last question, by the text of its document.
    shown: Option<(String, Shown)>,
}

thread_local! {
    static DESK: Rc<Desk> = Rc::new(Desk::new());
}

/// Takes in a message of the page; called by the script of the worker.
#[wasm_bindgen]
pub fn judge(message: &JsValue) {
    let desk = DESK.with(Rc::clone);
    let Some(received) = read_question(message, &desk) else {
        return;
    };
    *desk.newest.borrow_mut() = Some(received);
    // Without tools it is at work, and finds the question when it looks.
    if let Some(tools) = desk.tools.take() {
        spawn_local(work(desk, tools));
    }
}

fn read_question(message: &JsValue, desk: &Desk) -> Option<Received> {
    let message: &Array = message.dyn_ref()?;
    let text = |index| message.get(index).as_string();
    let asked: Asked = serde_json::from_str(&text(0)?).ok()?;
    let further = message.get(3).dyn_into::<Array>().ok()?;
    desk.has_further
        .set(desk.has_further.get() || further.length() > 0);
    for file in further.iter() {
        let file: Array = file.dyn_into().ok()?;
        let bytes: Uint8Array = file.get(1).dyn_into().ok()?;
        desk.files.insert(file.get(0).as_string()?, bytes.to_vec());
    }
    Some(Received {
        asked,
        scene: Document::parse(PathBuf::from(text(2)?), &text(1)?).ok()?,
    })
}

/// Answers questions until there is none.
async fn work(desk: Rc<Desk>, mut tools: Tools) {
    while let Some(Received { asked, scene }) = desk.newest.take() {
        let page = Page { desk: &desk };
        if desk.has_further.take() {
            // One of them may be of a name that was read before.
            tools.assets = Assets::from_files(desk.files.clone());
            tools.shown = None;
        }
        match open(scene, &mut tools.assets, &mut tools.shown) {
            Ok(shown) => {
                let renderer = |name: Option<String>| name?.parse::<Renderer>().ok();
                let question = Question {
                    id: asked.id,
                    subject: Subject {
                        revision: asked.revision,
                        at: shown.at.clone(),
                        camera: shown.scene.camera,
                        size_px: asked.size_px,
                    },
                    renderers: asked.renderers.map(renderer),
                    wants_errors: asked.wants_errors,
                };
                errors::answer(&mut tools.bench, &question, &page).await;
            }
            Err(error) => failed(asked.id, &error.to_string())
                .into_iter()
                .for_each(|answer| page.tell(answer)),
        }
    }
    *desk.tools.borrow_mut() = Some(tools);
}

/// The scene of a document, prepared after the last where that was another.
fn open<'a>(
    document: Document,
    assets: &mut Assets,
    shown: &'a mut Option<(String, Shown)>,
) -> Result<&'a Shown> {
    let text = document.to_string();
    let next = match shown.take() {
        Some((of, same)) if of == text => same,
        last => {
            let last = last.as_ref().map(|(_, shown)| shown);
            let time_s = document.timeline(assets)?.settings().time_s;
            let opened = Shown::open(&document, assets, time_s, last)?;
            let none = || Error::input("the scene", "it has no parts", "add one");
            let mut opened = opened.ok_or_else(none)?;
            opened.settle()?;
            opened
        }
    };
    let (_, shown) = shown.insert((text, next));
    Ok(shown)
}

impl Desk {
    fn new() -> Self {
        let files = Arc::new(PageFiles::default());
        let tools = Tools {
            bench: Bench::new(None),
            assets: Assets::from_files(files.clone()),
            shown: None,
        };
        Self {
            newest: RefCell::default(),
            tools: RefCell::new(Some(tools)),
            files,
            has_further: Cell::new(false),
        }
    }
}

/// The page that asks.
struct Page<'a> {
    desk: &'a Desk,
}

impl Asker for Page<'_> {
    fn tell(&self, answer: Answer) {
        let (what, bytes) = match answer.what {
            Known::Layers(layers) => {
                let words = words_from_layers(&layers);
                let bytes = bytemuck::cast_slice(&words).to_vec();
                (What::Layers(layers.size_px), bytes)
            }
            Known::Errors { marks, comparison } => {
                let size_px = [marks.width(), marks.height()];
                (
                    What::Errors(size_px, Box::new(comparison)),
                    marks.into_raw(),
                )
            }
            Known::Failed(why) => (What::Failed(why), Vec::new()),
        };
        let told = Told {
            id: answer.id,
            is_b: answer.side == Side::B,
            divisor: answer.divisor,
            what,
        };
        let worker: DedicatedWorkerGlobalScope = js_sys::global().unchecked_into();
        if let Ok(told) = serde_json::to_string(&told) {
            let message = Array::of2(&told.into(), &Uint8Array::from(&*bytes));
            // A page that is closed has nobody left to tell.
            let _ = worker.post_message(&message);
        }
    }

    async fn is_outdated(&self) -> bool {
        // Messages come in between two tasks of the worker: this one ends here and goes on in the next.
        let next_task = Promise::new(&mut |resolve: Function, _| {
            let worker: DedicatedWorkerGlobalScope = js_sys::global().unchecked_into();
            let set = worker.set_timeout_with_callback(&resolve);
            if set.is_err() {
                let _ = resolve.call0(&JsValue::NULL);
            }
        });
        // It never fails.
        let _ = JsFuture::from(next_task).await;
        self.desk.newest.borrow().is_some()
    }
}
