//! Promise: a scene over time is what its keys, deformers and frames say, at every time; what does not change stays the same
//! object; and a timeline that makes no sense is refused with its line and a mend.

use crate::common;
use crate::common::command;

mod deformers;
mod frames;
mod kept;
mod keys;
mod stages;

use command::Scratch;
use cutaway::scene::{Part, Scene};
use cutaway_io::document::Timeline;

/// The scene at a time at which it is sound.
fn at(timeline: &Timeline, time_s: f64) -> Scene {
    let scene = timeline.at(time_s);
    scene.unwrap_or_else(|e| panic!("at {time_s} s: {e}"))
}

fn part<'a>(scene: &'a Scene, name: &str) -> &'a Part {
    let found = scene.parts.iter().find(|p| p.name == name);
    found.unwrap_or_else(|| panic!("no part {name}"))
}
