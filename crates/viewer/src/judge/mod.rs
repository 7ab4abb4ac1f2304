//! Compares pictures with the exact reference in the background, so that the window never waits: on a thread with its own device, or in a
//! web worker with its own device.
//!
//! Of each kind of question only the newest is answered. The kinds are: the slots' errors, a [magnified](magnify) pixel, the [cost] of a
//! frame, and a [survey] of all methods. Errors are computed at a quarter, a half and then the full resolution, so that the first
//! answer comes during a drag. A newer question ends work on the previous one between two steps.
//!
//! The present scene's reference is kept at each of these resolutions, at 53 bytes per pixel, so that neither a click nor
//! a change of method evaluates it again.
//!
//! Cannot: stop within a step; measure costs and times in a browser, whose timers are too coarse.

#![cfg_attr(
    target_arch = "wasm32",
    allow(dead_code, reason = "a page asks for no times")
)]

mod context;
pub mod cost;
mod errors;
pub mod magnify;
#[cfg(target_arch = "wasm32")]
mod message;
pub mod survey;
#[cfg(not(target_arch = "wasm32"))]
mod thread;
#[cfg(target_arch = "wasm32")]
pub mod worker;

use std::sync::Arc;

use cutaway::Layers;
use cutaway::scene::{Camera, View};
use cutaway_lab::compare::Comparison;
use cutaway_lab::experiment::{Renderer, SceneAtTime};
use image::RgbaImage;

use crate::picture::slot::SlotSide;
use crate::state::State;
use cost::Cost;
use magnify::Magnified;
use survey::Surveyed;

#[cfg(not(target_arch = "wasm32"))]
pub use thread::Judge;
#[cfg(target_arch = "wasm32")]
pub use worker::Judge;

/// Picture that a question is about.
#[derive(Clone, Debug)]
pub struct Subject {
    /// Revision number that changes whenever solids, cuts or the eye may have changed.
    pub revision: u64,
    /// The scene.
    pub at: Arc<SceneAtTime>,
    /// The viewpoint.
    pub camera: Camera,
    /// Width and height in pixels.
    pub size_px: [u32; 2],
}

impl Subject {
    /// The picture that a state displays; `None` if it has no scene.
    pub fn of(state: &State, size_px: [u32; 2]) -> Option<Self> {
        let shown = state.shown()?;
        Some(Self {
            revision: state.scene_revision(),
            at: shown.at.clone(),
            camera: shown.scene.camera,
            size_px,
        })
    }

    /// View at full resolution.
    pub fn view(&self) -> View {
        let prepared = &self.at.model.prepared;
        prepared.view_of(&self.camera, self.size_px)
    }

    /// Returns true if both pictures have the same rays with the same hits; their styles may differ.
    pub fn has_the_rays_of(&self, other: &Self) -> bool {
        let scale = |subject: &Self| subject.at.model.prepared.scale;
        self.revision == other.revision
            && self.view() == other.view()
            && scale(self) == scale(other)
    }
}

/// A question about the errors of the slots.
#[derive(Clone, Debug)]
pub struct ErrorQuestion {
    /// Id of the question, repeated in answers.
    pub id: u64,
    /// The displayed picture.
    pub subject: Subject,
    /// Renderers of the slots; `None` for a slot that is not visible.
    pub renderers: [Option<Renderer>; 2],
    /// True to compute errors; false to compute only the layers of slots drawn on the CPU.
    pub wants_errors: bool,
}

/// A part of the answer.
#[derive(Debug)]
pub struct Answer {
    /// Id of the question.
    pub id: u64,
    /// The slot concerned.
    pub side: SlotSide,
    /// Divisor of the picture's resolution at which the answer was computed.
    pub divisor: u32,
    /// Content of the answer.
    pub what: Content,
}

/// Result for a slot.
#[derive(Debug)]
pub enum Content {
    /// Layers of a slot drawn on the CPU.
    Layers(Layers),
    /// Errors of a slot drawn by a method.
    Errors {
        /// Image of error marks, transparent at correct pixels.
        marks: RgbaImage,
        /// Counts of wrong pixels, by kind.
        comparison: Comparison,
    },
    /// The method refuses the scene, or something failed.
    Failed(String),
}

/// Answers that report the same failure for both slots.
fn failed(id: u64, why: &str) -> [Answer; 2] {
    SlotSide::BOTH.map(|side| Answer {
        id,
        side,
        divisor: 1,
        what: Content::Failed(why.to_owned()),
    })
}

/// A result other than errors.
#[derive(Debug)]
pub enum JudgeFinding {
    /// The id of the question, and the magnified pixel.
    Magnified(u64, Result<Magnified, String>),
    /// The id of the question, the slot, and the cost of its frame.
    Cost(u64, SlotSide, Result<Cost, String>),
    /// The id of the question, and the result for one method of a survey.
    Surveyed(u64, Surveyed),
}

/// Receiver of answers.
trait AnswerSink {
    /// Sends a part of the answer.
    fn send(&self, answer: Answer);

    /// Returns true if a newer question makes the rest of this answer useless; checked between steps.
    async fn is_superseded(&self) -> bool;
}
