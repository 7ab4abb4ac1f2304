//! Promise: a defect does to a mesh what it says, in the amount it says, the same every time, and nothing else.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common::command;

mod files;
mod kinds;
mod words;
