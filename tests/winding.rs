//! Promise: winding numbers draw a closed mesh as the exact reference does, and give the caps of a broken one nearly whole.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

#[path = "common/command.rs"]
mod command;
mod common;

#[path = "winding/closed.rs"]
mod closed;
#[path = "winding/open.rs"]
mod open;
#[path = "winding/renderer.rs"]
mod renderer;
