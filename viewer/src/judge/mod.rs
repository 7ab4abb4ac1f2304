//! The reference, and the errors of the slots against it, aside of the window, which never waits for it: on a [thread](thread) with a
//! device of its own, or in a [worker](worker) of a page, which has one too.
//!
//! A question is answered at a quarter of the resolution, then at half, then whole, so that the first answer comes while a hand still
//! moves. A newer question ends the one before it between two steps.
//!
//! Cannot: end in the middle of a step.

#[cfg(not(target_arch = "wasm32"))]
mod thread;
#[cfg(target_arch = "wasm32")]
pub mod worker;

use cutaway::compare::{Comparison, compare, heatmap_overlay};
use cutaway::exact::evaluate;
use cutaway::experiment::{Evaluator, Renderer, SceneAtTime};
use cutaway::scene::{Camera, View};
use cutaway::{Exact, Gpu, GpuOptions, Layers, Result, Session};
use image::RgbaImage;

use crate::slot::Side;

#[cfg(not(target_arch = "wasm32"))]
pub use thread::Judge;
#[cfg(target_arch = "wasm32")]
pub use worker::Judge;

/// By how much coarser the answers are that come one after the other.
const DIVISORS: [u32; 3] = [4, 2, 1];

/// What is asked of a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Question {
    /// Its number, which answers name.
    pub id: u64,
    /// The picture that is looked at, in pixels.
    pub size_px: [u32; 2],
    /// Who draws the slots; none that is not seen.
    pub renderers: [Option<Renderer>; 2],
    /// Whether errors are wanted, or only the layers of slots that are found on the CPU.
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
    /// The layers of one that is found on the CPU.
    Layers(Layers),
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

/// Where answers go, and whether anybody still waits for them.
trait Asker {
    /// Tells a part of the answer.
    fn tell(&self, side: Side, divisor: u32, what: Known);

    /// Whether nobody waits for the present answer any more; looked at between two steps.
    async fn is_outdated(&self) -> bool;
}

/// Answers a question about a scene as a camera sees it, with a session that is kept from one to the next.
async fn answer(
    session: &mut Option<Session>,
    adapter: Option<&str>,
    (at, camera): (&SceneAtTime, &Camera),
    question: &Question,
    asker: &impl Asker,
) {
    if let Err(error) = try_answer(session, adapter, (at, camera), question, asker).await {
        let asked = Side::BOTH.into_iter();
        let asked = asked.filter(|side| question.renderers[side.index()].is_some());
        asked.for_each(|side| asker.tell(side, 1, Known::Failed(error.to_string())));
    }
}

async fn try_answer(
    session: &mut Option<Session>,
    adapter: Option<&str>,
    (at, camera): (&SceneAtTime, &Camera),
    question: &Question,
    asker: &impl Asker,
) -> Result<()> {
    let session = match session {
        Some(session) => session,
        None => {
            let options = GpuOptions {
                adapter: adapter.map(str::to_owned),
                prefer_software: false,
            };
            session.insert(Session::new(Gpu::open_async(&options).await?))
        }
    };
    for divisor in DIVISORS {
        let size_px = question.size_px.map(|s| (s / divisor).max(1));
        let view = at.model.prepared.view_of(camera, size_px);
        let mut exact: Option<Exact> = None;
        for side in Side::BOTH {
            let Some(renderer) = question.renderers[side.index()] else {
                continue;
            };
            if asker.is_outdated().await {
                return Ok(());
            }
            let say = |known| asker.tell(side, divisor, known);
            let asked = (renderer, question.wants_errors);
            if let Err(error) = judge(session, at, &view, asked, &mut exact, &say).await {
                say(Known::Failed(error.to_string()));
            }
        }
    }
    Ok(())
}

/// Says what is to be known of a slot at a resolution; the reference is evaluated once for both.
async fn judge(
    session: &mut Session,
    at: &SceneAtTime,
    view: &View,
    (renderer, wants_errors): (Renderer, bool),
    exact: &mut Option<Exact>,
    say: &impl Fn(Known),
) -> Result<()> {
    let truth = at.truth()?;
    let layers = match renderer {
        Renderer::Cpu(Evaluator::Exact) => {
            let exact = exact.get_or_insert_with(|| evaluate(truth, view));
            exact.layers.clone()
        }
        Renderer::Cpu(evaluator) => evaluator.evaluate(truth, view).layers,
        Renderer::Method(_) if !wants_errors => return Ok(()),
        Renderer::Method(method) => match session.layers_async(&at.model, view, method).await? {
            Ok(layers) => layers,
            Err(refusal) => {
                say(Known::Failed(refusal.reason));
                return Ok(());
            }
        },
    };
    if wants_errors && renderer != Renderer::EXACT {
        let exact = exact.get_or_insert_with(|| evaluate(truth, view));
        let comparison = compare(exact, &layers, view, at.model.prepared.scale);
        let marks = heatmap_overlay(exact, &layers);
        say(Known::Errors { marks, comparison });
    }
    if let Renderer::Cpu(_) = renderer {
        say(Known::Layers(layers));
    }
    Ok(())
}
