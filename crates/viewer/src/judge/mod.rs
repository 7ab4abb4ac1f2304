//! The reference, and what is compared with it, aside of the window, which never waits for it: on a thread with a device of its own, or in a
//! worker of a page, which has one too.
//!
//! Of each kind of question the newest is answered: the errors of the slots, a pixel that is [magnified](magnify), the [cost] of a
//! frame, a [survey] of all methods. The errors are found at a quarter of the resolution, then at half, then whole, so that the first
//! answer comes while a hand still moves; a newer question ends the one before it between two steps.
//!
//! The reference of the present scene is kept at each of these resolutions, 53 bytes a pixel of the picture: a click after the errors are
//! known does not evaluate it again, nor does another method.
//!
//! Cannot: end in the middle of a step; tell costs and times on a page, whose clocks are coarse.

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
    /// The picture that a state shows, where it shows one.
    pub fn of(state: &State, size_px: [u32; 2]) -> Option<Self> {
        let shown = state.shown()?;
        Some(Self {
            revision: state.scene_revision(),
            at: shown.at.clone(),
            camera: shown.scene.camera,
            size_px,
        })
    }

    /// Its view at the whole resolution.
    pub fn view(&self) -> View {
        let prepared = &self.at.model.prepared;
        prepared.view_of(&self.camera, self.size_px)
    }

    /// Returns true if all rays hit the same in both, whatever the style.
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
    /// Its number, which answers name.
    pub id: u64,
    /// The picture that is looked at.
    pub subject: Subject,
    /// Renderers of the slots; `None` for a slot that is not visible.
    pub renderers: [Option<Renderer>; 2],
    /// True if errors are requested, not only the layers of slots that are found on the CPU.
    pub wants_errors: bool,
}

/// A part of the answer.
#[derive(Debug)]
pub struct Answer {
    /// The number of the question.
    pub id: u64,
    /// The slot that it is about.
    pub side: SlotSide,
    /// By how much coarser than the picture it is.
    pub divisor: u32,
    /// Content of the answer.
    pub what: Content,
}

/// Known results of a slot.
#[derive(Debug)]
pub enum Content {
    /// The layers of one that is found on the CPU.
    Layers(Layers),
    /// Errors of one that is not.
    Errors {
        /// Error marks: transparent where the pixel is not wrong.
        marks: RgbaImage,
        /// The counts.
        comparison: Comparison,
    },
    /// The method refuses the scene, or something failed.
    Failed(String),
}

/// Answers for both slots that report a failure, with the reason.
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
pub enum Finding {
    /// The neighbourhood of a pixel, by the number of the question.
    Magnified(u64, Result<Magnified, String>),
    /// The cost of a frame of a slot, by the number of the question.
    Cost(u64, SlotSide, Result<Cost, String>),
    /// A step of a survey, by the number of the question.
    Surveyed(u64, Surveyed),
}

/// Receiver of answers.
trait AnswerSink {
    /// Sends a part of the answer.
    fn send(&self, answer: Answer);

    /// Returns true if a newer question has come, so that the rest of this answer is of no use; checked between two steps.
    async fn is_superseded(&self) -> bool;
}
