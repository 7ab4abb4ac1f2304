//! Every check is able to fail: each test here plants a fault and demands that it is found.

mod common;

#[path = "controls/frames.rs"]
mod frames;
#[path = "controls/plans.rs"]
mod plans;
#[path = "controls/scenes.rs"]
mod planted;
