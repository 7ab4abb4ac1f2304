//! Promise: a defect does to a mesh what it says, in the amount it says, the same every time, and nothing else.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

#[path = "common/command.rs"]
mod command;
mod common;

#[path = "defects/files.rs"]
mod files;
#[path = "defects/kinds.rs"]
mod kinds;
#[path = "defects/words.rs"]
mod words;
