//! The interactive window of `cutaway`: cuts are dragged, and strategies are compared by wiping one over the other, with live error marks.
//!
//! ```text
//! pointer, keys, files -> ui -> Action -> State (document, history, scene) -> Screen (pictures by the session, on egui's device)
//!                                                                          -> Judge (exact, on a thread with a device of its own)
//!                               Opening (files, on a thread with a copy of the state)
//! ```
//!
//! [`State`] is independent of the window, [`gizmo`] and [`camera`] compute geometry, [`ui`] paints and handles input. The document is a
//! scene file's content; undo, saving and the copied command all use it.

pub mod action;
mod beside;
mod editing;
pub mod inspect;
pub mod judge;
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
