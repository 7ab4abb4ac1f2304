//! Frames in the encoder and the attachments of a host: the pixels of `render`, composed by the host's depth, without a wait.

mod common;

#[path = "embedding/allocations.rs"]
mod allocations;
#[path = "embedding/depth.rs"]
mod depth;
#[path = "embedding/guest.rs"]
mod guest;
#[path = "embedding/host.rs"]
mod host;
