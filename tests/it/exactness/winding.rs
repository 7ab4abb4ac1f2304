//! Promise: winding numbers draw a closed mesh as the exact reference does, and give the caps of a broken one nearly whole.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common::command;

mod closed;
mod device;
mod open;
mod renderer;
mod uncovered;
