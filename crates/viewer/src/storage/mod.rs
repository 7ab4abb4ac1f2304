//! File handling for the window: opening, watching, recent files, export and recovery.

#[cfg(not(target_arch = "wasm32"))]
pub mod disk;
#[cfg(not(target_arch = "wasm32"))]
pub mod export;
pub mod files;
pub mod opening;
#[cfg(not(target_arch = "wasm32"))]
pub mod recent;
#[cfg(not(target_arch = "wasm32"))]
pub mod recovery;
pub mod watch;
