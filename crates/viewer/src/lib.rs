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
pub mod camera;
pub mod chart;
pub mod command;
pub mod cuts;
pub mod device;
#[cfg(not(target_arch = "wasm32"))]
pub mod disk;
#[cfg(not(target_arch = "wasm32"))]
pub mod export;
pub mod files;
pub mod full_screen;
pub mod gizmo;
pub mod history;
pub mod inspect;
pub mod judge;
pub mod link;
pub mod notice;
pub mod opening;
pub mod pace;
pub mod parts;
pub mod pick;
pub mod profile;
pub mod readback;
#[cfg(not(target_arch = "wasm32"))]
pub mod recent;
#[cfg(not(target_arch = "wasm32"))]
pub mod recovery;
pub mod regions;
pub mod removal;
pub mod screen;
pub mod shown;
pub mod slot;
pub mod state;
pub mod styles;
pub mod timeline;
pub mod ui;
pub mod watch;
#[cfg(target_arch = "wasm32")]
pub mod web;
#[cfg(not(target_arch = "wasm32"))]
pub mod window;
pub mod world_view;

pub use action::Action;
pub use state::State;
