//! The window of `cutaway`: cuts are dragged, and strategies are compared by wiping one over the other, with the errors of each shown live.
//!
//! ```text
//! pointer, keys, files -> ui -> Action -> State (document, history, scene) -> Screen (pictures by the session, on egui's device)
//!                                                                          -> Judge (exact, on a thread with a device of its own)
//!                               Opening (files, on a thread with a copy of the state)
//! ```
//!
//! [`State`] knows of no window, [`gizmo`] and [`camera`] are geometry, [`ui`] paints and asks. The document is what a scene file holds:
//! undo, save and the command that makes a picture are taken from it.

pub mod action;
mod beside;
mod editing;
pub mod inspect;
pub mod judge;
pub mod notice;
mod picture;
pub mod profile;
pub mod state;
mod storage;
pub mod ui;
#[cfg(target_arch = "wasm32")]
pub mod web;
#[cfg(not(target_arch = "wasm32"))]
pub mod window;

pub use action::Action;
pub use editing::{command, cuts, history, link, parts, regions, removal, styles, timeline};
pub use picture::{
    camera, chart, device, full_screen, gizmo, pace, pick, readback, screen, shown, slot,
    world_view,
};
pub use state::State;
#[cfg(not(target_arch = "wasm32"))]
pub use storage::{disk, export, recent, recovery};
pub use storage::{files, opening, watch};
