//! Promise: a part of a glTF file stands at any time of a clip where the file says, in f64, and closed meshes stay closed.
//!
//! Held against closed forms on documents written here, and against an oracle that shares no code with the loader on the
//! animated models that others made. Those are not part of the repository: where they are missing the tests say so and pass.

#![allow(
    clippy::unwrap_used,
    reason = "the helpers of a test fail by panicking, too"
)]

mod bounds;
use crate::common::command;
use crate::common::data;
pub(crate) mod document;
mod exact;
mod hostile;
mod oracle;
mod real;
