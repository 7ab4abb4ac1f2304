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
pub use editing::command;
pub use editing::cuts;
pub use editing::history;
pub use editing::link;
pub use editing::parts;
pub use editing::regions;
pub use editing::removal;
pub use editing::styles;
pub use editing::timeline;
pub use picture::camera;
pub use picture::chart;
pub use picture::device;
pub use picture::full_screen;
pub use picture::gizmo;
pub use picture::pace;
pub use picture::pick;
pub use picture::readback;
pub use picture::screen;
pub use picture::shown;
pub use picture::slot;
pub use picture::world_view;
pub use state::State;
#[cfg(not(target_arch = "wasm32"))]
pub use storage::disk;
#[cfg(not(target_arch = "wasm32"))]
pub use storage::export;
pub use storage::files;
pub use storage::opening;
#[cfg(not(target_arch = "wasm32"))]
pub use storage::recent;
#[cfg(not(target_arch = "wasm32"))]
pub use storage::recovery;
pub use storage::watch;
