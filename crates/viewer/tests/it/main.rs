//! The user interface without a window: panels are queried by their labels, as by a screen reader; pictures are read back from the GPU.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod closing;
mod command;
mod common;
mod compare;
mod device;
mod flow;
mod handles;
mod opening;
mod overwriting;
mod parts;
mod pointer;
mod random;
mod refusals;
mod state;
mod timeline;
