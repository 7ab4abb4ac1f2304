//! A thread that answers, with a device of its own. It leaves a core to the window.

use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;

use cutaway::experiment::SceneAtTime;
use cutaway::scene::Camera;

use super::{Answer, Asker, Known, Question, answer};
use crate::slot::Side;
use crate::state::State;

/// A question and the scene that it is about.
struct Asked {
    question: Question,
    at: Arc<SceneAtTime>,
    camera: Camera,
}

/// The newest question, and whether the thread is to end.
#[derive(Default)]
struct Desk {
    asked: Mutex<(Option<Asked>, bool)>,
    changed: Condvar,
}

/// The thread that answers.
pub struct Judge {
    desk: Arc<Desk>,
    answers: Receiver<Answer>,
}

impl Judge {
    /// Starts the thread, which opens the adapter of a name; `wake` is called whenever there is an answer.
    pub fn start(adapter: &str, wake: impl Fn() + Send + Sync + 'static) -> Self {
        let desk = Arc::new(Desk::default());
        let (tell, answers) = channel();
        let (own, adapter) = (desk.clone(), adapter.to_owned());
        thread::spawn(move || work(&own, &adapter, &tell, &wake));
        Self { desk, answers }
    }

    /// Asks about what is seen; what was asked before is not answered any more.
    pub fn ask(&self, state: &State, question: Question) {
        let asked = state.shown().map(|shown| Asked {
            question,
            at: shown.at.clone(),
            camera: shown.scene.camera,
        });
        lock(&self.desk).0 = asked;
        self.desk.changed.notify_one();
    }

    /// What was answered since.
    pub fn answers(&self) -> impl Iterator<Item = Answer> + '_ {
        self.answers.try_iter()
    }
}

impl Drop for Judge {
    fn drop(&mut self) {
        lock(&self.desk).1 = true;
        self.desk.changed.notify_one();
    }
}

fn lock(desk: &Desk) -> MutexGuard<'_, (Option<Asked>, bool)> {
    desk.asked.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Who asked the present question.
struct Window<'a> {
    id: u64,
    desk: &'a Desk,
    answers: &'a Sender<Answer>,
    wake: &'a (dyn Fn() + Sync),
}

impl Asker for Window<'_> {
    fn tell(&self, side: Side, divisor: u32, what: Known) {
        // The window is closed: there is nobody left to tell.
        let _ = self.answers.send(Answer {
            id: self.id,
            side,
            divisor,
            what,
        });
        (self.wake)();
    }

    async fn is_outdated(&self) -> bool {
        let held = lock(self.desk);
        held.1 || held.0.is_some()
    }
}

fn work(desk: &Desk, adapter: &str, answers: &Sender<Answer>, wake: &(dyn Fn() + Sync)) {
    let cores = thread::available_parallelism().map_or(1, usize::from);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(cores.saturating_sub(1).max(1));
    let Ok(pool) = pool.build() else {
        return;
    };
    let mut session = None;
    while let Some(asked) = next(desk) {
        let window = Window {
            id: asked.question.id,
            desk,
            answers,
            wake,
        };
        let scene = (&*asked.at, &asked.camera);
        pool.install(|| {
            let adapter = Some(adapter);
            let answered = answer(&mut session, adapter, scene, &asked.question, &window);
            pollster::block_on(answered);
        });
    }
}

/// Waits for a question; none when the thread is to end.
fn next(desk: &Desk) -> Option<Asked> {
    let mut held = lock(desk);
    loop {
        if held.1 {
            return None;
        }
        if let Some(asked) = held.0.take() {
            return Some(asked);
        }
        held = (desk.changed.wait(held)).unwrap_or_else(PoisonError::into_inner);
    }
}
